#include "verification/runs/run_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "reference/compressible/tait_column.hpp"
#include "solver/incompressible/make_incompressible_solver.hpp"
#include "solver/incompressible/pressure_field.hpp"
#include "solver/material/pressure.hpp"
#include "solver/simulation.hpp"
#include "solver/sph/make_sph_solver.hpp"
#include "verification/not_a_number.hpp"
#include "verification/runs/interruption.hpp"
#include "verification/runs/surface_record.hpp"

namespace verification {
namespace {

/// Takes samples of a running simulation.
class Recorder {
 public:
  Recorder(const PlannedRun& plan, const mpm::Simulation& simulation, const ExactField* exact, RunData& data)
      : scene_(plan.scene),
        simulation_(simulation),
        exact_(exact),
        data_(data),
        samples_at_(plan.scene.flow->tabulated_points()) {
    mpm::Scheme splines;  // of the incompressible method; the degree is of no matter here
    splines.basis = mpm::Scheme::Basis::Cubic;
    if (samples_at_.empty())
      samples_at_ =
          mpm::sample_points(plan.scene.scene, plan.scene.incompressible ? splines : plan.scene.scheme);
    data_.start = simulation.particles().position;
    record_history(plan.scene.start);
  }

  void after_step(double t) {
    const double due = scene_.start + (scene_.outputs.back() - scene_.start) * static_cast<double>(samples_) /
                                          scene_.history_samples;
    if (t < due * (1 - 1e-9)) return;
    record_history(t);
  }

  void at_output(double t) {
    const mpm::VectorField grid = simulation_.grid_field(samples_at_, t);
    for (std::size_t i = 0; i < samples_at_.size(); ++i) add(t, Location::Grid, samples_at_[i], grid[i]);
    const mpm::Particles& particles = simulation_.particles();
    for (std::size_t p = 0; p < particles.size(); ++p)
      add(t, Location::Particles, particles.position[p], particles.velocity[p]);
    add_state(t);
    if (scene_.incompressible) add_cells(t);
    data_.probe.push_back(probe_velocity(t));
    if (scene_.flow->has_shear_profile()) add_shear(t);
  }

 private:
  void add(double t, Location location, const Vec2& x, const Vec2& v) {
    const Vec2 exact = exact_ ? exact_->velocity(x, t, location) : Vec2(nan, nan);
    data_.profile.push_back({t, name(location), x.x(), x.y(), v.x(), v.y(), exact.x(), exact.y()});
  }

  /// Density and pressure of the particles, where the flow has an exact density.
  void add_state(double t) {
    const mpm::Fluid& fluid = scene_.fluid.solver;
    if (!exact_ || !fluid.pressure) return;
    const mpm::TaitPressure eos{fluid.bulk_modulus, 1 / fluid.density};
    const mpm::Particles& particles = simulation_.particles();
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const auto density = exact_->density(particles.position[p], t);
      if (!density) return;
      data_.state.push_back(
          exact_state_at(scene_, t, name(Location::Particles), particles.position[p], *density));
      data_.state.back().density = particles.density[p];
      data_.state.back().pressure = eos.pressure(particles.density[p]);
    }
  }

  /// Density of every cell by the particles in it, which disorder changes, and the pressure at its centre.
  void add_cells(double t) {
    const mpm::Scene& scene = scene_.scene;
    const int nx = scene.cells[0], ny = scene.cells[1];
    std::vector<double> mass(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny), 0.0);
    mpm::VectorField centres;
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        centres.emplace_back((i + 0.5) * scene.cell_size(0), (j + 0.5) * scene.cell_size(1));
    const mpm::Particles& particles = simulation_.particles();
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Vec2& x = particles.position[p];
      if (!x.allFinite()) return;
      const int i = std::clamp(static_cast<int>(x.x() / scene.cell_size(0)), 0, nx - 1);
      const int j = std::clamp(static_cast<int>(x.y() / scene.cell_size(1)), 0, ny - 1);
      mass[static_cast<std::size_t>(i) + static_cast<std::size_t>(j) * static_cast<std::size_t>(nx)] +=
          particles.mass[p];
    }
    const auto* field = dynamic_cast<const mpm::PressureField*>(&simulation_);
    const std::vector<double> pressure = field ? field->grid_pressure(centres) : std::vector<double>();
    for (std::size_t c = 0; c < centres.size(); ++c)
      data_.state.push_back({t, "cells", centres[c].x(), centres[c].y(),
                             mass[c] / (scene.cell_size(0) * scene.cell_size(1)), scene.fluid.density,
                             pressure.empty() ? nan : pressure[c],
                             exact_ ? exact_->pressure(centres[c], t).value_or(nan) : nan});
  }

  /// Shear rate sqrt(2 D:D) and viscosity ratio at the centres of the cells under the probe.
  void add_shear(double t) {
    const int cells = scene_.discretisation.cells, across = scene_.flow->across();
    mpm::VectorField centres;
    for (int j = 0; j < cells; ++j) {
      Vec2 x = Vec2::Constant(0.5 * scene_.scene.cell_size(1 - across));
      x[across] = (j + 0.5) * scene_.cell_size();
      centres.push_back(x);
    }
    const std::vector<mpm::Mat2> gradients = simulation_.grid_gradient(centres, t);
    for (std::size_t j = 0; j < centres.size(); ++j) {
      const mpm::Mat2 d = 0.5 * (gradients[j] + gradients[j].transpose());
      const double rate = std::sqrt(2 * d.squaredNorm());
      data_.shear.push_back({t, "cells", centres[j][across], rate, scene_.fluid.viscosity_ratio(rate)});
    }
  }

  [[nodiscard]] double probe_velocity(double t) const {
    const Probe probe = scene_.flow->probe();
    return simulation_.grid_field({probe.point}, t).front().dot(probe.direction);
  }

  void record_history(double t) {
    const Probe probe = scene_.flow->probe();
    const mpm::Totals totals = simulation_.totals();
    const double exact = exact_ ? exact_->velocity(probe.point, t, Location::Grid).dot(probe.direction) : nan;
    data_.history.push_back({t, probe_velocity(t), exact, totals.mass, totals.momentum.x(),
                             totals.momentum.y(), totals.impulse.x(), totals.impulse.y(),
                             totals.kinetic_energy, exact_ ? exact_->kinetic_energy(t).value_or(nan) : nan});
    if (scene_.scene.free_surface) data_.surface.push_back(surface_at(scene_, simulation_, t));
    ++samples_;
  }

  const SceneConfig& scene_;
  const mpm::Simulation& simulation_;
  const ExactField* exact_;
  RunData& data_;
  mpm::VectorField samples_at_;
  long samples_ = 0;
};

}  // namespace

std::vector<reports::ProfileRow> exact_lines(const SceneConfig& scene, const ExactField& exact) {
  std::vector<reports::ProfileRow> rows;
  for (const double t : scene.outputs)
    for (const Vec2& x : scene.flow->exact_line()) {
      const Vec2 v = exact.velocity(x, t, Location::Grid);
      if (v.hasNaN()) continue;  // known at other points alone
      rows.push_back({t, "exact", x.x(), x.y(), nan, nan, v.x(), v.y()});
    }
  return rows;
}

std::vector<reports::ShearRow> exact_shear(const SceneConfig& scene, const ExactField& exact) {
  std::vector<reports::ShearRow> rows;
  for (const double t : scene.outputs)
    for (const Vec2& x : scene.flow->exact_line())
      if (const auto rate = exact.shear_rate(x, t))
        rows.push_back({t, "exact", x[scene.flow->across()], *rate, scene.fluid.viscosity_ratio(*rate)});
  return rows;
}

reports::StateRow exact_state_at(const SceneConfig& scene, double t, const std::string& location,
                                 const Vec2& x, double exact_density) {
  const mpm::Fluid& fluid = scene.fluid.solver;
  return {
      t,   location,      x.x(), x.y(),
      nan, exact_density, nan,   reference::tait_pressure(exact_density, fluid.bulk_modulus, fluid.density)};
}

std::vector<reports::StateRow> exact_state(const SceneConfig& scene, const ExactField& exact) {
  std::vector<reports::StateRow> rows;
  if (!scene.fluid.solver.pressure) return rows;
  for (const double t : scene.outputs)
    for (const Vec2& x : scene.flow->exact_line())
      if (const auto density = exact.density(x, t))
        rows.push_back(exact_state_at(scene, t, "exact", x, *density));
  return rows;
}

std::optional<CostlyReference> costly_reference(const Study& study, const SceneConfig& scene) {
  if (study.comparison != Comparison::Exact && scene.start == 0) return std::nullopt;
  return scene.flow->costly_reference(scene.reference_times());
}

std::shared_ptr<const ExactField> compared_with(const Study& study, const SceneConfig& scene) {
  switch (study.comparison) {
    case Comparison::Discrete:
      return scene.flow->exact_discrete(scene.discretisation, scene.segments.front().dt);
    case Comparison::SteadyNodes:
      return scene.flow->steady_nodes(scene.discretisation);
    case Comparison::Ideal:
      return scene.flow->ideal();
    case Comparison::Table:
      return study.table;
    case Comparison::Finest:
      return nullptr;  // known when all levels have ended: compare_with_finest()
    default:
      return scene.flow->exact(scene.reference_times());
  }
}

namespace {

std::unique_ptr<mpm::Simulation> simulation_of(const SceneConfig& scene, const mpm::Scene& started) {
  if (scene.sph) return mpm::make_sph_solver(started, *scene.sph);
  if (scene.incompressible)
    return mpm::make_incompressible_solver(started, *scene.incompressible, 0, scene.flow->wall_shares());
  return mpm::make_simulation(started, scene.scheme);
}

/// One simulation of the plan from its start, with its samples.
RunData simulate(const Study& study, const PlannedRun& plan, const mpm::Scene& started,
                 const ExactField* exact) {
  RunData data;
  data.plan = &plan;
  const auto begin = std::chrono::steady_clock::now();
  const auto simulation = simulation_of(plan.scene, started);
  Recorder recorder(plan, *simulation, exact, data);
  const mpm::Outcome outcome = mpm::run(
      *simulation, plan.scene.segments,
      [&](double t) {
        throw_if_interrupted();
        recorder.after_step(t);
      },
      [&](double t) { recorder.at_output(t); });
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  const auto particles = static_cast<long>(simulation->particles().size());
  data.record = describe_run(
      study, plan, outcome.steps,
      outcome.breakdown ? fmt::format("diverged at t = {:.6g} s: {}", outcome.time, *outcome.breakdown)
                        : "completed");
  data.timing.run = plan.run;
  data.timing.wall_s = wall;
  data.timing.particle_steps_per_s =
      static_cast<double>(particles) * static_cast<double>(outcome.steps) / wall;
  return data;
}

/// Fastest of the timed repetitions, and how far their median lies above it. `timing` holds the first
/// simulation.
void repeat_timing(const Study& study, const PlannedRun& plan, const mpm::Scene& started,
                   const ExactField* exact, reports::TimingRecord& timing) {
  std::vector<double> walls;
  if (warms_itself(study.repetitions, timing.wall_s)) walls.push_back(timing.wall_s);
  while (wants_repetition(study.repetitions, walls))
    walls.push_back(simulate(study, plan, started, exact).timing.wall_s);
  std::ranges::sort(walls);
  const double fastest = walls.front();
  timing.particle_steps_per_s *= timing.wall_s / fastest;
  timing.wall_s = fastest;
  timing.repetitions = static_cast<long>(walls.size());
  if (walls.size() > 1) timing.spread = (walls[walls.size() / 2] - fastest) / fastest;
}

}  // namespace

bool warms_itself(int asked, double wall) {
  return wall >= (asked > 1 ? 0.05 : 0.25);
}

bool wants_repetition(int asked, const std::vector<double>& walls) {
  constexpr double enough = 0.25;
  if (walls.empty()) return true;
  if (walls.size() >= static_cast<std::size_t>(asked)) return false;
  return walls.size() < 2 || std::accumulate(walls.begin(), walls.end(), 0.0) < enough;
}

RunData run_simulation(const Study& study, const PlannedRun& plan) {
  const SceneConfig& scene = plan.scene;
  const auto exact = compared_with(study, scene);
  mpm::Scene started = scene.scene;
  if (scene.start > 0) {
    const auto field = scene.flow->exact(scene.reference_times());
    started.initial_velocity = [field, t = scene.start](const Vec2& x) {
      return field->velocity(x, t, Location::Particles);
    };
    if (field->density(Vec2::Zero(), scene.start))
      started.initial_density = [field, t = scene.start](const Vec2& x) { return *field->density(x, t); };
  }
  RunData data = simulate(study, plan, started, exact.get());
  if (study.repetitions > 0) repeat_timing(study, plan, started, exact.get(), data.timing);
  if (exact && (study.comparison == Comparison::Exact || study.comparison == Comparison::Ideal ||
                study.comparison == Comparison::Table)) {
    const auto rows = exact_lines(scene, *exact);
    data.profile.insert(data.profile.end(), rows.begin(), rows.end());
    const auto shear = exact_shear(scene, *exact);
    data.shear.insert(data.shear.end(), shear.begin(), shear.end());
    const auto state = exact_state(scene, *exact);
    data.state.insert(data.state.end(), state.begin(), state.end());
  }
  return data;
}

}  // namespace verification

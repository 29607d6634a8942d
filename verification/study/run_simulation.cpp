#include "verification/study/run_simulation.hpp"

#include <fmt/format.h>

#include <chrono>
#include <limits>

#include "solver/simulation.hpp"

namespace verification {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Takes samples of a running simulation.
class Recorder {
 public:
  Recorder(const PlannedRun& plan, const mpm::Simulation& simulation, const ExactField* exact, RunData& data)
      : scene_(plan.scene),
        simulation_(simulation),
        exact_(exact),
        data_(data),
        samples_at_(mpm::sample_points(plan.scene.scene, plan.scene.scheme)) {
    record_history(0);
  }

  void after_step(double t) {
    const double due = scene_.outputs.back() * static_cast<double>(samples_) / scene_.history_samples;
    if (t < due * (1 - 1e-9)) return;
    record_history(t);
  }

  void at_output(double t) {
    const mpm::VectorField grid = simulation_.grid_field(samples_at_, t);
    for (std::size_t i = 0; i < samples_at_.size(); ++i) add(t, Location::Grid, samples_at_[i], grid[i]);
    const mpm::Particles& particles = simulation_.particles();
    for (std::size_t p = 0; p < particles.size(); ++p)
      add(t, Location::Particles, particles.position[p], particles.velocity[p]);
    data_.probe.push_back(probe_velocity(t));
  }

 private:
  void add(double t, Location location, const Vec2& x, const Vec2& v) {
    const Vec2 exact = exact_ ? exact_->velocity(x, t, location) : Vec2(nan, nan);
    data_.profile.push_back({t, name(location), x.x(), x.y(), v.x(), v.y(), exact.x(), exact.y()});
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
                             totals.kinetic_energy});
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
      rows.push_back({t, "exact", x.x(), x.y(), nan, nan, v.x(), v.y()});
    }
  return rows;
}

RunData run_simulation(const Study& study, const PlannedRun& plan) {
  const SceneConfig& scene = plan.scene;
  const double dt = mpm::nominal_time_step(scene.time_step, scene.scene);
  RunData data;
  data.plan = &plan;
  const auto exact = study.comparison == Comparison::Discrete
                         ? scene.flow->exact_discrete(scene.discretisation, dt)
                         : scene.flow->exact();
  const auto begin = std::chrono::steady_clock::now();
  const auto simulation = mpm::make_simulation(scene.scene, scene.scheme);
  Recorder recorder(plan, *simulation, exact.get(), data);
  const mpm::Outcome outcome = mpm::run(
      *simulation, scene.segments, [&](double t) { recorder.after_step(t); },
      [&](double t) { recorder.at_output(t); });
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  const auto particles = static_cast<long>(simulation->particles().size());
  data.record = {plan.run,
                 study.name,
                 scene.flow_name,
                 scene.fluid.label,
                 mpm::name(scene.scheme.basis),
                 mpm::name(scene.scheme.transfer),
                 mpm::name(scene.scheme.stepping),
                 scene.discretisation.cells,
                 particles,
                 scene.segments.front().dt,
                 outcome.steps,
                 outcome.breakdown
                     ? fmt::format("diverged at t = {:.6g} s: {}", outcome.time, *outcome.breakdown)
                     : "completed"};
  data.timing = {plan.run, wall, static_cast<double>(particles) * static_cast<double>(outcome.steps) / wall};
  if (const auto line = scene.flow->exact(); line && study.comparison == Comparison::Exact) {
    const auto rows = exact_lines(scene, *line);
    data.profile.insert(data.profile.end(), rows.begin(), rows.end());
  }
  return data;
}

}  // namespace verification

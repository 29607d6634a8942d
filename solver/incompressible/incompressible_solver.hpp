#pragma once

#include <cmath>
#include <limits>
#include <utility>

#include "solver/incompressible/lanes/plane_setup.hpp"
#include "solver/incompressible/pressure.hpp"
#include "solver/incompressible/pressure_field.hpp"
#include "solver/incompressible/stokes.hpp"
#include "solver/kernel/isa.hpp"
#include "solver/scene/seeding.hpp"
#include "solver/simulation.hpp"

namespace mpm::incompressible {

/// Incompressible material points on divergence-conforming B-splines (docs/methods-incompressible.md). A
/// step:
///   particles drift half a step along the field extrapolated from earlier ones; the grid takes their
///   velocity there, U* = argmin sum V_p |U(x_p) - v_p|^2; its solenoidal part S is advanced by viscosity,
///   walls and forces, S -> E; particles take U = E - (G + G_last)/2, G = U* - S, at their place, and drift
///   the whole step along W = (S + E)/2.
/// Every W is solenoidal at every point, so particles stay spread; there is no sound. Reflecting the gradient
/// part, as the constraint on the midpoint asks, alternates from step to step what the mesh cannot resolve;
/// the mean of two successive ones does not.
class IncompressibleSolver final : public Simulation, public PressureField {
 public:
  IncompressibleSolver(const Scene& scene, const IncompressibleScheme& scheme, int threads,
                       const WallShares& shares)
      : scene_(scene),
        scheme_(scheme),
        team_(threads),
        space_(scene, scheme.degree),
        mass_(space_),
        stokes_(scene_, space_, mass_, shares),
        setup_(plane_setup(space_, scheme.regularisation)),
        kernel_(make_plane_kernel(setup_)),
        particles_(seed_particles(scene)),
        lattice_(particles_.position),
        volume_(particles_.size()),
        middle_(particles_.size()) {
    for (std::size_t p = 0; p < volume_.size(); ++p) volume_[p] = particles_.mass[p] / scene.fluid.density;
    std::fill(particles_.density.begin(), particles_.density.end(), scene.fluid.density);
    // There is no stress at a particle.
    particles_.stress.assign(particles_.size(), Mat2::Constant(std::numeric_limits<double>::quiet_NaN()));
    field_ = VectorXd::Zero(space_.size());
    if (scene_.initial_velocity)
      field_ = stokes_.solenoidal_part(
          mass_.solved(space_.load([&](const VectorField& points, VectorField& values) {
            for (std::size_t i = 0; i < points.size(); ++i) values[i] = scene_.initial_velocity(points[i]);
          })));
    drift_ = {field_, field_, scene.start, scene.start};
  }

  void advance(double t, double dt) override {
    drift(particles_.position, drift_.at(t + 0.25 * dt), 0.5 * dt, middle_);
    const VectorXd fitted = fit();
    const bool remaps = scheme_.remap_every > 0 && ++steps_ % scheme_.remap_every == 0;
    if (remaps) middle_ = lattice_;  // and the velocity there is the grid's, which loses nothing

    const VectorXd start = stokes_.solenoidal_part(fitted);
    const Stokes::Step step = stokes_.advanced(start, t, dt, scheme_.stepping);
    const VectorXd gradient = fitted - start;
    if (last_gradient_.size() == 0) last_gradient_ = gradient / dt;
    field_ = step.end - 0.5 * (gradient + dt * last_gradient_);
    before_ = std::exchange(taken_, {field_ - fitted, t, dt, step.stages});
    last_gradient_ =
        gradient / dt;  // as much as the step is long, and the last one before an output is shorter
    impulse_ += scene_.fluid.density * step.impulse;

    take(field_);
    const VectorXd middle_field = 0.5 * (start + step.end);
    if (remaps)
      drift(middle_, middle_field, 0.5 * dt, particles_.position);
    else
      drift(particles_.position, middle_field, dt, particles_.position);
    drift_.add(middle_field, t + 0.5 * dt);
    now_ = t + dt;
    judge(dt, step.converged);
  }

  [[nodiscard]] std::optional<std::string> breakdown() const override { return breakdown_; }
  [[nodiscard]] const Particles& particles() const override { return particles_; }

  /// The solenoidal fields of the last two midpoints, extrapolated to the time reached.
  [[nodiscard]] VectorField grid_field(const VectorField& points, double) const override {
    const VelocityField field = space_.extended(drift_.at(now_));
    VectorField values;
    for (const Vec2& x : points) values.push_back(space_.value(field, x));
    return values;
  }

  [[nodiscard]] std::vector<Mat2> grid_gradient(const VectorField& points, double) const override {
    const VelocityField field = space_.extended(drift_.at(now_));
    std::vector<Mat2> values;
    for (const Vec2& x : points) values.push_back(space_.gradient(field, x));
    return values;
  }

  /// From what the last two steps had to be given, each at its middle, along a straight line.
  [[nodiscard]] std::vector<double> grid_pressure(const VectorField& points) const override {
    if (taken_.dt == 0) return {};
    auto load = stokes_.load_of_pressure(taken_.change, taken_.dt, taken_.stages);
    if (!load) return {};
    if (before_.dt > 0) {
      const auto earlier = stokes_.load_of_pressure(before_.change, before_.dt, before_.stages);
      *load += taken_.dt / (taken_.dt + before_.dt) * (*load - *earlier);
    }
    const Pressure pressure(space_);
    const MatrixXd p = scene_.fluid.density * pressure.balancing(*load);
    std::vector<double> values;
    for (const Vec2& x : points) values.push_back(pressure.value(p, x));
    return values;
  }

  [[nodiscard]] Totals totals() const override { return totals_of(particles_, impulse_); }

  /// Fewest and most particles of a cell where the last fit was taken.
  [[nodiscard]] std::pair<int, int> occupancy() const { return kernel_->occupancy(); }

 private:
  static constexpr std::size_t block = 512;

  /// What a step did to the velocities at the place of its fit.
  struct Taken {
    VectorXd change;
    double t = 0, dt = 0;
    std::vector<Stokes::Stage> stages;
  };

  /// The fields along which particles drifted at the last two midpoints; between and beyond them, a straight
  /// line.
  struct Drift {
    VectorXd last, before;
    double t_last, t_before;

    [[nodiscard]] VectorXd at(double t) const {
      if (!(t_last > t_before)) return last;
      return last + ((t - t_last) / (t_last - t_before)) * (last - before);
    }
    void add(const VectorXd& field, double t) {
      // What a field at the start, before walls and forces acted, says of the next is nothing.
      before = is_first ? field : last;
      t_before = is_first ? t : t_last;
      is_first = false;
      last = field;
      t_last = t;
    }
    bool is_first = true;
  };

  /// loop(first, count) for blocks of particles.
  template <class Loop>
  void for_blocks(const Loop& loop) {
    team_.run(static_cast<int>((particles_.size() + block - 1) / block), [&](int share) {
      const std::size_t begin = static_cast<std::size_t>(share) * block;
      loop(begin, std::min(block, particles_.size() - begin));
    });
  }
  static const double* numbers(const VectorField& field, std::size_t from = 0) { return field[from].data(); }
  static double* numbers(VectorField& field, std::size_t from = 0) { return field[from].data(); }

  /// The velocity field nearest to the particles': argmin over U of
  ///   sum_p V_p |U(x_p) - v_p|^2 + r |U - U_last|^2,
  /// the last term, with the exact mass, for cells that run thin or empty.
  VectorXd fit() {
    constexpr double tolerance = 1e-11;
    kernel_->assemble(volume_.data(), numbers(middle_), numbers(particles_.velocity), particles_.size(),
                      team_);
    VectorXd fitted(space_.size());
    team_.run(2, [&](int component) {
      const Eigen::Index first = component == 0 ? 0 : space_.size(0);
      kernel_->solve(component, tolerance, field_.data() + first, fitted.data() + first);
    });
    return fitted;
  }

  void drift(const VectorField& from, const VectorXd& field, double dt, VectorField& to) {
    kernel_->follow(field.data());
    for_blocks([&](std::size_t p, std::size_t count) {
      kernel_->drift(numbers(from, p), count, dt, numbers(to, p));
    });
  }

  void take(const VectorXd& field) {
    kernel_->follow(field.data());
    for_blocks([&](std::size_t p, std::size_t count) {
      kernel_->velocities(numbers(middle_, p), count, numbers(particles_.velocity, p));
    });
  }

  /// Nothing else bounds the velocities of a run that goes wrong: the fit bears any.
  void judge(double dt, bool converged) {
    if (!converged) breakdown_ = "the equations of the viscosity were not solved: take a shorter dt";
    if (!field_.allFinite()) breakdown_ = "a velocity is not finite";
    if (field_.lpNorm<Eigen::Infinity>() * dt > scene_.size.maxCoeff())
      breakdown_ = "a particle would cross the whole domain in a step";
    for (const Vec2& x : particles_.position)
      if (!x.allFinite()) breakdown_ = "a position is not finite";
  }

  const Scene scene_;
  const IncompressibleScheme scheme_;
  ThreadTeam team_;
  VelocitySpace space_;
  ExactMass mass_;
  Stokes stokes_;
  const PlaneSetup setup_;
  const std::unique_ptr<PlaneKernel> kernel_;
  Particles particles_;
  const VectorField lattice_;
  std::vector<double> volume_;  // [m2]
  VectorField middle_;          // where the fit is taken
  VectorXd field_;
  VectorXd last_gradient_;  // by the length of its step
  Taken taken_, before_;
  Drift drift_;
  Vec2 impulse_ = Vec2::Zero();
  double now_ = scene_.start;
  long steps_ = 0;
  std::optional<std::string> breakdown_;
};

}  // namespace mpm::incompressible

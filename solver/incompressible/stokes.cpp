#include "solver/incompressible/stokes.hpp"

#include <cmath>

namespace mpm::incompressible {
namespace {

/// L-stable and of second order: Alexander (1977).
const double gamma = 1 - std::sqrt(0.5);

VectorXd uniform_load(const VelocitySpace& space, int component) {
  return space.load([&](const VectorField&, VectorField& values) {
    for (Vec2& value : values) value[component] = 1;
  });
}

/// What sides that pull along themselves give, per density: integral of N_i times the traction [m3/s2].
VectorXd traction_load(const VelocitySpace& space, const Scene& scene) {
  VelocityField sum{MatrixXd::Zero(space.axis(0).functions(0), space.axis(1).functions(1)),
                    MatrixXd::Zero(space.axis(0).functions(1), space.axis(1).functions(0))};
  for (const int component : {0, 1}) {
    const SplineAxis &along = space.axis(component), &across = space.axis(1 - component);
    for (const int end : {0, 1}) {
      const Side& side = scene.sides[static_cast<std::size_t>(2 * (1 - component) + end)];
      if (side.traction == 0) continue;
      const MatrixXd load =
          side.traction / scene.fluid.density * along.integrals(0) * across.end_values(end).transpose();
      if (component == 0)
        sum.u += load;
      else
        sum.v += load.transpose();
    }
  }
  return space.folded(sum);
}

}  // namespace

Stokes::Stokes(const Scene& scene, const VelocitySpace& space, const ExactMass& mass,
               const WallShares& shares)
    : scene_(scene),
      space_(space),
      mass_(mass),
      basis_(space.solenoidal_basis()),
      reduced_mass_(reduced_to(basis_, mass.matrix())),
      mass_factor_(space, reduced_mass_),
      viscosity_(make_viscosity(scene, space, basis_, reduced_mass_, shares)),
      last_(VectorXd::Zero(basis_.cols())),
      traction_(traction_load(space, scene)),
      uniform_{uniform_load(space, 0), uniform_load(space, 1)} {
  for (const std::size_t a : {0u, 1u})
    if (space.axis(static_cast<int>(a)).periodic())
      uniform_coordinates_[a] = mass_factor_.solve(basis_.transpose() * uniform_[a]);
}

VectorXd Stokes::solenoidal_part(const VectorXd& velocity) const {
  return basis_ * mass_factor_.solve(basis_.transpose() * mass_.times(velocity));
}

VectorXd Stokes::forces(double t) const {
  VectorXd sum = traction_;
  if (scene_.body_acceleration) {
    const Vec2 b = scene_.body_acceleration(t);
    sum += b.x() * uniform_[0] + b.y() * uniform_[1];
  }
  if (scene_.acceleration_field)
    sum += space_.load([&](const VectorField& points, VectorField& values) {
      scene_.acceleration_field(points, t, values);
    });
  return sum;
}

Vec2 Stokes::impulse(const VectorXd& body, const std::vector<Stage>& stages, double dt,
                     const VectorXd& gained) const {
  VectorXd resistance;
  if (space_.axis(0).periodic() || space_.axis(1).periodic()) {
    resistance.setZero(basis_.cols());
    for (const Stage& stage : stages) resistance += stage.weight * dt * viscosity_->force(stage.w, stage.t);
  }
  Vec2 sum;
  for (const int a : {0, 1}) {
    const auto axis = static_cast<std::size_t>(a);
    const Eigen::Index first = a == 0 ? 0 : space_.size(0);
    // Of a velocity that is 1 everywhere all coefficients are 1.
    sum[a] = space_.axis(a).periodic()
                 ? body.segment(first, space_.size(a)).sum() - uniform_coordinates_[axis].dot(resistance)
                 : uniform_[axis].dot(gained);
  }
  return sum;
}

Stokes::Step Stokes::advanced(const VectorXd& start, double t, double dt,
                              IncompressibleScheme::Stepping rule) {
  const auto solved = [&](double a, double at, const VectorXd& load) {
    Viscosity::Solution stage = viscosity_->solved(a, at, basis_.transpose() * load, last_);
    last_ = stage.w;
    return stage;
  };
  const VectorXd momentum = mass_.times(start);
  if (rule == IncompressibleScheme::Stepping::Midpoint) {
    const double half = t + 0.5 * dt;
    const VectorXd f = forces(half);
    const auto middle = solved(0.5 * dt, half, momentum + 0.5 * dt * f);
    const VectorXd end = 2 * (basis_ * middle.w) - start;
    const std::vector<Stage> stages = {{middle.w, half, 1}};
    return {end, impulse(dt * f, stages, dt, end - start), middle.converged, stages};
  }
  const VectorXd f1 = forces(t + gamma * dt), f2 = forces(t + dt);
  const auto first = solved(gamma * dt, t + gamma * dt, momentum + gamma * dt * f1);
  const VectorXd rate = (basis_ * first.w - start) / (gamma * dt);
  const auto last =
      solved(gamma * dt, t + dt, momentum + mass_.times((1 - gamma) * dt * rate) + gamma * dt * f2);
  const VectorXd end = basis_ * last.w;
  const std::vector<Stage> stages = {{first.w, t + gamma * dt, 1 - gamma}, {last.w, t + dt, gamma}};
  const VectorXd body = (1 - gamma) * dt * f1 + gamma * dt * f2;
  return {end, impulse(body, stages, dt, end - start), first.converged && last.converged, stages};
}

std::optional<VectorXd> Stokes::load_of_pressure(const VectorXd& change, double dt,
                                                 const std::vector<Stage>& stages) const {
  VectorXd load = mass_.times(change) / dt;
  for (const Stage& stage : stages) {
    const auto resistance = viscosity_->force_on_velocities(stage.w, stage.t);
    if (!resistance) return std::nullopt;
    load += stage.weight * (*resistance - forces(stage.t));
  }
  return load;
}

}  // namespace mpm::incompressible

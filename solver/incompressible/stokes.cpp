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

}  // namespace

Stokes::Stokes(const Scene& scene, const VelocitySpace& space, const ExactMass& mass, double nu)
    : scene_(scene),
      space_(space),
      mass_(mass),
      nu_(nu),
      viscous_(space, scene),
      basis_(space.solenoidal_basis()),
      reduced_mass_((basis_.transpose() * mass.matrix() * basis_).pruned()),
      reduced_viscosity_((basis_.transpose() * viscous_.matrix() * basis_).pruned()),
      uniform_{uniform_load(space, 0), uniform_load(space, 1)} {
  mass_factor_.compute(reduced_mass_);
  if (mass_factor_.info() != Eigen::Success)
    throw SceneError("the mass of this grid could not be factorised");
}

VectorXd Stokes::solenoidal_part(const VectorXd& velocity) const {
  return basis_ * mass_factor_.solve(basis_.transpose() * mass_.times(velocity));
}

VectorXd Stokes::solved(double a, const VectorXd& load) {
  constexpr std::size_t most = 6;  // steps of a run differ where they end on an output
  std::unique_ptr<Factor>& factor = factors_[a];
  if (!factor) {
    if (factors_.size() > most) {
      factors_.clear();
      return solved(a, load);
    }
    factor = std::make_unique<Factor>(reduced_mass_ + (a * nu_) * reduced_viscosity_);
  }
  return basis_ * factor->solve(basis_.transpose() * load);
}

VectorXd Stokes::forces(double t) const {
  VectorXd sum = nu_ * viscous_.wall_load(t);
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

Vec2 Stokes::impulse(const VectorXd& summed_forces, const VectorXd& gained) const {
  Vec2 sum;
  for (const int a : {0, 1}) {
    const Eigen::Index first = a == 0 ? 0 : space_.size(0);
    // Of a velocity that is 1 everywhere all coefficients are 1.
    sum[a] = space_.axis(a).periodic() ? summed_forces.segment(first, space_.size(a)).sum()
                                       : uniform_[static_cast<std::size_t>(a)].dot(gained);
  }
  return sum;
}

Stokes::Step Stokes::advanced(const VectorXd& start, double t, double dt,
                              IncompressibleScheme::Stepping rule) {
  const VectorXd momentum = mass_.times(start);
  if (rule == IncompressibleScheme::Stepping::Midpoint) {
    const VectorXd f = forces(t + 0.5 * dt);
    const VectorXd middle = solved(0.5 * dt, momentum + 0.5 * dt * f);
    const VectorXd end = 2 * middle - start;
    return {end, impulse(dt * (f - nu_ * (viscous_.matrix() * middle)), end - start)};
  }
  const VectorXd f1 = forces(t + gamma * dt), f2 = forces(t + dt);
  const VectorXd first = solved(gamma * dt, momentum + gamma * dt * f1);
  const VectorXd rate = (first - start) / (gamma * dt);
  const VectorXd end = solved(gamma * dt, momentum + mass_.times((1 - gamma) * dt * rate) + gamma * dt * f2);
  const VectorXd total = (1 - gamma) * dt * (f1 - nu_ * (viscous_.matrix() * first)) +
                         gamma * dt * (f2 - nu_ * (viscous_.matrix() * end));
  return {end, impulse(total, end - start)};
}

}  // namespace mpm::incompressible

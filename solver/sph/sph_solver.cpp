#include "solver/sph/sph_solver.hpp"

#include <cmath>

#include "solver/kernel/isa.hpp"
#include "solver/scene/seeding.hpp"
#include "solver/sph/sph_breakdown.hpp"

namespace mpm::sph {

SphSolver::SphSolver(const Scene& scene, const SphScheme& scheme, int threads)
    : scene_(scene),
      loops_(pair_loops()),
      viscosities_(flow_curve()),
      viscosity_(scene.fluid.rheology),
      pressure_{scene.fluid.bulk_modulus, 1 / scene.fluid.density},
      has_pressure_(scene.fluid.pressure),
      sums_density_(has_pressure_ && scheme.density == SphScheme::Density::Summation),
      team_(threads),
      published_(seed_particles(scene)),
      near_(scene_, scheme, loops_.lanes),
      position_(published_.position),
      velocity_(published_.velocity),
      density_(published_.density),
      acceleration_(size(), Vec2::Zero()),
      extrapolated_(velocity_) {
  find_neighbours(0);
  evaluate(scene.start, 0);
}

void SphSolver::advance(double t, double dt) {
  double fastest = 0;
  for (std::size_t p = 0; p < size(); ++p) {
    extrapolated_[p] = velocity_[p] + dt * acceleration_[p];
    velocity_[p] += 0.5 * dt * acceleration_[p];
    position_[p] += dt * velocity_[p];
    fastest = std::max(fastest, velocity_[p].squaredNorm());
  }
  impulse_ += 0.5 * dt * force_;
  const double move = dt * std::sqrt(fastest);
  breakdown_ = breakdown_of(scene_, position_, velocity_, density_, move);
  if (breakdown_) return;
  if (near_.outdated_after(move)) find_neighbours(move);
  evaluate(t + dt, dt);
  for (std::size_t p = 0; p < size(); ++p) velocity_[p] += 0.5 * dt * acceleration_[p];
  impulse_ += 0.5 * dt * force_;
  is_published_ = false;
}

const Particles& SphSolver::particles() const {
  if (!is_published_) {
    published_.position = position_;
    for (Vec2& x : published_.position) wrap(x);
    published_.velocity = velocity_;
    published_.density = density_;
    is_published_ = true;
  }
  return published_;
}

VectorField SphSolver::grid_field(const VectorField& points, double t) const {
  VectorField velocities;
  for (const LocalFit& fit : near_.fits(points, velocity_, t)) velocities.push_back(fit.velocity);
  return velocities;
}

std::vector<Mat2> SphSolver::grid_gradient(const VectorField& points, double t) const {
  std::vector<Mat2> gradients;
  for (const LocalFit& fit : near_.fits(points, velocity_, t)) gradients.push_back(fit.gradient);
  return gradients;
}

void SphSolver::wrap(Vec2& x) const {
  for (const int axis : {0, 1})
    if (scene_.periodic(axis)) x[axis] -= scene_.size[axis] * std::floor(x[axis] / scene_.size[axis]);
}

void SphSolver::find_neighbours(double move) {
  for (Vec2& x : position_) wrap(x);
  near_.find(position_, published_.mass, viscosity_.constant(), move);
}

void SphSolver::evaluate(double t, double dt) {
  gravity_ = scene_.body_acceleration ? scene_.body_acceleration(t) : Vec2(Vec2::Zero());
  near_.place(position_);
  has_slopes_ = false;
  const PairWork work = near_.work(gravity_);
  if (has_pressure_) find_density(work, t, dt);
  near_.carry(extrapolated_, t);
  if (has_pressure_)
    near_.press(
        density_, [&](double density) { return pressure_.pressure(density); }, t, gravity_);
  else
    near_.press(
        density_, [](double) { return 0.0; }, t, gravity_);
  if (viscosity_.varies()) find_viscosities(work);
  const PairLoop loop = viscosity_.varies() ? loops_.find_acceleration_whole : loops_.find_acceleration;
  for_groups_with_slopes(work, [&](int first, int end) { loop(work, first, end); });
  take_acceleration(t);
}

void SphSolver::find_density(const PairWork& work, double t, double dt) {
  const ScalarField& sum = near_.sums().density;
  if (sums_density_) {
    for_groups([&](int first, int end) { loops_.sum_density(work, first, end); });
    for (std::size_t p = 0; p < size(); ++p) density_[p] = sum[near_.windows().place(p)];
  } else if (dt > 0) {
    near_.carry(velocity_, t - 0.5 * dt);
    for_groups_with_slopes(work, [&](int first, int end) { loops_.find_density_rate(work, first, end); });
    for (std::size_t p = 0; p < size(); ++p) density_[p] += dt * sum[near_.windows().place(p)];
  }
}

void SphSolver::find_viscosities(const PairWork& work) {
  strain_rate_.resize(near_.windows().places());
  by_place_.resize(near_.windows().places());
  for_groups_with_slopes(work, [&](int first, int end) {
    loops_.find_velocity_gradient(work, first, end);
    const auto& [xx, xy, yx, yy] = near_.sums().velocity_gradient;
    const auto begin = static_cast<std::size_t>(first * loops_.lanes);
    const auto count = static_cast<std::size_t>((end - first) * loops_.lanes);
    for (std::size_t k = begin; k < begin + count; ++k) {
      const double shear = xy[k] + yx[k];
      strain_rate_[k] = 2 * (xx[k] * xx[k] + yy[k] * yy[k]) + shear * shear;
    }
    viscosities_(scene_.fluid.rheology, static_cast<int>(count), &strain_rate_[begin], &by_place_[begin]);
  });
  near_.strain(by_place_);
}

void SphSolver::take_acceleration(double t) {
  const PairSums& sums = near_.sums();
  force_ = Vec2::Zero();
  for (std::size_t p = 0; p < size(); ++p) {
    const std::size_t place = near_.windows().place(p);
    acceleration_[p] = Vec2(sums.acceleration[0][place], sums.acceleration[1][place]) + gravity_;
    force_ += published_.mass[p] *
              (gravity_ + Vec2(sums.wall_acceleration[0][place], sums.wall_acceleration[1][place]));
  }
  if (!scene_.acceleration_field) return;
  field_acceleration_.resize(size());
  scene_.acceleration_field(position_, t, field_acceleration_);
  for (std::size_t p = 0; p < size(); ++p) {
    acceleration_[p] += field_acceleration_[p];
    force_ += published_.mass[p] * field_acceleration_[p];
  }
}

}  // namespace mpm::sph

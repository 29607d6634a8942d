#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "solver/kernel/thread_team.hpp"
#include "solver/scene/seeding.hpp"
#include "solver/simulation.hpp"
#include "solver/sph/local_fit.hpp"
#include "solver/sph/neighbour_list.hpp"
#include "solver/sph/smoothing_kernel.hpp"
#include "solver/sph/stable_sph_step.hpp"
#include "solver/sph/surroundings.hpp"

namespace mpm::sph {

/// Smoothed particle hydrodynamics of a weakly compressible fluid (Morris, Fox & Zhu 1997), in the plane:
///   dv_i/dt = - sum_j m_j (P_i/rho_i^2 + P_j/rho_j^2) F x_ij + sum_j m_j (mu_i + mu_j)/(rho_i rho_j) F v_ij
///   + g drho_i/dt = sum_j m_j F x_ij . v_ij,  or  rho_i = sum_j m_j W
/// with x_ij = x_i - x_j and F = W'(r)/r. (Morris' r^2/(r^2 + 0.01 h^2) guards a quotient that F does not
/// have.) The viscous term is the divergence of mu grad v, without its transpose: exact for constant
/// viscosity and for shear flows. Pairs push each other equally, so momentum changes by body and wall forces
/// alone.
///
/// Time: velocity Verlet. The velocity at the middle of the step moves the particles and changes densities,
/// which holds sound neutrally stable (omega dt <= 2); viscosity sees the velocity extrapolated by a whole
/// step, second order and stable for lambda dt <= 1.
///
/// Every particle gathers from its neighbours in the order of its list: any number of threads, the same bits.
template <class Rheology, class Pressure>
class SphSolver final : public Simulation {
 public:
  SphSolver(const Scene& scene, const SphScheme& scheme, const Rheology& rheology, const Pressure& pressure,
            int threads)
      : scene_(scene),
        scheme_(scheme),
        rheology_(rheology),
        pressure_(pressure),
        team_(threads),
        published_(seed_particles(scene)),
        kernel_(kernel_of(scheme, scene)),
        skin_(skin_share * kernel_.radius),
        surroundings_(scene_, scheme.wall, kernel_.radius + skin_),
        position_(published_.position),
        velocity_(published_.velocity),
        density_(published_.density),
        acceleration_(size(), Vec2::Zero()),
        wall_force_(size(), Vec2::Zero()),
        density_rate_(size(), 0.0),
        extrapolated_(velocity_) {
    find_neighbours();
    evaluate(scene.start, 0);
  }

  void advance(double t, double dt) override {
    double fastest = 0;
    for (std::size_t p = 0; p < size(); ++p) {
      extrapolated_[p] = velocity_[p] + dt * acceleration_[p];
      velocity_[p] += 0.5 * dt * acceleration_[p];
      position_[p] += dt * velocity_[p];
      fastest = std::max(fastest, velocity_[p].squaredNorm());
    }
    impulse_ += 0.5 * dt * force_;
    judge(dt * std::sqrt(fastest));
    if (breakdown_) return;
    moved_ += dt * std::sqrt(fastest);
    if (2 * moved_ >= skin_) find_neighbours();
    evaluate(t + dt, dt);
    for (std::size_t p = 0; p < size(); ++p) velocity_[p] += 0.5 * dt * acceleration_[p];
    impulse_ += 0.5 * dt * force_;
    is_published_ = false;
  }

  [[nodiscard]] std::optional<std::string> breakdown() const override { return breakdown_; }

  /// Positions wrapped into the domain.
  [[nodiscard]] const Particles& particles() const override {
    if (!is_published_) {
      published_.position = position_;
      for (Vec2& x : published_.position) wrap(x);
      published_.velocity = velocity_;
      published_.density = density_;
      is_published_ = true;
    }
    return published_;
  }

  /// By a local fit, since SPH has no grid. On a wall it is the wall's velocity where images mirror the
  /// fluid; beside fixed wall particles what the fluid itself shows.
  [[nodiscard]] VectorField grid_field(const VectorField& points, double t) const override {
    VectorField velocities;
    for (const LocalFit& fit : fits(points, t)) velocities.push_back(fit.velocity);
    return velocities;
  }

  [[nodiscard]] std::vector<Mat2> grid_gradient(const VectorField& points, double t) const override {
    std::vector<Mat2> gradients;
    for (const LocalFit& fit : fits(points, t)) gradients.push_back(fit.gradient);
    return gradients;
  }

  [[nodiscard]] Totals totals() const override { return totals_of(particles(), impulse_); }

 private:
  static constexpr std::size_t block = 128;
  static constexpr bool generalised = Rheology::needs_shear_rate;

  [[nodiscard]] std::size_t size() const { return published_.size(); }
  [[nodiscard]] bool sums_density() const {
    return Pressure::varies && scheme_.density == SphScheme::Density::Summation;
  }

  /// loop(p) for every particle, shared out in blocks.
  template <class Loop>
  void for_particles(const Loop& loop) {
    team_.run(static_cast<int>((size() + block - 1) / block), [&](int share) {
      const std::size_t begin = static_cast<std::size_t>(share) * block;
      const std::size_t end = std::min(begin + block, size());
      for (std::size_t p = begin; p < end; ++p) loop(p);
    });
  }

  void wrap(Vec2& x) const {
    for (const int axis : {0, 1})
      if (scene_.periodic(axis)) x[axis] -= scene_.size[axis] * std::floor(x[axis] / scene_.size[axis]);
  }

  void find_neighbours() {
    for (Vec2& x : position_) wrap(x);
    surroundings_.rebuild(position_);
    entries_.resize(surroundings_.size());
    refresh(scene_.start);
    list_.rebuild(entries_, size(), surroundings_.wall_begin(), kernel_.radius + skin_);
    moved_ = 0;
  }

  /// Entries of the fluid as it stands, with the velocities that forces act on, and their surroundings.
  void refresh(double t) {
    fill_fluid(entries_, extrapolated_);
    surroundings_.fill(entries_, t, gravity_);
  }

  void fill_fluid(std::vector<Neighbour>& entries, const VectorField& velocity) const {
    for (std::size_t p = 0; p < size(); ++p) {
      Neighbour& entry = entries[p];
      entry.position = position_[p];
      entry.velocity = velocity[p];
      entry.mass = published_.mass[p];
      entry.inverse_density = 1 / density_[p];
      entry.pressure_term = pressure_.pressure(density_[p]) * entry.inverse_density * entry.inverse_density;
    }
  }

  /// Density, viscosity, and the acceleration at time t [s] after a step of dt.
  void evaluate(double t, double dt) {
    const bool follows_density = Pressure::varies && !sums_density();
    gravity_ = scene_.body_acceleration ? scene_.body_acceleration(t) : Vec2(Vec2::Zero());
    if constexpr (Pressure::varies) {
      if (sums_density()) {
        refresh(t);
        sum_density();
      } else if (dt > 0) {
        fill_fluid(entries_, velocity_);
        surroundings_.fill(entries_, t - 0.5 * dt, gravity_);
        slope_.resize(list_.pairs());
        for_particles([&](std::size_t p) { density_rate_[p] = density_rate(p); });
        for (std::size_t p = 0; p < size(); ++p) density_[p] += dt * density_rate_[p];
      }
    }
    if constexpr (generalised) {
      refresh(t);
      team_.run(static_cast<int>((size() + block - 1) / block), [&](int share) { find_viscosities(share); });
    } else {
      for (std::size_t p = 0; p < size(); ++p) entries_[p].viscosity = rheology_.viscosity();
    }
    refresh(t);
    if (follows_density && dt > 0)
      for_particles([&](std::size_t p) { find_acceleration(p, kept_slope(p)); });
    else
      for_particles([&](std::size_t p) { find_acceleration(p, fresh_slope()); });
    add_body_forces(t);
  }

  /// Calls pair(neighbour, x_ij, F) for the neighbours of a particle, then wall_pair(entry, x_ij, F) for
  /// those of walls. `slope(r^2)` gives F.
  template <class Slope, class Pair, class WallPair>
  void for_pairs(std::size_t p, Slope slope, const Pair& pair, const WallPair& wall_pair) const {
    const Vec2 x = entries_[p].position;
    for (const std::uint32_t e : list_.inner(p)) {
      const Vec2 d = x - entries_[e].position;
      pair(entries_[e], d, slope(d));
    }
    for (const std::uint32_t e : list_.wall(p)) {
      const Vec2 d = x - entries_[e].position;
      wall_pair(e, d, slope(d));
    }
  }

  [[nodiscard]] auto fresh_slope() const {
    return [this](const Vec2& d) { return kernel_.gradient(d.squaredNorm()); };
  }
  [[nodiscard]] auto kept_slope(std::size_t p) const {
    return [slope = slope_.data() + list_.first_pair(p)](const Vec2&) mutable { return *slope++; };
  }

  /// The pairs' F is kept: positions stay until the acceleration has been taken.
  double density_rate(std::size_t p) {
    const Vec2 x = entries_[p].position, v = entries_[p].velocity;
    double rate = 0;
    double* slope = slope_.data() + list_.first_pair(p);
    for (const std::uint32_t e : list_.all(p)) {
      const Neighbour& n = entries_[e];
      const Vec2 d = x - n.position;
      *slope = kernel_.gradient(d.squaredNorm());
      rate += n.mass * *slope++ * d.dot(v - n.velocity);
    }
    return rate;
  }

  void sum_density() {
    for_particles([&](std::size_t p) {
      const Vec2 x = entries_[p].position;
      double sum = entries_[p].mass * kernel_.weight(0);
      const auto add = [&](std::uint32_t e) {
        sum += entries_[e].mass * kernel_.weight((entries_[e].position - x).squaredNorm());
      };
      for (const std::uint32_t e : list_.inner(p)) add(e);
      for (const std::uint32_t e : list_.wall(p)) add(e);
      density_[p] = sum;
    });
  }

  /// Viscosities of a block of particles from gdot^2 = 2 D:D, in one call on an array.
  void find_viscosities(int share) {
    using Array = Eigen::Array<double, static_cast<int>(block), 1>;
    const std::size_t begin = static_cast<std::size_t>(share) * block;
    const std::size_t count = std::min(block, size() - begin);
    Array gdot_squared = Array::Ones();  // beyond `count` a harmless value
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t p = begin + k;
      Mat2 l = Mat2::Zero();
      const auto add = [&](const Vec2& dv, const Vec2& d, double volume_f) {
        l -= volume_f * dv * d.transpose();
      };
      for_pairs(
          p, fresh_slope(),
          [&](const Neighbour& n, const Vec2& d, double f) {
            add(entries_[p].velocity - n.velocity, d, n.mass * n.inverse_density * f);
          },
          [&](std::uint32_t e, const Vec2& d, double f) {
            const Neighbour& n = entries_[e];
            add(velocity_to_wall(p, e), d, n.mass * n.inverse_density * f);
          });
      gdot_squared[static_cast<Eigen::Index>(k)] = (l + l.transpose()).squaredNorm() / 2;
    }
    if constexpr (generalised) {
      const Array mu = rheology_.viscosity(gdot_squared);
      for (std::size_t k = 0; k < count; ++k)
        entries_[begin + k].viscosity = mu[static_cast<Eigen::Index>(k)];
    }
  }

  /// v_i - v_j of a neighbour that belongs to a wall. A fixed particle's velocity is extrapolated from the
  /// particle's own through the wall, linearly, but by no more than the limit (Morris et al., Eq. 35).
  [[nodiscard]] Vec2 velocity_to_wall(std::size_t p, std::uint32_t e) const {
    const Vec2 difference = entries_[p].velocity - entries_[e].velocity;
    if (!surroundings_.has_fixed()) return difference;
    const Surroundings::Fixed& fixed = surroundings_.fixed(e);
    const double distance = surroundings_.distance(entries_[p].position, fixed.edge);
    const double factor = distance > 0 ? 1 + fixed.depth / distance : scheme_.wall_limit;
    return std::min(factor, scheme_.wall_limit) * difference;
  }

  template <class Slope>
  void find_acceleration(std::size_t p, const Slope& slope) {
    const Neighbour& own = entries_[p];
    Vec2 sum = Vec2::Zero();
    const auto add = [&](const Vec2& d, const Vec2& dv, double mass_f, double pressures, double viscosities) {
      if constexpr (Pressure::varies)
        sum += mass_f * (viscosities * dv - pressures * d);
      else
        sum += mass_f * viscosities * dv;
    };
    Vec2 from_walls = Vec2::Zero();
    for_pairs(
        p, slope,
        [&](const Neighbour& n, const Vec2& d, double f) {
          add(d, own.velocity - n.velocity, n.mass * f, own.pressure_term + n.pressure_term,
              (own.viscosity + n.viscosity) * own.inverse_density * n.inverse_density);
        },
        [&](std::uint32_t e, const Vec2& d, double f) {
          Neighbour n = entries_[e];
          if (surroundings_.has_fixed()) {  // carries the particle's own state, as behind a mirror
            n.viscosity = own.viscosity;
            n.inverse_density = own.inverse_density;
            const auto axis = static_cast<int>(surroundings_.fixed(e).edge) / 2;
            n.pressure_term = own.pressure_term - own.inverse_density * gravity_[axis] * d[axis];
          }
          const double mass_f = n.mass * f;
          const double viscosities = (own.viscosity + n.viscosity) * own.inverse_density * n.inverse_density;
          const double pressures = own.pressure_term + n.pressure_term;
          const Vec2 dv = velocity_to_wall(p, e);
          add(d, dv, mass_f, pressures, viscosities);
          from_walls += mass_f * (viscosities * dv - pressures * d);
        });
    acceleration_[p] = sum;
    wall_force_[p] = own.mass * from_walls;
  }

  void add_body_forces(double t) {
    if (scene_.acceleration_field) {
      field_acceleration_.resize(size());
      scene_.acceleration_field(position_, t, field_acceleration_);
    }
    force_ = Vec2::Zero();
    for (std::size_t p = 0; p < size(); ++p) {
      Vec2 body = gravity_;
      if (scene_.acceleration_field) body += field_acceleration_[p];
      acceleration_[p] += body;
      force_ += published_.mass[p] * body + wall_force_[p];
    }
  }

  /// A step longer than the box leaves places that no list of neighbours can be made of.
  void judge(double longest_move) {
    double energy = 0;
    bool inside = true, dense = true;
    for (std::size_t p = 0; p < size(); ++p) {
      energy += velocity_[p].squaredNorm();
      dense &= density_[p] > 0;
      for (const int axis : {0, 1})
        inside &=
            scene_.periodic(axis) || (position_[p][axis] >= 0 && position_[p][axis] <= scene_.size[axis]);
    }
    if (!std::isfinite(energy))
      breakdown_ = "velocity is not finite";
    else if (longest_move > scene_.size.minCoeff())
      breakdown_ = "a particle crossed the domain in one step";
    else if (!inside)
      breakdown_ = "a particle left the domain";
    else if (!dense)
      breakdown_ = "density is not positive";
  }

  [[nodiscard]] std::vector<LocalFit> fits(const VectorField& points, double t) const {
    std::vector<Neighbour> entries = entries_;
    fill_fluid(entries, velocity_);
    surroundings_.fill(entries, t, Vec2::Zero());
    const std::size_t end = surroundings_.has_fixed() ? surroundings_.wall_begin() : entries.size();
    std::vector<LocalFit> found;
    found.reserve(points.size());
    for (const Vec2& point : points) found.push_back(fit_at(point, entries, end, list_, kernel_));
    return found;
  }

  const Scene scene_;  // its own: whoever made it may be gone
  SphScheme scheme_;
  Rheology rheology_;
  Pressure pressure_;
  ThreadTeam team_;
  mutable Particles published_;  // masses, and what particles() shows of the rest
  mutable bool is_published_ = true;
  SmoothingKernel kernel_;
  double skin_;
  Surroundings surroundings_;
  NeighbourList list_;
  std::vector<Neighbour> entries_;
  VectorField position_, velocity_;
  ScalarField density_;
  VectorField acceleration_, wall_force_, field_acceleration_;
  ScalarField density_rate_, slope_;
  VectorField extrapolated_;
  Vec2 gravity_ = Vec2::Zero(), force_ = Vec2::Zero(), impulse_ = Vec2::Zero();
  double moved_ = 0;
  std::optional<std::string> breakdown_;
};

}  // namespace mpm::sph

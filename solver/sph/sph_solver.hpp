#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "solver/kernel/threads/thread_team.hpp"
#include "solver/scene/seeding.hpp"
#include "solver/simulation.hpp"
#include "solver/sph/neighbourhood.hpp"
#include "solver/sph/sph_breakdown.hpp"

namespace mpm::sph {

/// Smoothed particle hydrodynamics of a weakly compressible fluid (Morris, Fox & Zhu 1997), in the plane:
///   dv_i/dt = - sum_j m_j (P_i/rho_i^2 + P_j/rho_j^2) F x_ij + sum_j m_j (mu_i + mu_j)/(rho_i rho_j) F v_ij
///   + g drho_i/dt = sum_j m_j F x_ij . v_ij,  or  rho_i = sum_j m_j W
/// with x_ij = x_i - x_j and F = W'(r)/r. (Morris' r^2/(r^2 + 0.01 h^2) guards a quotient that F does not
/// have.) This viscous term is the divergence of mu grad v, all of it where viscosity is constant and the
/// divergence zero. A viscosity that varies adds the rest of 2 mu (D - tr D/3),
///   1/rho_i sum_j m_j/rho_j (T_i + T_j) F x_ij,  T = mu (L^T - 2/3 tr L),  L_i = - sum_j m_j/rho_j v_ij F
///   x_ij^T
/// (the form of the pressure's term; Monaghan 2005, Eq. 3.4). Pairs push each other equally, so momentum
/// changes by body and wall forces alone.
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
        near_(scene_, scheme),
        position_(published_.position),
        velocity_(published_.velocity),
        density_(published_.density),
        acceleration_(size(), Vec2::Zero()),
        wall_force_(size(), Vec2::Zero()),
        density_rate_(size(), 0.0),
        extrapolated_(velocity_) {
    find_neighbours(0);
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
    breakdown_ = breakdown_of(scene_, position_, velocity_, density_, dt * std::sqrt(fastest));
    if (breakdown_) return;
    const double move = dt * std::sqrt(fastest);
    if (near_.outdated_after(move)) find_neighbours(move);
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

  void find_neighbours(double move) {
    for (Vec2& x : position_) wrap(x);
    near_.surround(position_);
    refresh(scene_.start);
    near_.list_pairs(size(), move);
  }

  /// Entries of the fluid as it stands, with the velocities that forces act on, and their surroundings.
  void refresh(double t) { fill(near_.entries(), extrapolated_, t, gravity_); }

  void fill(std::vector<Neighbour>& entries, const VectorField& velocity, double t,
            const Vec2& gravity) const {
    for (std::size_t p = 0; p < size(); ++p) {
      Neighbour& entry = entries[p];
      entry.position = position_[p];
      entry.velocity = velocity[p];
      entry.mass = published_.mass[p];
      entry.inverse_density = 1 / density_[p];
      entry.pressure_term = pressure_.pressure(density_[p]) * entry.inverse_density * entry.inverse_density;
    }
    near_.surroundings().fill(entries, t, gravity);
  }

  /// Density, viscosity, and the acceleration at time t [s] after a step of dt.
  void evaluate(double t, double dt) {
    const bool keeps_slopes = Pressure::varies && !sums_density() && dt > 0;
    gravity_ = scene_.body_acceleration ? scene_.body_acceleration(t) : Vec2(Vec2::Zero());
    if constexpr (Pressure::varies) {
      if (sums_density()) {
        refresh(t);
        sum_density();
      } else if (dt > 0) {
        fill(near_.entries(), velocity_, t - 0.5 * dt, gravity_);
        near_.make_room_for_slopes();
        for_particles([&](std::size_t p) { density_rate_[p] = density_rate(p); });
        for (std::size_t p = 0; p < size(); ++p) density_[p] += dt * density_rate_[p];
      }
    }
    if constexpr (generalised) {
      refresh(t);
      stress_.resize(near_.entries().size());
      team_.run(static_cast<int>((size() + block - 1) / block),
                [&](int share) { find_viscosities(share, keeps_slopes); });
      near_.surroundings().fill(stress_);
    } else {
      for (std::size_t p = 0; p < size(); ++p) near_.entries()[p].viscosity = rheology_.viscosity();
    }
    refresh(t);
    if (keeps_slopes)
      for_particles([&](std::size_t p) { find_acceleration(p, near_.kept_slope(p)); });
    else
      for_particles([&](std::size_t p) { find_acceleration(p, near_.fresh_slope()); });
    add_body_forces(t);
  }

  /// The pairs' F is kept: positions stay until the acceleration has been taken.
  double density_rate(std::size_t p) {
    const Vec2 v = near_.entries()[p].velocity;
    double rate = 0;
    near_.for_pairs_keeping_slopes(p, [&](std::uint32_t e, const Vec2& d, double f) {
      const Neighbour& n = near_.entries()[e];
      rate += n.mass * f * d.dot(v - n.velocity);
    });
    return rate;
  }

  void sum_density() {
    const SmoothingKernel& kernel = near_.kernel();
    for_particles([&](std::size_t p) {
      double sum = near_.entries()[p].mass * kernel.weight(0);
      const auto add = [&](std::uint32_t e, const Vec2&, double w) { sum += near_.entries()[e].mass * w; };
      near_.for_pairs(
          p, [&](const Vec2& d) { return kernel.weight(d.squaredNorm()); }, add, add);
      density_[p] = sum;
    });
  }

  /// L = grad v of a particle, by differences.
  template <class Slope>
  [[nodiscard]] Mat2 velocity_gradient(std::size_t p, const Slope& slope) const {
    const std::vector<Neighbour>& entries = near_.entries();
    double xx = 0, xy = 0, yx = 0, yy = 0;
    const auto add = [&](const Vec2& dv, const Vec2& d, double volume_f) {
      xx -= volume_f * dv.x() * d.x();
      xy -= volume_f * dv.x() * d.y();
      yx -= volume_f * dv.y() * d.x();
      yy -= volume_f * dv.y() * d.y();
    };
    near_.for_pairs(
        p, slope,
        [&](std::uint32_t e, const Vec2& d, double f) {
          const Neighbour& n = entries[e];
          add(entries[p].velocity - n.velocity, d, n.mass * n.inverse_density * f);
        },
        [&](std::uint32_t e, const Vec2& d, double f) {
          const Neighbour& n = entries[e];
          add(near_.velocity_to_wall(p, e), d, n.mass * n.inverse_density * f);
        });
    Mat2 l;
    l << xx, xy, yx, yy;
    return l;
  }

  /// Viscosities of a block of particles from gdot^2 = 2 D:D, in one call on an array, and mu L.
  void find_viscosities(int share, bool keeps_slopes) {
    using Array = Eigen::Array<double, static_cast<int>(block), 1>;
    const std::size_t begin = static_cast<std::size_t>(share) * block;
    const std::size_t count = std::min(block, size() - begin);
    Array gdot_squared = Array::Ones();  // beyond `count` a harmless value
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t p = begin + k;
      const Mat2 l = stress_[p] = keeps_slopes ? velocity_gradient(p, near_.kept_slope(p))
                                               : velocity_gradient(p, near_.fresh_slope());
      gdot_squared[static_cast<Eigen::Index>(k)] = (l + l.transpose()).squaredNorm() / 2;
    }
    if constexpr (generalised) {
      const Array mu = rheology_.viscosity(gdot_squared);
      for (std::size_t k = 0; k < count; ++k) {
        const double viscosity = mu[static_cast<Eigen::Index>(k)];
        near_.entries()[begin + k].viscosity = viscosity;
        stress_[begin + k] *= viscosity;
      }
    }
  }

  /// (T_i + T_j) x_ij of a pair, from their mu L. Term by term: the compiler calls the products of Mat2.
  [[nodiscard]] static Vec2 transposed_part(const Mat2& a, const Mat2& b, const Vec2& d) {
    const double xx = a(0, 0) + b(0, 0), yy = a(1, 1) + b(1, 1), third = 2.0 / 3.0 * (xx + yy);
    return {(xx - third) * d.x() + (a(1, 0) + b(1, 0)) * d.y(),
            (a(0, 1) + b(0, 1)) * d.x() + (yy - third) * d.y()};
  }

  template <class Slope>
  void find_acceleration(std::size_t p, const Slope& slope) {
    const std::vector<Neighbour>& entries = near_.entries();
    const Surroundings& surroundings = near_.surroundings();
    const Neighbour& own = entries[p];
    const auto of_pair = [&](const Neighbour& n, std::size_t e, const Vec2& d, const Vec2& dv, double f) {
      const double mass_f = n.mass * f, volumes = own.inverse_density * n.inverse_density;
      Vec2 viscous = (own.viscosity + n.viscosity) * volumes * dv;
      if constexpr (generalised) viscous += volumes * transposed_part(stress_[p], stress_[e], d);
      if constexpr (Pressure::varies)
        return Vec2(mass_f * (viscous - (own.pressure_term + n.pressure_term) * d));
      else
        return Vec2(mass_f * viscous);
    };
    Vec2 sum = Vec2::Zero(), from_walls = Vec2::Zero();
    near_.for_pairs(
        p, slope,
        [&](std::uint32_t e, const Vec2& d, double f) {
          sum += of_pair(entries[e], e, d, own.velocity - entries[e].velocity, f);
        },
        [&](std::uint32_t e, const Vec2& d, double f) {
          Neighbour n = entries[e];
          if (surroundings.has_fixed()) {  // carries the particle's own state, as behind a mirror
            n.viscosity = own.viscosity;
            n.inverse_density = own.inverse_density;
            const auto axis = static_cast<int>(surroundings.fixed(e).edge) / 2;
            n.pressure_term = own.pressure_term - own.inverse_density * gravity_[axis] * d[axis];
          }
          const std::size_t state = surroundings.has_fixed() ? p : e;
          const Vec2 pair = of_pair(n, state, d, near_.velocity_to_wall(p, e), f);
          sum += pair;
          from_walls += pair;
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

  [[nodiscard]] std::vector<LocalFit> fits(const VectorField& points, double t) const {
    std::vector<Neighbour> entries = near_.entries();
    fill(entries, velocity_, t, Vec2::Zero());
    return near_.fits(points, entries);
  }

  const Scene scene_;  // its own: whoever made it may be gone
  SphScheme scheme_;
  Rheology rheology_;
  Pressure pressure_;
  ThreadTeam team_;
  mutable Particles published_;  // masses, and what particles() shows of the rest
  mutable bool is_published_ = true;
  Neighbourhood near_;
  VectorField position_, velocity_;
  ScalarField density_;
  VectorField acceleration_, wall_force_, field_acceleration_;
  ScalarField density_rate_;
  VectorField extrapolated_;
  std::vector<Mat2> stress_;  // mu L of every entry; empty where viscosity is constant
  Vec2 gravity_ = Vec2::Zero(), force_ = Vec2::Zero(), impulse_ = Vec2::Zero();
  std::optional<std::string> breakdown_;
};

}  // namespace mpm::sph

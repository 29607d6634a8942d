#pragma once

#include <algorithm>

#include "solver/incompressible/lanes/site_kernel.hpp"
#include "solver/kernel/threads/thread_team.hpp"
#include "solver/material/block_viscosity.hpp"
#include "solver/material/pressure.hpp"
#include "solver/simulation.hpp"
#include "solver/sph/neighbourhood.hpp"

namespace mpm::sph {

/// Smoothed particle hydrodynamics of a weakly compressible fluid (Morris, Fox & Zhu 1997), in the plane:
///   dv_i/dt = - sum_j m_j (P_i/rho_i^2 + P_j/rho_j^2) F x_ij
///             + sum_j m_j (mu_i + mu_j)/(rho_i rho_j) F v_ij + g,
///   drho_i/dt = sum_j m_j F x_ij . v_ij,  or  rho_i = sum_j m_j W,
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
/// Every particle gathers from its neighbours in the order of its windows: any number of threads, the same
/// bits. The loops over pairs are those of pairs/pair_loops.hpp.
class SphSolver final : public Simulation {
 public:
  SphSolver(const Scene& scene, const SphScheme& scheme, int threads);

  void advance(double t, double dt) override;

  [[nodiscard]] std::optional<std::string> breakdown() const override { return breakdown_; }
  /// Positions wrapped into the domain.
  [[nodiscard]] const Particles& particles() const override;
  /// By a local fit, since SPH has no grid. On a wall it is the wall's velocity where images mirror the
  /// fluid; beside fixed wall particles what the fluid itself shows.
  [[nodiscard]] VectorField grid_field(const VectorField& points, double t) const override;
  [[nodiscard]] std::vector<Mat2> grid_gradient(const VectorField& points, double t) const override;
  [[nodiscard]] Totals totals() const override { return totals_of(particles(), impulse_); }

 private:
  [[nodiscard]] std::size_t size() const { return published_.size(); }
  void wrap(Vec2& x) const;

  void find_neighbours(double move);
  /// Density, viscosity, and the acceleration at time t [s] after a step of dt.
  void evaluate(double t, double dt);
  void find_density(const PairWork& work, double t, double dt);
  void find_viscosities(const PairWork& work);
  void take_acceleration(double t);

  /// loop(first group, end) for all groups, shared out in blocks of some 128 particles.
  template <class Loop>
  void for_groups(const Loop& loop) {
    const int groups = static_cast<int>(near_.windows().groups().size()), block = 128 / loops_.lanes;
    team_.run((groups + block - 1) / block,
              [&](int share) { loop(share * block, std::min((share + 1) * block, groups)); });
  }
  /// One that reads the F of pairs, which are found where the first one after a move needs them.
  template <class Loop>
  void for_groups_with_slopes(const PairWork& work, const Loop& loop) {
    for_groups([&](int first, int end) {
      if (!has_slopes_) loops_.find_slopes(work, first, end);
      loop(first, end);
    });
    has_slopes_ = true;
  }

  const Scene scene_;  // its own: whoever made it may be gone
  PairLoops loops_;
  FlowCurve viscosities_;
  BlockViscosity viscosity_;
  TaitPressure pressure_;
  bool has_pressure_, sums_density_;
  ThreadTeam team_;
  mutable Particles published_;  // masses, and what particles() shows of the rest
  mutable bool is_published_ = true;
  Neighbourhood near_;
  VectorField position_, velocity_;
  ScalarField density_;
  VectorField acceleration_, field_acceleration_;
  VectorField extrapolated_;
  ScalarField strain_rate_, by_place_;  // gdot^2 [1/s2] and viscosity [Pa s] by place
  bool has_slopes_ = false;
  Vec2 gravity_ = Vec2::Zero(), force_ = Vec2::Zero(), impulse_ = Vec2::Zero();
  std::optional<std::string> breakdown_;
};

}  // namespace mpm::sph

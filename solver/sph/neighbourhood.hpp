#pragma once

#include <vector>

#include "solver/scene/scene.hpp"
#include "solver/sph/local_fit.hpp"
#include "solver/sph/pairs/entries.hpp"
#include "solver/sph/pairs/entry_rows.hpp"
#include "solver/sph/pairs/pair_windows.hpp"
#include "solver/sph/smoothing_kernel.hpp"
#include "solver/sph/surroundings.hpp"

namespace mpm::sph {

/// Sums over pairs, with a place for every particle (PairWindows::place).
struct PairSums {
  ScalarField density;                           ///< or its rate
  std::array<ScalarField, 4> velocity_gradient;  ///< L, row by row [1/s]
  std::array<ScalarField, 2> acceleration;       ///< [m/s2]
  std::array<ScalarField, 2> wall_acceleration;  ///< the part that walls give
};

/// Who is near each particle: the fluid and its surroundings as entries, windows of pairs that stay valid
/// while particles move by less than half their skin, and what loops over the pairs read and write.
class Neighbourhood {
 public:
  /// The scene must outlive it. `lanes` of the pair loops.
  Neighbourhood(const Scene& scene, const SphScheme& scheme, int lanes);

  /// Chooses copies and images for the fluid at these places, which lie in the domain, and finds the pairs.
  /// `viscosity` [Pa s]: of all entries, until strain() says otherwise. `move`: how far particles moved in
  /// the last step, at most [m].
  void find(const VectorField& position, const ScalarField& mass, double viscosity, double move);
  /// Counts a move of at most `distance` [m] of every particle; whether the windows have become too old.
  bool outdated_after(double distance) {
    moved_ += distance;
    return 2 * moved_ >= skin_;
  }

  // The state of the fluid, which its surroundings follow.

  void place(const VectorField& position);
  /// Velocities at time t [s].
  void carry(const VectorField& velocity, double t) { carry(entries_, velocity, t); }
  /// Densities [kg/m3], and pressure(rho) [Pa]. `gravity` [m/s2]: what a mirrored pressure rises with.
  template <class Pressure>
  void press(const ScalarField& density, const Pressure& pressure, double t, const Vec2& gravity) {
    for (std::size_t p = 0; p < density.size(); ++p) {
      const double volume = 1 / density[p];
      entries_.inverse_density[rows_.slots()[p]] = volume;
      entries_.pressure_term[rows_.slots()[p]] = pressure(density[p]) * volume * volume;
    }
    surroundings_.press(entries_, rows_.slots(), t, gravity);
  }
  /// Viscosities [Pa s], by place, and mu L from the sums' L.
  void strain(const ScalarField& viscosity);

  [[nodiscard]] const PairWindows& windows() const { return windows_; }
  [[nodiscard]] PairSums& sums() { return sums_; }
  /// Valid until find().
  [[nodiscard]] PairWork work(const Vec2& gravity);

  /// Fits at points to the fluid and its surroundings with these velocities at time t; fixed wall particles,
  /// whose velocity nobody extrapolated, take no part.
  [[nodiscard]] std::vector<LocalFit> fits(const VectorField& points, const VectorField& velocity,
                                           double t) const;

 private:
  void carry(Entries& entries, const VectorField& velocity, double t) const;

  SmoothingKernel kernel_;
  double row_height_, most_skin_, skin_;
  double wall_limit_;
  int lanes_;
  Surroundings surroundings_;
  EntryRows rows_;
  PairWindows windows_;
  Entries entries_;
  PairSums sums_;
  ScalarField slope_;
  double moved_ = 0;
};

}  // namespace mpm::sph

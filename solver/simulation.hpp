#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/particles.hpp"
#include "solver/scene/scene.hpp"

namespace mpm {

/// Totals over the whole scene, per unit depth.
struct Totals {
  double mass;            ///< [kg/m]
  Vec2 momentum;          ///< of the particles [kg/s]
  Vec2 impulse;           ///< body and wall forces integrated over time since t = 0 [kg/s]
  double kinetic_energy;  ///< of the particles [J/m]
};

/// Totals of particles, and of the impulse that is known of them.
inline Totals totals_of(const Particles& particles, const Vec2& impulse) {
  Totals sum{0, Vec2::Zero(), impulse, 0};
  for (std::size_t p = 0; p < particles.size(); ++p) {
    sum.mass += particles.mass[p];
    sum.momentum += particles.mass[p] * particles.velocity[p];
    sum.kinetic_energy += 0.5 * particles.mass[p] * particles.velocity[p].squaredNorm();
  }
  return sum;
}

/// One simulation, whatever its basis, transfer, stepping and fluid. The scene must outlive it.
class Simulation {
 public:
  virtual ~Simulation() = default;

  /// Advances the state from t to t + dt [s].
  virtual void advance(double t, double dt) = 0;

  /// Why the last step cannot be continued from (a value that is not finite, a particle outside, a density
  /// that is not positive); empty while the state is sound.
  [[nodiscard]] virtual std::optional<std::string> breakdown() const = 0;

  [[nodiscard]] virtual const Particles& particles() const = 0;

  /// The grid field at time t [s] at the given points: the particles mapped to the grid with the walls'
  /// velocity imposed, interpolated with the basis [m/s]. Leaves the state as it is.
  [[nodiscard]] virtual VectorField grid_field(const VectorField& points, double t) const = 0;

  /// Gradient of the grid field, L_ab = d v_a/d x_b [1/s], as grid_field().
  [[nodiscard]] virtual std::vector<Mat2> grid_gradient(const VectorField& points, double t) const = 0;

  [[nodiscard]] virtual Totals totals() const = 0;
};

/// The cell corners of a scene, row by row from the bottom; a periodic direction lists each corner once [m].
VectorField cell_corners(const Scene& scene);

/// Where the grid field of a scheme is compared with a solution [m]: at the cell corners for the linear
/// basis, whose nodes they are, and on a lattice of quarter cells for splines. (At corners and cell middles
/// the error of a quadratic spline, ~ h^3 B_3(s) with the Bernoulli polynomial B_3, vanishes: order 4 there
/// alone.) Directions of one cell get corners only.
VectorField sample_points(const Scene& scene, const Scheme& scheme);

/// Seeds the scene and starts the chosen scheme on it. Throws SceneError for a scene that cannot be
/// simulated. `threads` work on it (0: default_threads()); the results are the same for any number of them.
/// Schemes that the vector kernels do not cover (LaneSolver) run on one.
std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Scheme& scheme, int threads = 0);

}  // namespace mpm

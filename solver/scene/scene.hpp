#pragma once

#include <array>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

#include "solver/linear_algebra.hpp"
#include "solver/material/rheology.hpp"
#include "solver/scene/scheme.hpp"

namespace mpm {

/// A scene or scheme that cannot be simulated: the message names the quantity and what it must be.
class SceneError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// One side of the rectangular domain: joined to the opposite side, or a wall with a given motion.
struct Side {
  bool periodic = true;
  std::function<Vec2(double)> velocity;  ///< of the wall at time t [m/s]
  std::function<Vec2(double)>
      acceleration;  ///< its derivative [m/s2]; an impulsive start does not appear in it
  /// Navier's slip length b [m]: along the wall the fluid feels mu (V - v)/b. 0: it sticks; infinite: it
  /// slips freely.
  double slip_length = 0;
  /// Stress by which a side without friction pulls the fluid along itself [Pa]: the traction of Zhou & Sun
  /// 2019, Eq. 17, whose nodal force is the integral of N_i times it.
  double traction = 0;

  static Side joined() { return {}; }
  /// A wall that has moved with constant velocity [m/s] since t = 0.
  static Side wall(const Vec2& v, double slip_length = 0);
  /// A side that nothing passes, and that pulls along itself with a stress [Pa].
  static Side pulled(double traction);
};

enum class Edge { Left, Right, Bottom, Top };

/// The weakly compressible fluid.
struct Fluid {
  double density = 1000;      ///< reference density rho0 [kg/m3]
  double bulk_modulus = 143;  ///< K of the Tait equation of state P = K[(rho/rho0)^7 - 1] [Pa]
  bool pressure = true;  ///< false: neither pressure nor density evolve, for flows declared divergence-free
  Rheology rheology;

  /// Speed of sound sqrt(7 K/rho0) [m/s]; 0 without pressure.
  [[nodiscard]] double sound_speed() const;
  /// Largest kinematic viscosity [m2/s].
  [[nodiscard]] double largest_kinematic_viscosity() const;
};

/// Where material points lie in a cell, and what mass each has.
struct Seeding {
  /// Even: at (i + 1/2)/n along an axis, equal masses. Gauss: at the Gauss-Legendre points, masses in
  /// proportion to their weights, so that sums over particles integrate polynomials of degree 2n - 1 exactly.
  enum class Rule { Even, Gauss };
  std::array<Rule, 2> rule{Rule::Even, Rule::Even};  ///< along x, y
  /// Every particle is moved along both axes by a random part of this fraction of the mean spacing, uniform
  /// and to either side; it is put back by reflection where that crosses a wall. 0: none.
  double displacement = 0;
  unsigned seed = 1;  ///< of the random numbers; the same on every machine
  /// Every particle is moved by this part of a cell along x, y, around periodic directions: where a stream
  /// would have carried the lattice. Must be 0 between walls.
  std::array<double, 2> shift{0, 0};
};

/// Name of a rule ("even", "gauss") and back (throws SceneError listing the known names).
std::string name(Seeding::Rule rule);
Seeding::Rule seeding_named(const std::string& text);

/// A fluid that fills a part of the domain only. It bears no tension: no density falls below the reference
/// density, so that what is torn apart leaves no force behind. Nodes that hold less than `least_fill` of the
/// mass of a full one feel the stress in proportion to their mass: where a function ends just inside the
/// fluid its slope is finite, and f_i/m_i would be without bound.
struct FreeSurface {
  std::function<bool(const Vec2&)> is_fluid;  ///< whether fluid stands at a point [m] at the start
  static constexpr double least_fill = 1e-3;
};

/// What is simulated: the rectangle [0, size.x] x [0, size.y], full of fluid unless it has a free surface. SI
/// units.
struct Scene {
  Vec2 size{1, 1};                              ///< [m]
  std::array<int, 2> cells{1, 1};               ///< background cells along x, y
  std::array<int, 2> particles_per_cell{2, 2};  ///< material points a cell along x, y
  Seeding seeding;
  std::array<Side, 4> sides;  ///< indexed by Edge
  Fluid fluid;
  std::optional<FreeSurface> free_surface;
  std::function<Vec2(double)> body_acceleration;  ///< uniform, at time t [m/s2]; none when empty
  /// Acceleration that varies in space [m/s2], written for all points [m] at time t in one call; none when
  /// empty.
  std::function<void(const VectorField& points, double t, VectorField& acceleration)> acceleration_field;
  double start = 0;                                    ///< time at which the initial state stands [s]
  std::function<Vec2(const Vec2&)> initial_velocity;   ///< [m/s]; at rest when empty
  std::function<double(const Vec2&)> initial_density;  ///< [kg/m3]; the reference density when empty

  [[nodiscard]] const Side& side(Edge e) const { return sides[static_cast<std::size_t>(e)]; }
  Side& side(Edge e) { return sides[static_cast<std::size_t>(e)]; }
  [[nodiscard]] double cell_size(int axis) const {
    return size[axis] / cells[static_cast<std::size_t>(axis)];
  }
  [[nodiscard]] double smallest_cell_size() const;
  /// Below which no density falls [kg/m3].
  [[nodiscard]] double least_density() const { return free_surface ? fluid.density : 0; }
  /// Of a node, below which it feels the stress in proportion to its mass [kg/m].
  [[nodiscard]] double least_nodal_mass() const {
    return free_surface ? FreeSurface::least_fill * fluid.density * cell_size(0) * cell_size(1) : 0;
  }
  [[nodiscard]] bool periodic(int axis) const { return sides[axis == 0 ? 0 : 2].periodic; }

  /// Throws SceneError when the scene cannot be simulated.
  void validate() const;
};

/// Throws SceneError when a scheme, both valid by themselves, cannot run a scene.
void check_together(const Scene& scene, const Scheme& scheme);

}  // namespace mpm

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/particles.hpp"
#include "solver/scene/scene.hpp"
#include "solver/sph/pairs/entries.hpp"
#include "solver/sph/sph_scheme.hpp"

namespace mpm::sph {

/// Whatever stands around the fluid, so that every neighbour of a particle is an entry of its own: copies
/// across periodic sides, mirror images behind walls, or fixed wall particles. Entries are ordered: the fluid
/// itself, its periodic copies, and from `wall_begin` on what belongs to a wall.
class Surroundings {
 public:
  /// `band` [m]: how far outside the domain entries are needed; `walls` says what stands behind walls,
  /// which must be further apart than the band.
  Surroundings(const Scene& scene, SphScheme::Wall walls, double band);

  /// Chooses the copies and images for the fluid as it stands: valid until particles have moved by the band.
  void rebuild(const VectorField& fluid);

  [[nodiscard]] std::size_t size() const { return fluid_ + images_.size() + fixed_.size(); }
  [[nodiscard]] std::size_t wall_begin() const { return wall_begin_; }

  /// Where all entries are, with the fluid at these places [m].
  [[nodiscard]] VectorField positions(const VectorField& fluid) const;

  // What follows writes the entries beyond the fluid, from those of the fluid; `slots` are those of all
  // entries.

  /// Masses, and all that never changes of fixed wall particles.
  void settle(Entries& entries, std::span<const std::uint32_t> slots) const;
  void place(Entries& entries, std::span<const std::uint32_t> slots) const;
  /// Velocities at time t [s].
  void carry(Entries& entries, std::span<const std::uint32_t> slots, double t) const;
  /// Densities and pressures. `gravity` [m/s2]: what a mirrored pressure rises with across the wall.
  void press(Entries& entries, std::span<const std::uint32_t> slots, double t, const Vec2& gravity) const;
  /// Viscosities and mu grad v: no-slip mirrors turn the sign of what varies along the wall. Fixed particles
  /// have none of their own.
  void strain(Entries& entries, std::span<const std::uint32_t> slots) const;

  [[nodiscard]] bool has_fixed() const { return !fixed_.empty(); }

 private:
  /// A fixed wall particle: where its wall is, and how far behind it.
  struct Fixed {
    Vec2 position;
    Edge edge;
    double depth;  ///< behind the plane of its wall [m]
  };
  struct Image {
    std::uint32_t source;
    std::array<std::uint8_t, 2> mirror;  ///< along x, y: 0 none, 1 the wall at 0, 2 the other one
    Vec2 shift;                          ///< image = source + shift, or where it is mirrored shift - source
  };
  /// Distance of a point from the plane of a wall [m], positive inside.
  [[nodiscard]] double distance(const Vec2& x, Edge edge) const;
  void add_images(std::vector<Image>& to, const Image& of, const VectorField& fluid, int axis) const;
  [[nodiscard]] std::vector<Fixed> fixed_particles() const;

  const Scene& scene_;
  SphScheme::Wall walls_;
  double band_;
  std::size_t fluid_ = 0, wall_begin_ = 0;
  std::vector<Image> images_;
  std::vector<Fixed> fixed_;
};

}  // namespace mpm::sph

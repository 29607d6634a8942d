#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/particles.hpp"
#include "solver/scene/scene.hpp"
#include "solver/sph/sph_scheme.hpp"

namespace mpm::sph {

/// What a pair loop reads of a neighbour: one cache line.
struct alignas(64) Neighbour {
  Vec2 position, velocity;
  double mass;
  double pressure_term;  ///< P/rho^2 [Pa m6/kg2]
  double inverse_density;
  double viscosity;  ///< dynamic [Pa s]
};

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

  /// Writes the entries beyond the fluid from those of the fluid, at time t [s]. `gravity` [m/s2]: what a
  /// mirrored pressure rises with across the wall.
  void fill(std::vector<Neighbour>& entries, double t, const Vec2& gravity) const;

  /// Writes mu grad v [Pa] of copies and images, from that of the fluid: no-slip mirrors turn the sign of
  /// what varies along the wall. Fixed particles have none of their own.
  void fill(std::vector<Mat2>& stress) const;

  /// A fixed wall particle: where its wall is, and how far behind it.
  struct Fixed {
    Vec2 position;
    Edge edge;
    double depth;  ///< behind the plane of its wall [m]
  };
  /// Fixed particle of an entry; only for entries of fixed walls.
  [[nodiscard]] const Fixed& fixed(std::size_t entry) const {
    return fixed_[entry - fluid_ - images_.size()];
  }
  [[nodiscard]] bool has_fixed() const { return !fixed_.empty(); }
  /// Distance of a point from the plane of a wall [m], positive inside.
  [[nodiscard]] double distance(const Vec2& x, Edge edge) const;

 private:
  struct Image {
    std::uint32_t source;
    std::array<std::int8_t, 2> sign;  ///< -1 mirrored, along x, y
    Vec2 shift;                       ///< image = sign * source + shift
  };
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

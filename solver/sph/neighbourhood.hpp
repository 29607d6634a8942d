#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "solver/scene/scene.hpp"
#include "solver/sph/local_fit.hpp"
#include "solver/sph/neighbour_list.hpp"
#include "solver/sph/smoothing_kernel.hpp"
#include "solver/sph/stable_sph_step.hpp"
#include "solver/sph/surroundings.hpp"

namespace mpm::sph {

/// Who is near each particle: the fluid and its surroundings as entries, a list of pairs that stays valid
/// while particles move by less than half its skin, and the kernel's slope F = W'(r)/r of every pair.
class Neighbourhood {
 public:
  /// The scene must outlive it.
  Neighbourhood(const Scene& scene, const SphScheme& scheme)
      : kernel_(kernel_of(scheme, scene)),
        most_skin_(skin_share * kernel_.radius),
        skin_(most_skin_),
        wall_limit_(scheme.wall_limit),
        surroundings_(scene, scheme.wall, kernel_.radius + most_skin_) {}

  /// Entries: the fluid first, in the order of the particles, then what stands around it.
  std::vector<Neighbour>& entries() { return entries_; }
  [[nodiscard]] const std::vector<Neighbour>& entries() const { return entries_; }
  [[nodiscard]] const Surroundings& surroundings() const { return surroundings_; }
  [[nodiscard]] const SmoothingKernel& kernel() const { return kernel_; }

  /// Chooses copies and images for the fluid at these places, which lie in the domain; entries are to be
  /// filled anew, then list_pairs() follows.
  void surround(const VectorField& position) {
    surroundings_.rebuild(position);
    entries_.resize(surroundings_.size());
  }
  /// `move`: how far particles moved in the last step, at most [m]. A skin s of the support adds 2 s of the
  /// pairs to every step, and spreads the price of a list, that of some three steps, over s support/(2 move)
  /// steps: s^2 = 3 move/support is the cheapest.
  void list_pairs(std::size_t fluid, double move) {
    constexpr double steps_a_list = 3;
    skin_ = std::clamp(std::sqrt(steps_a_list * move * kernel_.radius), 0.1 * most_skin_, most_skin_);
    list_.rebuild(entries_, fluid, surroundings_.wall_begin(), kernel_.radius + skin_);
    moved_ = 0;
  }
  /// Counts a move of at most `distance` [m] of every particle; whether the list has become too old.
  bool outdated_after(double distance) {
    moved_ += distance;
    return 2 * moved_ >= skin_;
  }

  /// Calls pair(e, x_ij, F) for the entries near a particle, then wall_pair(e, x_ij, F) for those of walls.
  /// `slope(x_ij)` gives F.
  template <class Slope, class Pair, class WallPair>
  void for_pairs(std::size_t p, Slope slope, const Pair& pair, const WallPair& wall_pair) const {
    const Vec2 x = entries_[p].position;
    for (const std::uint32_t e : list_.inner(p)) {
      const Vec2 d = x - entries_[e].position;
      pair(e, d, slope(d));
    }
    for (const std::uint32_t e : list_.wall(p)) {
      const Vec2 d = x - entries_[e].position;
      wall_pair(e, d, slope(d));
    }
  }

  [[nodiscard]] auto fresh_slope() const {
    return [this](const Vec2& d) { return kernel_.gradient(d.squaredNorm()); };
  }
  /// F of the pairs of a particle as keep_slopes() left them: valid until positions change.
  [[nodiscard]] auto kept_slope(std::size_t p) const {
    return [slope = slope_.data() + list_.first_pair(p)](const Vec2&) mutable { return *slope++; };
  }
  void make_room_for_slopes() { slope_.resize(list_.pairs()); }
  /// As for_pairs() with a fresh slope for all pairs alike, whose F are kept.
  template <class Pair>
  void for_pairs_keeping_slopes(std::size_t p, const Pair& pair) {
    const Vec2 x = entries_[p].position;
    double* slope = slope_.data() + list_.first_pair(p);
    for (const std::uint32_t e : list_.all(p)) {
      const Vec2 d = x - entries_[e].position;
      *slope = kernel_.gradient(d.squaredNorm());
      pair(e, d, *slope++);
    }
  }

  /// v_i - v_j of a neighbour that belongs to a wall. A fixed particle's velocity is extrapolated from the
  /// particle's own through the wall, linearly, but by no more than the limit (Morris et al., Eq. 35).
  [[nodiscard]] Vec2 velocity_to_wall(std::size_t p, std::uint32_t e) const {
    const Vec2 difference = entries_[p].velocity - entries_[e].velocity;
    if (!surroundings_.has_fixed()) return difference;
    const Surroundings::Fixed& fixed = surroundings_.fixed(e);
    const double distance = surroundings_.distance(entries_[p].position, fixed.edge);
    const double factor = distance > 0 ? 1 + fixed.depth / distance : wall_limit_;
    return std::min(factor, wall_limit_) * difference;
  }

  /// Fits at points to entries that are like its own but for what they carry; fixed wall particles, whose
  /// velocity nobody extrapolated, take no part.
  [[nodiscard]] std::vector<LocalFit> fits(const VectorField& points,
                                           const std::vector<Neighbour>& entries) const {
    const std::size_t end = surroundings_.has_fixed() ? surroundings_.wall_begin() : entries.size();
    std::vector<LocalFit> found;
    found.reserve(points.size());
    for (const Vec2& point : points) found.push_back(fit_at(point, entries, end, list_, kernel_));
    return found;
  }

 private:
  SmoothingKernel kernel_;
  double most_skin_, skin_;
  double wall_limit_;
  Surroundings surroundings_;
  NeighbourList list_;
  std::vector<Neighbour> entries_;
  ScalarField slope_;
  double moved_ = 0;
};

}  // namespace mpm::sph

#pragma once

#include <algorithm>
#include <span>

#include "solver/kernel/cells/storage.hpp"
#include "solver/kernel/lanes.hpp"

namespace mpm::MPM_ISA {

/// Particles of `width` neighbouring cells, one of each. An empty lane has no mass and rests in its cell.
struct Slot {
  Lanes s[2], v[2];    ///< place in the cell, 0 to 1 along each axis; velocity [m/s]
  Lanes mass, volume;  ///< per unit depth [kg/m], [m2]; both zero in an empty lane
};

/// Stress of a slot's particles [Pa]. Only schemes that use it in a later pass than the one that sets it keep
/// it, so it lies apart.
struct Stress {
  Lanes s_00, s_11, s_01;

  friend Stress operator*(Lanes factor, const Stress& s) {
    return {factor * s.s_00, factor * s.s_11, factor * s.s_01};
  }
};

/// Affine field of a slot's particles: C_ab times the size of a cell along b, the change of v_a across a
/// cell [m/s]. Only particles of APIC have one.
struct Affine {
  Lanes c[2][2];
};

/// What a slot's particles were called when they came.
struct Names {
  int of[width];
};

/// One particle, out of its lane.
struct LoneParticle {
  int name;
  double s[2], v[2], mass, volume;
  double stress[3], affine[2][2];  ///< where they are kept
};

/// The store of all slots, and what is kept beside them.
class Slots {
 public:
  /// `keeps_stress`: from one step to the next.
  Slots(bool has_affine, bool keeps_stress) : has_affine_(has_affine), keeps_stress_(keeps_stress) {}

  [[nodiscard]] std::size_t size() const { return slots_.size(); }
  [[nodiscard]] bool has_affine() const { return has_affine_; }

  // Of `count` slots from the first on.
  [[nodiscard]] std::span<Slot> slots(std::size_t first, std::size_t count) {
    return {slots_.data() + first, count};
  }
  [[nodiscard]] std::span<const Slot> slots(std::size_t first, std::size_t count) const {
    return {slots_.data() + first, count};
  }
  [[nodiscard]] std::span<Stress> stresses(std::size_t first, std::size_t count) {
    return {stresses_.data() + first, count};
  }
  /// Empty unless particles have an affine field.
  [[nodiscard]] std::span<Affine> affines(std::size_t first, std::size_t count) {
    return {affines_.data() + first, has_affine_ ? count : 0};
  }

  /// Of the particle in a lane of a slot; its stress although it is not kept if a reader asks.
  [[nodiscard]] LoneParticle particle(std::size_t at, int lane, bool with_stress) const {
    const Slot& slot = slots_[at];
    LoneParticle p{names_[at].of[lane],
                   {slot.s[0][lane], slot.s[1][lane]},
                   {slot.v[0][lane], slot.v[1][lane]},
                   slot.mass[lane],
                   slot.volume[lane],
                   {},
                   {}};
    if (with_stress) {
      const Stress& stress = stresses_[at];
      p.stress[0] = stress.s_00[lane];
      p.stress[1] = stress.s_11[lane];
      p.stress[2] = stress.s_01[lane];
    }
    if (has_affine_)
      for (int c : {0, 1})
        for (int a : {0, 1}) p.affine[c][a] = affines_[at].c[c][a][lane];
    return p;
  }
  /// What moves with the particle in a lane of a slot.
  [[nodiscard]] LoneParticle particle(std::size_t at, int lane) const {
    return particle(at, lane, keeps_stress_);
  }

  void put(const LoneParticle& p, std::size_t at, int lane) {
    names_[at].of[lane] = p.name;
    put_state(p, at, lane);
    if (keeps_stress_) {
      Stress& stress = stresses_[at];
      stress.s_00[lane] = p.stress[0];
      stress.s_11[lane] = p.stress[1];
      stress.s_01[lane] = p.stress[2];
    }
    if (has_affine_)
      for (int c : {0, 1})
        for (int a : {0, 1}) affines_[at].c[c][a][lane] = p.affine[c][a];
  }

  /// A lane without a particle.
  void empty(std::size_t at, int lane) { put_state({0, {0.5, 0.5}, {0, 0}, 0, 0, {}, {}}, at, lane); }

  /// A slot without particles.
  void empty(std::size_t at) {
    slots_[at] = {{0.5, 0.5}, {0, 0}, 0, 0};
    stresses_[at] = {0, 0, 0};
    if (has_affine_) affines_[at] = {{{0, 0}, {0, 0}}};
  }

  /// Copies `count` slots of `from`, another store or this one, to other places.
  void copy(const Slots& from, std::size_t first, std::size_t count, std::size_t to) {
    each_array(from, [&](auto& array, const auto& source) {
      if (!array.empty()) std::copy_n(source.data() + first, count, array.data() + to);
    });
  }

  /// Another store of such particles, of `size` slots.
  [[nodiscard]] Slots like(std::size_t size) const {
    Slots other(has_affine_, keeps_stress_);
    other.slots_.resize(size);
    other.stresses_.resize(size);
    other.affines_.resize(has_affine_ ? size : 0);
    other.names_.resize(size);
    return other;
  }

 private:
  void put_state(const LoneParticle& p, std::size_t at, int lane) {
    Slot& slot = slots_[at];
    for (int c : {0, 1}) {
      slot.s[c][lane] = p.s[c];
      slot.v[c][lane] = p.v[c];
    }
    slot.mass[lane] = p.mass;
    slot.volume[lane] = p.volume;
  }

  template <class F>
  void each_array(const Slots& other, F&& f) {
    f(slots_, other.slots_);
    f(stresses_, other.stresses_);
    f(affines_, other.affines_);
    f(names_, other.names_);
  }

  bool has_affine_, keeps_stress_;
  LargeArray<Slot> slots_;
  LargeArray<Stress> stresses_;
  LargeArray<Affine> affines_;
  LargeArray<Names> names_;
};

}  // namespace mpm::MPM_ISA

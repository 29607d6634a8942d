// Compiled once for every instruction set, see CMakeLists.txt.
#include "solver/kernel/lanes.hpp"
#include "solver/sph/pairs/pair_loops.hpp"

namespace mpm::MPM_ISA {
namespace {

using sph::Group;
using sph::PairWork;

using Two = double __attribute__((vector_size(2 * sizeof(double))));
using Four = double __attribute__((vector_size(4 * sizeof(double))));

/// Points of a table, value and difference in turn, of half of the lanes from `first` on.
template <int first, class Indices>
[[gnu::always_inline]] inline Vector points_of(const double* points, const Indices& index) {
  Two point[width / 2];
  unroll<width / 2>([&](int k) { std::memcpy(&point[k], points + index[first + k], sizeof(Two)); });
#if MPM_LANES == 2
  return point[0];
#elif MPM_LANES == 4
  return __builtin_shufflevector(point[0], point[1], 0, 1, 2, 3);
#else
  const Four a = __builtin_shufflevector(point[0], point[1], 0, 1, 2, 3);
  const Four b = __builtin_shufflevector(point[2], point[3], 0, 1, 2, 3);
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
#endif
}

/// Every other number of two vectors.
template <int... lane>
[[gnu::always_inline]] inline Lanes even(Vector a, Vector b, std::integer_sequence<int, lane...>) {
  return __builtin_shufflevector(a, b, (2 * lane)...);
}
template <int... lane>
[[gnu::always_inline]] inline Lanes odd(Vector a, Vector b, std::integer_sequence<int, lane...>) {
  return __builtin_shufflevector(a, b, (2 * lane + 1)...);
}

/// W or F. A point is read at once: number by number takes half as long again.
[[gnu::always_inline]] inline Lanes value_of(const sph::RadialPoints& table, Lanes r_squared) {
  using Integers = int __attribute__((vector_size(MPM_LANES * sizeof(int))));
  using Indices = unsigned __attribute__((vector_size(MPM_LANES * sizeof(unsigned))));
  const Lanes place = least(r_squared * table.scale, table.intervals);
  const Integers k = __builtin_convertvector(place.v, Integers);
  const Indices index = reinterpret_cast<Indices>(k + k);
  const Vector a = points_of<0>(table.points, index), b = points_of<width / 2>(table.points, index);
  constexpr std::make_integer_sequence<int, width> lanes;
  return even(a, b, lanes) + (place - Lanes(__builtin_convertvector(k, Vector))) * odd(a, b, lanes);
}

struct Plane {
  Lanes x, y;

  friend Plane operator-(const Plane& a, const Plane& b) { return {a.x - b.x, a.y - b.y}; }
  friend Plane operator*(Lanes a, const Plane& b) { return {a * b.x, a * b.y}; }
  Plane& operator+=(const Plane& b) { return *this = {x + b.x, y + b.y}; }
};
inline Lanes dot(const Plane& a, const Plane& b) {
  return a.x * b.x + a.y * b.y;
}
inline Plane plane_at(const double* const (&from)[2], std::uint32_t slot) {
  return {load(from[0] + slot), load(from[1] + slot)};
}
inline void put(double* const (&to)[2], std::ptrdiff_t place, const Plane& x) {
  store(to[0] + place, x.x);
  store(to[1] + place, x.y);
}

/// meet(slot) for every step of some windows: of the first lane's entry.
template <class Meet>
[[gnu::always_inline]] inline void each_entry(const PairWork& work, std::uint32_t begin, std::uint32_t end,
                                              const Meet& meet) {
  for (std::uint32_t k = begin; k < end; ++k) {
    const sph::Window window = work.windows[k];
    for (std::uint32_t e = window.first; e < window.first + window.count; ++e) meet(e);
  }
}

/// meet(slot, F) likewise; the F of a group follow each other.
template <class Meet>
[[gnu::always_inline]] inline void each_pair(const PairWork& work, std::uint32_t begin, std::uint32_t end,
                                             const double*& slope, const Meet& meet) {
  each_entry(work, begin, end, [&](std::uint32_t e) {
    meet(e, load(slope));
    slope += width;
  });
}

void find_slopes(const PairWork& work, int first, int end) {
  for (int g = first; g < end; ++g) {
    const Group& group = work.groups[g];
    // Copies: for all that a compiler knows, stores to slopes might change what lies elsewhere.
    const double* const position[2] = {work.entries.position[0], work.entries.position[1]};
    const sph::RadialPoints gradient = work.gradient;
    const Plane x = plane_at(position, group.slot);
    double* slope = work.slope + group.first_slope;
    each_entry(work, group.begin, group.end, [&](std::uint32_t e) {
      const Plane d = x - plane_at(position, e);
      store(slope, value_of(gradient, dot(d, d)));
      slope += width;
    });
  }
}

void sum_density(const PairWork& work, int first, int end) {
  for (int g = first; g < end; ++g) {
    const Group& group = work.groups[g];
    const Plane x = plane_at(work.entries.position, group.slot);
    Lanes density = 0;
    each_entry(work, group.begin, group.end, [&](std::uint32_t e) {
      const Plane d = x - plane_at(work.entries.position, e);
      density += load(work.entries.mass + e) * value_of(work.weight, dot(d, d));
    });
    store(work.density + g * width, density);
  }
}

void find_density_rate(const PairWork& work, int first, int end) {
  for (int g = first; g < end; ++g) {
    const Group& group = work.groups[g];
    const Plane x = plane_at(work.entries.position, group.slot),
                v = plane_at(work.entries.velocity, group.slot);
    const double* slope = work.slope + group.first_slope;
    Lanes rate = 0;
    each_pair(work, group.begin, group.end, slope, [&](std::uint32_t e, Lanes f) {
      const Plane d = x - plane_at(work.entries.position, e), dv = v - plane_at(work.entries.velocity, e);
      rate += load(work.entries.mass + e) * f * dot(d, dv);
    });
    store(work.density + g * width, rate);
  }
}

/// v_i - v_j of a fixed wall particle over v_i - v_j with its wall's velocity: it is extrapolated from the
/// particle's own through the wall, linearly, but by no more than the limit (Morris et al., Eq. 35).
[[gnu::always_inline]] inline Lanes extrapolation(const PairWork& work, std::uint32_t e, const Plane& x) {
  const Lanes distance = dot(plane_at(work.entries.wall_normal, e), x) + load(work.entries.wall_offset + e);
  const Lanes factor = 1 + load(work.entries.wall_depth + e) / distance;
  return select(distance > 0, least(factor, work.wall_limit), work.wall_limit);
}

void find_velocity_gradient(const PairWork& work, int first, int end) {
  for (int g = first; g < end; ++g) {
    const Group& group = work.groups[g];
    const Plane x = plane_at(work.entries.position, group.slot),
                v = plane_at(work.entries.velocity, group.slot);
    const double* slope = work.slope + group.first_slope;
    Plane of_u{0, 0}, of_v{0, 0};
    const auto add = [&](std::uint32_t e, const Plane& dv, Lanes f) {
      const Plane d = x - plane_at(work.entries.position, e);
      const Lanes volume_f = load(work.entries.mass + e) * load(work.entries.inverse_density + e) * f;
      of_u += (0 - volume_f * dv.x) * d;
      of_v += (0 - volume_f * dv.y) * d;
    };
    each_pair(work, group.begin, work.has_fixed ? group.walls : group.end, slope,
              [&](std::uint32_t e, Lanes f) { add(e, v - plane_at(work.entries.velocity, e), f); });
    if (work.has_fixed)
      each_pair(work, group.walls, group.end, slope, [&](std::uint32_t e, Lanes f) {
        add(e, extrapolation(work, e, x) * (v - plane_at(work.entries.velocity, e)), f);
      });
    unroll<2>([&](int c) {
      const Plane& of = c == 0 ? of_u : of_v;
      store(work.velocity_gradient[2 * c] + g * width, of.x);
      store(work.velocity_gradient[2 * c + 1] + g * width, of.y);
    });
  }
}

/// What a pair's acceleration is made of.
template <bool whole>
struct State {
  Lanes pressure_term, inverse_density, viscosity;
  Lanes stress[whole ? 4 : 1];

  State(const PairWork& work, std::uint32_t slot)
      : pressure_term(load(work.entries.pressure_term + slot)),
        inverse_density(load(work.entries.inverse_density + slot)),
        viscosity(load(work.entries.viscosity + slot)) {
    if constexpr (whole) unroll<4>([&](int k) { stress[k] = load(work.entries.stress[k] + slot); });
  }
};

/// Of a neighbour `n` with m F: see SphSolver.
template <bool whole>
[[gnu::always_inline]] inline Plane of_pair(const State<whole>& own, const State<whole>& n, const Plane& d,
                                            const Plane& dv, Lanes mass_f) {
  const Lanes volumes = own.inverse_density * n.inverse_density;
  Plane sum = (own.viscosity + n.viscosity) * volumes * dv - (own.pressure_term + n.pressure_term) * d;
  if constexpr (whole) {
    const auto both = [&](int k) { return own.stress[k] + n.stress[k]; };
    const Lanes xx = both(0), xy = both(1), yx = both(2), yy = both(3), third = 2.0 / 3.0 * (xx + yy);
    sum += volumes * Plane{(xx - third) * d.x + yx * d.y, xy * d.x + (yy - third) * d.y};
  }
  return mass_f * sum;
}

template <bool whole>
void find_acceleration(const PairWork& work, int first, int end) {
  for (int g = first; g < end; ++g) {
    const Group& group = work.groups[g];
    const Plane x = plane_at(work.entries.position, group.slot),
                v = plane_at(work.entries.velocity, group.slot);
    const State<whole> own(work, group.slot);
    const double* slope = work.slope + group.first_slope;
    const auto of_entry = [&](std::uint32_t e, Lanes f) {
      return of_pair(own, State<whole>(work, e), x - plane_at(work.entries.position, e),
                     v - plane_at(work.entries.velocity, e), load(work.entries.mass + e) * f);
    };
    Plane inner{0, 0}, of_walls{0, 0};
    each_pair(work, group.begin, group.walls, slope,
              [&](std::uint32_t e, Lanes f) { inner += of_entry(e, f); });
    if (work.has_fixed) {
      State<whole> mirrored = own;  // they carry the particle's own state, as behind a mirror
      each_pair(work, group.walls, group.end, slope, [&](std::uint32_t e, Lanes f) {
        const Plane d = x - plane_at(work.entries.position, e),
                    normal = plane_at(work.entries.wall_normal, e);
        const Lanes rise = (normal.x * work.gravity[0] + normal.y * work.gravity[1]) * dot(normal, d);
        mirrored.pressure_term = own.pressure_term - own.inverse_density * rise;
        of_walls +=
            of_pair(own, mirrored, d, extrapolation(work, e, x) * (v - plane_at(work.entries.velocity, e)),
                    load(work.entries.mass + e) * f);
      });
    } else {
      each_pair(work, group.walls, group.end, slope,
                [&](std::uint32_t e, Lanes f) { of_walls += of_entry(e, f); });
    }
    inner += of_walls;
    put(work.acceleration, g * width, inner);
    put(work.wall_acceleration, g * width, of_walls);
  }
}

}  // namespace

sph::PairLoops pair_loops() {
  return {width,
          find_slopes,
          sum_density,
          find_density_rate,
          find_velocity_gradient,
          find_acceleration<false>,
          find_acceleration<true>};
}

}  // namespace mpm::MPM_ISA

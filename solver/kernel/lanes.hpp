#pragma once

// Included by the translation units of the kernel alone. They are compiled once for every instruction set:
// MPM_ISA names it, MPM_LANES is the number of doubles in its registers. Everything here lives in a namespace
// of that name, so that the linker never takes code of one instruction set for that of another.

#include <cmath>
#include <cstring>
#include <utility>

namespace mpm::MPM_ISA {

constexpr int width = MPM_LANES;
using Vector = double __attribute__((vector_size(MPM_LANES * sizeof(double))));

// The C library's vector functions, within 4 units in the last place, named by its vector ABI.
#if defined(__x86_64__) && defined(__GLIBC__) && MPM_LANES > 1
#if MPM_LANES == 8
#define MPM_VECTOR_MATH(function) _ZGVeN8v_##function
#elif MPM_LANES == 4
#define MPM_VECTOR_MATH(function) _ZGVdN4v_##function
#else
#define MPM_VECTOR_MATH(function) _ZGVbN2v_##function
#endif
extern "C" {
Vector MPM_VECTOR_MATH(exp)(Vector);
Vector MPM_VECTOR_MATH(log)(Vector);
}
#endif

/// Calls f(0) to f(n - 1), written out: what f indexes can stay in registers.
template <int n, class F>
[[gnu::always_inline]] inline void unroll(F&& f) {
  [&]<int... k>(std::integer_sequence<int, k...>) {
    (f(k), ...);
  }
  (std::make_integer_sequence<int, n>{});
}

#ifdef MPM_COUNT_OPERATIONS
inline long operations = 0;
#endif

/// The result of an operation; a benchmark counts them.
inline Vector counted(Vector x) {
#ifdef MPM_COUNT_OPERATIONS
  ++operations;
#endif
  return x;
}

/// `width` doubles in one register: one of each of as many neighbouring cells.
struct Lanes {
  Vector v;

  Lanes() = default;
  Lanes(double x) : v(x - Vector{}) {}
  Lanes(Vector x) : v(x) {}

  friend Lanes operator+(Lanes a, Lanes b) { return counted(a.v + b.v); }
  friend Lanes operator-(Lanes a, Lanes b) { return counted(a.v - b.v); }
  friend Lanes operator*(Lanes a, Lanes b) { return counted(a.v * b.v); }
  friend Lanes operator/(Lanes a, Lanes b) { return counted(a.v / b.v); }
  Lanes& operator+=(Lanes b) { return *this = *this + b; }
  Lanes& operator-=(Lanes b) { return *this = *this - b; }

  double& operator[](int lane) { return reinterpret_cast<double*>(&v)[lane]; }
  double operator[](int lane) const { return v[lane]; }
};

/// One yes or no a lane.
struct Mask {
  using Bits = decltype(Vector{} < Vector{});
  Bits bits{};

  friend Mask operator&(Mask a, Mask b) { return {a.bits & b.bits}; }
  friend Mask operator|(Mask a, Mask b) { return {a.bits | b.bits}; }
  friend Mask operator!(Mask a) { return {~a.bits}; }

  bool operator[](int lane) const { return bits[lane] != 0; }
  [[nodiscard]] bool any() const {
    long some = 0;
    for (int lane = 0; lane < width; ++lane) some |= bits[lane];
    return some != 0;
  }
};

inline Mask operator<(Lanes a, Lanes b) {
  return {a.v < b.v};
}
inline Mask operator>(Lanes a, Lanes b) {
  return {a.v > b.v};
}
inline Mask operator>=(Lanes a, Lanes b) {
  return {a.v >= b.v};
}

/// a where the mask says yes, b elsewhere.
inline Lanes select(Mask mask, Lanes a, Lanes b) {
  return mask.bits ? a.v : b.v;
}

/// Of two: b where they cannot be compared.
inline Lanes least(Lanes a, Lanes b) {
  return select(a < b, a, b);
}
inline Lanes largest(Lanes a, Lanes b) {
  return select(a > b, a, b);
}

// From and to any address: nodes of a cell lie where they lie.
inline Lanes load(const double* from) {
  Vector lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
inline void store(double* to, Lanes x) {
  std::memcpy(to, &x.v, sizeof x.v);
}

/// The first `count` of them.
template <class Count>
inline void store_first(Count count, double* to, Lanes x) {
  std::memcpy(to, &x.v, static_cast<std::size_t>(count) * sizeof(double));
}

inline double sum(Lanes x) {
  double total = 0;
  for (int lane = 0; lane < width; ++lane) total += x.v[lane];
  return total;
}

inline double largest(Lanes x) {
  double most = x.v[0];
  for (int lane = 1; lane < width; ++lane) most = x.v[lane] > most ? x.v[lane] : most;
  return most;
}

// What rheologies are written in.
inline Lanes sqrt(Lanes x) {
  Lanes root;
  for (int lane = 0; lane < width; ++lane) root.v[lane] = std::sqrt(x.v[lane]);
  return counted(root.v);
}
inline Lanes at_least(Lanes x, double bound) {
  return select(x < bound, bound, x);
}
inline Lanes choose_below(Lanes x, double bound, Lanes a, Lanes b) {
  return select(x < bound, a, b);
}
#ifdef MPM_VECTOR_MATH
inline Lanes exp(Lanes x) {
  return MPM_VECTOR_MATH(exp)(x.v);
}
inline Lanes log(Lanes x) {
  return MPM_VECTOR_MATH(log)(x.v);
}
#else
inline Lanes exp(Lanes x) {
  for (int lane = 0; lane < width; ++lane) x.v[lane] = std::exp(x.v[lane]);
  return x;
}
inline Lanes log(Lanes x) {
  for (int lane = 0; lane < width; ++lane) x.v[lane] = std::log(x.v[lane]);
  return x;
}
#endif

}  // namespace mpm::MPM_ISA

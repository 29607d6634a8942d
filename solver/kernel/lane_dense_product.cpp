// Compiled once for every instruction set, see CMakeLists.txt.
#include "solver/kernel/dense_product.hpp"
#include "solver/kernel/lanes.hpp"

namespace mpm::MPM_ISA {
namespace {

constexpr int columns_at_once = 4;

/// The part of c in some vectors of rows and some columns, whose sums stay in registers.
template <int vectors>
[[gnu::always_inline]] inline void block(int rows, int inner, const double* a, const double* b, double* c) {
  Lanes sum[columns_at_once][vectors] = {};
  for (int k = 0; k < inner; ++k, a += rows) {
    Lanes of_a[vectors];
    unroll<vectors>([&](int v) { of_a[v] = load(a + v * width); });
    unroll<columns_at_once>([&](int j) {
      const Lanes of_b = b[j * inner + k];
      unroll<vectors>([&](int v) { sum[j][v] += of_a[v] * of_b; });
    });
  }
  unroll<columns_at_once>(
      [&](int j) { unroll<vectors>([&](int v) { store(c + j * rows + v * width, sum[j][v]); }); });
}

}  // namespace

void dense_product(int rows, int inner, int columns, const double* a, const double* b, double* c) {
  constexpr int most = 3;
  for (int j = 0; j < columns; j += columns_at_once) {
    const double* const b_j = b + j * inner;
    double* const c_j = c + j * rows;
    int i = 0;
    for (; i + most * width <= rows; i += most * width) block<most>(rows, inner, a + i, b_j, c_j + i);
    for (; i < rows; i += width) block<1>(rows, inner, a + i, b_j, c_j + i);
  }
}

}  // namespace mpm::MPM_ISA

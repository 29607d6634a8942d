#pragma once

namespace mpm {

/// c = a b of dense matrices, column by column: a has `rows` rows and `inner` columns, b `columns` columns.
/// Rows, of a and b, are counted with what pads them to a multiple of dense_pad; so are columns.
using DenseProduct = void (*)(int rows, int inner, int columns, const double* a, const double* b, double* c);
inline constexpr int dense_pad = 8;
inline constexpr int padded(int n) {
  return (n + dense_pad - 1) / dense_pad * dense_pad;
}

}  // namespace mpm

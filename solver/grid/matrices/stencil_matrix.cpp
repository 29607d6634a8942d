#include "solver/grid/matrices/stencil_matrix.hpp"

#include <cstring>

namespace mpm {
namespace {

/// Both components of a nodal vector in one register, where Vec2 takes two: here nothing but sums of whole
/// vectors is made (linear_algebra.hpp says why it is otherwise for particles).
using Components [[gnu::vector_size(2 * sizeof(double))]] = double;

Components components(const Vec2& v) {
  Components both;
  std::memcpy(&both, v.data(), sizeof both);
  return both;
}

}  // namespace

StencilMatrix::StencilMatrix(const Grid& grid)
    : degree_(grid.x.degree),
      reach_(2 * degree_ + 1),
      x_{grid.x.count(), grid.x.periodic},
      y_{grid.y.count(), grid.y.periodic},
      entry_(grid.size() * entries(), 0.0),
      padded_(static_cast<std::size_t>((x_.count + 2 * degree_) * (y_.count + 2 * degree_)), Vec2::Zero()) {}

void StencilMatrix::mirror() {
  const auto copy = [&](int i, int j, int di, int dj, int k, int l) {
    const auto here = static_cast<std::size_t>((dj + degree_) * reach_ + di + degree_);
    const auto node = static_cast<std::size_t>(j * x_.count + i);
    entry_[static_cast<std::size_t>(l * x_.count + k) * entries() + entries() - 1 - here] =
        entry_[node * entries() + here];
  };
  for (int j = 0; j < y_.count; ++j)
    for (int dj = 1; dj <= degree_; ++dj) {
      const int l = y_.neighbour(j + dj);
      if (l < 0) continue;
      for (int i = 0; i < x_.count; ++i) {
        const bool inside = i >= degree_ && i + degree_ < x_.count;  // no need to look for neighbours
        for (int di = -degree_; di <= degree_; ++di)
          if (const int k = inside ? i + di : x_.neighbour(i + di); k >= 0) copy(i, j, di, dj, k, l);
      }
    }
}

void StencilMatrix::multiply(const VectorField& field, VectorField& product) const {
  const int nx = x_.count + 2 * degree_, ny = y_.count + 2 * degree_;
  for (int j = 0; j < ny; ++j) {
    const int l = y_.neighbour(j - degree_);
    if (l < 0) continue;
    const Vec2* row = field.data() + l * x_.count;
    Vec2* padded_row = padded_.data() + j * nx + degree_;
    std::copy(row, row + x_.count, padded_row);
    for (int d = 0; d < degree_; ++d)
      for (const int i : {d - degree_, x_.count + d})
        if (const int k = x_.neighbour(i); k >= 0) padded_row[i] = row[k];
  }
  product.resize(field.size());
  switch (degree_) {
    case 1:
      return multiply_by_degree<1>(product);
    case 2:
      return multiply_by_degree<2>(product);
    default:
      return multiply_by_degree<3>(product);
  }
}

template <int degree>
void StencilMatrix::multiply_by_degree(VectorField& product) const {
  constexpr int reach = 2 * degree + 1;
  const int nx = x_.count + 2 * degree;
  std::size_t node = 0;
  for (int j = 0; j < y_.count; ++j)
    for (int i = 0; i < x_.count; ++i, ++node) {
      const double* entry = entry_.data() + node * (reach * reach);
      const Vec2* neighbours = padded_.data() + j * nx + i;
      Components sum[reach];  // independent sums, which the processor adds side by side
      for (int l = 0; l < reach; ++l) sum[l] = entry[l * reach] * components(neighbours[l * nx]);
      for (int k = 1; k < reach; ++k)
        for (int l = 0; l < reach; ++l) sum[l] += entry[l * reach + k] * components(neighbours[l * nx + k]);
      for (int l = 1; l < reach; ++l) sum[0] += sum[l];
      product[node] = {sum[0][0], sum[0][1]};
    }
}

}  // namespace mpm

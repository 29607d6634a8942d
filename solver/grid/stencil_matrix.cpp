#include "solver/grid/stencil_matrix.hpp"

namespace mpm {

StencilMatrix::StencilMatrix(const Grid& grid)
    : degree_(grid.x.degree),
      reach_(2 * degree_ + 1),
      x_{grid.x.count(), grid.x.periodic},
      y_{grid.y.count(), grid.y.periodic},
      entry_(grid.size() * entries(), 0.0),
      padded_(static_cast<std::size_t>((x_.count + 2 * degree_) * (y_.count + 2 * degree_)), Vec2::Zero()) {}

void StencilMatrix::mirror() {
  std::size_t node = 0;
  for (int j = 0; j < y_.count; ++j)
    for (int i = 0; i < x_.count; ++i, ++node)
      for (int dj = 1; dj <= degree_; ++dj)
        for (int di = -degree_; di <= degree_; ++di) {
          const int k = x_.neighbour(i + di), l = y_.neighbour(j + dj);
          if (k < 0 || l < 0) continue;
          const auto here = static_cast<std::size_t>((dj + degree_) * reach_ + di + degree_);
          entry_[static_cast<std::size_t>(l * x_.count + k) * entries() + entries() - 1 - here] =
              entry_[node * entries() + here];
        }
}

void StencilMatrix::multiply(const VectorField& field, VectorField& product) const {
  const int nx = x_.count + 2 * degree_, ny = y_.count + 2 * degree_;
  for (int j = 0; j < ny; ++j) {
    const int l = y_.neighbour(j - degree_);
    if (l < 0) continue;
    for (int i = 0; i < nx; ++i)
      if (const int k = x_.neighbour(i - degree_); k >= 0)
        padded_[static_cast<std::size_t>(j * nx + i)] = field[static_cast<std::size_t>(l * x_.count + k)];
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
      Vec2 sum[reach];  // independent sums, which the processor adds side by side
      for (int l = 0; l < reach; ++l) sum[l] = entry[l * reach] * neighbours[l * nx];
      for (int k = 1; k < reach; ++k)
        for (int l = 0; l < reach; ++l) sum[l] += entry[l * reach + k] * neighbours[l * nx + k];
      for (int l = 1; l < reach; ++l) sum[0] += sum[l];
      product[node] = sum[0];
    }
}

}  // namespace mpm

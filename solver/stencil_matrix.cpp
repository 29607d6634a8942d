#include "solver/stencil_matrix.hpp"

namespace mpm {

StencilMatrix::StencilMatrix(const Grid& grid)
    : degree_(grid.x.degree),
      reach_(2 * degree_ + 1),
      x_{grid.x.count(), grid.x.periodic},
      y_{grid.y.count(), grid.y.periodic},
      entry_(grid.size() * entries(), 0.0),
      padded_(static_cast<std::size_t>((x_.count + 2 * degree_) * (y_.count + 2 * degree_)), Vec2::Zero()) {}

void StencilMatrix::assemble(const StencilTable& table, const ScalarField& particle_mass) {
  std::fill(entry_.begin(), entry_.end(), 0.0);
  switch (degree_) {
    case 1:
      return add_particles<1>(table, particle_mass);
    case 2:
      return add_particles<2>(table, particle_mass);
    default:
      return add_particles<3>(table, particle_mass);
  }
}

template <int degree>
void StencilMatrix::add_particles(const StencilTable& table, const ScalarField& particle_mass) {
  constexpr int support = degree + 1, reach = 2 * degree + 1, width = support * support;
  for (std::size_t p = 0; p < particle_mass.size(); ++p) {
    const int* node = table.node.data() + p * width;
    const double* value = table.value.data() + p * width;
    for (int k = 0; k < width; ++k) {
      // Of the row's neighbours, those in the particle's stencil begin here.
      double* row = entry_.data() + static_cast<std::size_t>(node[k]) * (reach * reach) +
                    (degree - k / support) * reach + degree - k % support;
      const double share = particle_mass[p] * value[k];
      for (int l = 0; l < support; ++l)
        for (int m = 0; m < support; ++m) row[l * reach + m] += share * value[l * support + m];
    }
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
      Vec2 sum = Vec2::Zero();
      for (int l = 0; l < reach; ++l)
        for (int k = 0; k < reach; ++k) sum += entry[l * reach + k] * neighbours[l * nx + k];
      product[node] = sum;
    }
}

}  // namespace mpm

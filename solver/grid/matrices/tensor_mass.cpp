#include "solver/grid/matrices/tensor_mass.hpp"

#include <algorithm>

#include "solver/grid/matrices/cholesky.hpp"
#include "solver/scene/seeding.hpp"

namespace mpm {

Eigen::MatrixXd mass_along(const Axis& axis) {
  // A rule that is exact for it.
  const CellPoints points = cell_points(Seeding::Rule::Gauss, axis.degree + 1);
  const int support = axis.degree + 1;
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(axis.count(), axis.count());
  std::vector<double> value(static_cast<std::size_t>(support));
  for (int cell = 0; cell < axis.cells; ++cell)
    for (std::size_t q = 0; q < points.position.size(); ++q) {
      const double* c = axis.polynomials(cell);
      for (int k = 0; k < support; ++k) {
        double& sum = value[static_cast<std::size_t>(k)];
        sum = 0;
        for (int m = axis.degree; m >= 0; --m) sum = sum * points.position[q] + c[m * support + k];
      }
      for (int k = 0; k < support; ++k)
        for (int l = 0; l < support; ++l)
          mass(axis.function(cell + k), axis.function(cell + l)) += axis.h * points.weight[q] *
                                                                    value[static_cast<std::size_t>(k)] *
                                                                    value[static_cast<std::size_t>(l)];
    }
  return mass;
}

namespace {

/// to(j, i) = from(i, j), a few rows at a time: the cache lines read and written are then used whole.
void transpose(const VectorField& from, std::size_t rows, std::size_t columns, VectorField& to) {
  constexpr std::size_t strip = 8;
  for (std::size_t begin = 0; begin < rows; begin += strip) {
    const std::size_t end = std::min(begin + strip, rows);
    for (std::size_t j = 0; j < columns; ++j)
      for (std::size_t i = begin; i < end; ++i) to[j * rows + i] = from[i * columns + j];
  }
}

}  // namespace

TensorMass::Factor::Factor(const Axis& axis) {
  const Eigen::MatrixXd mass = mass_along(axis);
  const Eigen::MatrixXd lower = cholesky_factor(mass);
  for (int j = 0; j < mass.cols(); ++j) {
    diagonal.push_back(mass(j, j));
    inverse_pivot.push_back(1 / lower(j, j));
    begin.push_back(static_cast<int>(row.size()));
    for (int i = j + 1; i < mass.rows(); ++i)
      if (lower(i, j) != 0) {  // the band, and the last rows where a periodic axis closes
        row.push_back(i);
        entry.push_back(lower(i, j));
      }
  }
  begin.push_back(static_cast<int>(row.size()));
}

TensorMass::TensorMass(const Grid& grid) : x_(grid.x), y_(grid.y), transposed_(grid.size()) {}

void TensorMass::solve_rows(const Factor& factor, double* rows, std::size_t width) {
  using Row = Eigen::Map<Eigen::RowVectorXd>;
  const auto at = [&](int i) {
    return Row(rows + static_cast<std::size_t>(i) * width, static_cast<Eigen::Index>(width));
  };
  const int n = static_cast<int>(factor.inverse_pivot.size());
  for (int j = 0; j < n; ++j) {
    const auto k = static_cast<std::size_t>(j);
    at(j) *= factor.inverse_pivot[k];
    for (int e = factor.begin[k]; e < factor.begin[k + 1]; ++e)
      at(factor.row[static_cast<std::size_t>(e)]) -= factor.entry[static_cast<std::size_t>(e)] * at(j);
  }
  for (int j = n - 1; j >= 0; --j) {
    const auto k = static_cast<std::size_t>(j);
    for (int e = factor.begin[k]; e < factor.begin[k + 1]; ++e)
      at(j) -= factor.entry[static_cast<std::size_t>(e)] * at(factor.row[static_cast<std::size_t>(e)]);
    at(j) *= factor.inverse_pivot[k];
  }
}

void TensorMass::solve(VectorField& field) {
  const std::size_t nx = x_.diagonal.size(), ny = y_.diagonal.size();
  solve_rows(y_, field.front().data(), 2 * nx);
  transpose(field, ny, nx, transposed_);
  solve_rows(x_, transposed_.front().data(), 2 * ny);
  transpose(transposed_, nx, ny, field);
}

}  // namespace mpm

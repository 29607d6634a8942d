#include "solver/incompressible/space/velocity_space.hpp"

#include <algorithm>
#include <cmath>

#include "solver/scene/seeding.hpp"

namespace mpm::incompressible {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

void append(Triplets& entries, const SparseMatrix& matrix, Eigen::Index row, Eigen::Index column,
            double factor) {
  for (int k = 0; k < matrix.outerSize(); ++k)
    for (SparseMatrix::InnerIterator it(matrix, k); it; ++it)
      entries.emplace_back(static_cast<int>(row + it.row()), static_cast<int>(column + it.col()),
                           factor * it.value());
}

SparseMatrix identity(int n) {
  SparseMatrix one(n, n);
  one.setIdentity();
  return one;
}

/// Derivative from the unknowns of a stream function to those of a velocity that it is tangential to.
SparseMatrix derivative_between_unknowns(const SplineAxis& axis) {
  const SparseMatrix all = axis.derivative() * axis.normal().extension();
  return all.topRows(axis.tangential().count);  // periodic functions beyond repeat the first
}

}  // namespace

SparseMatrix kronecker(const SparseMatrix& along_y, const SparseMatrix& along_x) {
  SparseMatrix product(along_x.rows() * along_y.rows(), along_x.cols() * along_y.cols());
  product.reserve(along_x.nonZeros() * along_y.nonZeros());
  for (int j = 0; j < along_y.outerSize(); ++j)
    for (int i = 0; i < along_x.outerSize(); ++i) {
      const Eigen::Index column = i + j * along_x.cols();
      product.startVec(column);
      for (SparseMatrix::InnerIterator y(along_y, j); y; ++y)
        for (SparseMatrix::InnerIterator x(along_x, i); x; ++x)
          product.insertBack(x.row() + y.row() * along_x.rows(), column) = x.value() * y.value();
    }
  product.finalize();
  return product;
}

SparseMatrix block_diagonal(const SparseMatrix& first, const SparseMatrix& second) {
  SparseMatrix both(first.rows() + second.rows(), first.cols() + second.cols());
  both.reserve(first.nonZeros() + second.nonZeros());
  for (const SparseMatrix* block : {&first, &second}) {
    const Eigen::Index row = block == &first ? 0 : first.rows(), column = block == &first ? 0 : first.cols();
    for (int k = 0; k < block->outerSize(); ++k) {
      both.startVec(column + k);
      for (SparseMatrix::InnerIterator it(*block, k); it; ++it)
        both.insertBack(row + it.row(), column + k) = it.value();
    }
  }
  both.finalize();
  return both;
}

SparseMatrix reduced_to(const SparseMatrix& basis, const SparseMatrix& form) {
  const SparseMatrix turned = basis.transpose(), of_basis = form * basis;
  SparseMatrix reduced = turned * of_basis;
  reduced.prune(0.0);
  return reduced;
}

PlaceInCell::PlaceInCell(const SplineAxis& axis, double x) {
  const double scaled = x / axis.cell_size();
  // What is not a number falls into the first cell, and shows in the velocity.
  cell = scaled > 0 ? static_cast<int>(std::min(scaled, axis.cells() - 1.0)) : 0;
  xi = scaled - cell;
}

VelocitySpace::VelocitySpace(const Scene& scene, int degree)
    : axes_{SplineAxis(scene.size.x(), scene.cells[0], scene.periodic(0), degree),
            SplineAxis(scene.size.y(), scene.cells[1], scene.periodic(1), degree)} {
  const CellPoints gauss = cell_points(Seeding::Rule::Gauss, degree + 1);
  std::array<std::vector<double>, 2> places;
  for (const std::size_t a : {0, 1}) {
    const SplineAxis& along = axes_[a];
    std::array<Triplets, 2> entries;
    for (int cell = 0; cell < along.cells(); ++cell)
      for (std::size_t g = 0; g < gauss.position.size(); ++g) {
        for (const int less : {0, 1}) {
          const VectorXd values =
              gauss.weight[g] * along.cell_size() * along.values(less, cell, gauss.position[g]);
          for (int m = 0; m < values.size(); ++m)
            entries[static_cast<std::size_t>(less)].emplace_back(cell + m, static_cast<int>(places[a].size()),
                                                                 values[m]);
        }
        places[a].push_back((cell + gauss.position[g]) * along.cell_size());
      }
    for (const std::size_t less : {0, 1}) {
      integrals_[a][less].resize(along.functions(static_cast<int>(less)),
                                 static_cast<Eigen::Index>(places[a].size()));
      integrals_[a][less].setFromTriplets(entries[less].begin(), entries[less].end());
    }
  }
  for (const double y : places[1])
    for (const double x : places[0]) points_.emplace_back(x, y);
}

void VelocitySpace::extend(int component, const double* of, MatrixXd& to) const {
  const Unknowns &x = unknowns(component, 0), &y = unknowns(component, 1);
  to.resize(static_cast<Eigen::Index>(x.of.size()), static_cast<Eigen::Index>(y.of.size()));
  for (std::size_t j = 0; j < y.of.size(); ++j)
    for (std::size_t i = 0; i < x.of.size(); ++i)
      to(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          x.of[i] < 0 || y.of[j] < 0 ? 0 : of[x.of[i] + static_cast<std::ptrdiff_t>(y.of[j]) * x.count];
}

void VelocitySpace::fold(int component, const MatrixXd& from, double* to) const {
  const Unknowns &x = unknowns(component, 0), &y = unknowns(component, 1);
  std::fill(to, to + size(component), 0.0);
  for (std::size_t j = 0; j < y.of.size(); ++j)
    for (std::size_t i = 0; i < x.of.size(); ++i)
      if (x.of[i] >= 0 && y.of[j] >= 0)
        to[x.of[i] + static_cast<std::ptrdiff_t>(y.of[j]) * x.count] +=
            from(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
}

VelocityField VelocitySpace::extended(const VectorXd& unknowns) const {
  VelocityField field;
  extend(0, unknowns.data(), field.u);
  extend(1, unknowns.data() + size(0), field.v);
  return field;
}

VectorXd VelocitySpace::folded(const VelocityField& functions) const {
  VectorXd sums(size());
  fold(0, functions.u, sums.data());
  fold(1, functions.v, sums.data() + size(0));
  return sums;
}

SparseMatrix VelocitySpace::solenoidal_basis() const {
  const SplineAxis &x = axis(0), &y = axis(1);
  // u = d psi/dy, v = -d psi/dx
  const SparseMatrix u_of_psi = kronecker(derivative_between_unknowns(y), identity(x.normal().count));
  const SparseMatrix v_of_psi = kronecker(identity(y.normal().count), derivative_between_unknowns(x));
  // A constant stream function says nothing: without walls the last unknown is left out.
  const bool boundless = x.periodic() && y.periodic();
  const Eigen::Index curls = u_of_psi.cols() - (boundless ? 1 : 0);

  Triplets entries;
  append(entries, u_of_psi.leftCols(curls), 0, 0, 1);
  append(entries, v_of_psi.leftCols(curls), size(0), 0, -1);
  Eigen::Index columns = curls;
  for (const int along : {0, 1}) {
    const SplineAxis& across = axis(1 - along);
    if (!axis(along).periodic()) continue;
    // Between walls the flux: a stream function that rises from one wall to the other in the last function
    // alone. Without walls the uniform velocity.
    VectorXd profile = VectorXd::Ones(across.tangential().count);
    if (!across.periodic()) profile = VectorXd(across.derivative().col(across.functions(0) - 1));
    const int count_along = unknowns(along, along).count;
    for (int i = 0; i < count_along; ++i)
      for (Eigen::Index j = 0; j < profile.size(); ++j) {
        if (profile[j] == 0) continue;
        const Eigen::Index row = along == 0 ? i + j * count_along : size(0) + j + i * profile.size();
        entries.emplace_back(static_cast<int>(row), static_cast<int>(columns), profile[j]);
      }
    ++columns;
  }
  SparseMatrix basis(size(), columns);
  basis.setFromTriplets(entries.begin(), entries.end());
  return basis;
}

SparseMatrix VelocitySpace::divergence() const {
  const SplineAxis &x = axis(0), &y = axis(1);
  const SparseMatrix of_u = kronecker(identity(y.tangential().count), derivative_between_unknowns(x));
  const SparseMatrix of_v = kronecker(derivative_between_unknowns(y), identity(x.tangential().count));
  Triplets entries;
  append(entries, of_u, 0, 0, 1);
  append(entries, of_v, 0, size(0), 1);
  SparseMatrix both(of_u.rows(), size());
  both.setFromTriplets(entries.begin(), entries.end());
  return both;
}

VectorXd VelocitySpace::load(
    const std::function<void(const VectorField& points, VectorField& values)>& field) const {
  VectorField values(points_.size(), Vec2::Zero());
  field(points_, values);
  const Eigen::Map<const MatrixXd, 0, Eigen::Stride<Eigen::Dynamic, 2>> u(
      values.front().data(), integrals_[0][0].cols(), integrals_[1][0].cols(),
      {2 * integrals_[0][0].cols(), 2}),
      v(values.front().data() + 1, integrals_[0][0].cols(), integrals_[1][0].cols(),
        {2 * integrals_[0][0].cols(), 2});
  const auto integrated = [](const SparseMatrix& along_x, const MatrixXd& at_points,
                             const SparseMatrix& along_y) -> MatrixXd {
    const MatrixXd turned = (along_x * at_points).transpose();
    return (along_y * turned).transpose();
  };
  return folded(
      {integrated(integrals_[0][0], u, integrals_[1][1]), integrated(integrals_[0][1], v, integrals_[1][0])});
}

Vec2 VelocitySpace::value(const VelocityField& field, const Vec2& x) const {
  const PlaceInCell px(axis(0), x.x()), py(axis(1), x.y());
  const int k = degree();
  return {axis(0)
              .values(0, px.cell, px.xi)
              .dot(field.u.block(px.cell, py.cell, k + 1, k) * axis(1).values(1, py.cell, py.xi)),
          axis(0)
              .values(1, px.cell, px.xi)
              .dot(field.v.block(px.cell, py.cell, k, k + 1) * axis(1).values(0, py.cell, py.xi))};
}

Mat2 VelocitySpace::gradient(const VelocityField& field, const Vec2& x) const {
  const PlaceInCell px(axis(0), x.x()), py(axis(1), x.y());
  const int k = degree();
  const auto u = field.u.block(px.cell, py.cell, k + 1, k);
  const auto v = field.v.block(px.cell, py.cell, k, k + 1);
  Mat2 l;
  l(0, 0) = axis(0).slopes(0, px.cell, px.xi).dot(u * axis(1).values(1, py.cell, py.xi));
  l(0, 1) = axis(0).values(0, px.cell, px.xi).dot(u * axis(1).slopes(1, py.cell, py.xi));
  l(1, 0) = axis(0).slopes(1, px.cell, px.xi).dot(v * axis(1).values(0, py.cell, py.xi));
  l(1, 1) = axis(0).values(1, px.cell, px.xi).dot(v * axis(1).slopes(0, py.cell, py.xi));
  return l;
}

}  // namespace mpm::incompressible

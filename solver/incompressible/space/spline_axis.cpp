#include "solver/incompressible/space/spline_axis.hpp"

#include <algorithm>

#include "solver/scene/seeding.hpp"

namespace mpm::incompressible {
namespace {

/// All functions, or those but the first and the last, which alone are not zero at the ends.
Unknowns unknowns_between_walls(int functions, bool zero_at_walls) {
  Unknowns unknowns;
  for (int i = 0; i < functions; ++i)
    unknowns.of.push_back(zero_at_walls && (i == 0 || i == functions - 1) ? -1 : unknowns.count++);
  return unknowns;
}

Unknowns periodic_unknowns(int functions, int cells) {
  Unknowns unknowns;
  for (int i = 0; i < functions; ++i) unknowns.of.push_back(i % cells);
  unknowns.count = cells;
  return unknowns;
}

}  // namespace

SparseMatrix Unknowns::extension() const {
  SparseMatrix matrix(static_cast<Eigen::Index>(of.size()), count);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < of.size(); ++i)
    if (of[i] >= 0) entries.emplace_back(static_cast<int>(i), of[i], 1.0);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

SplineAxis::SplineAxis(double length, int cells, bool periodic, int degree)
    : length_(length), cells_(cells), degree_(degree), periodic_(periodic) {
  for (const int less : {0, 1})
    for (int cell = 0; cell < cells; ++cell) {
      const std::vector<double> one = polynomials_in(cell, degree - less);
      auto& all = polynomials_[static_cast<std::size_t>(less)];
      all.insert(all.end(), one.begin(), one.end());
    }
  normal_ = periodic ? periodic_unknowns(functions(0), cells) : unknowns_between_walls(functions(0), true);
  tangential_ =
      periodic ? periodic_unknowns(functions(1), cells) : unknowns_between_walls(functions(1), false);
}

/// Knot i of the functions of a degree: function i lives on knots i .. i + degree + 1.
double SplineAxis::knot(int i, int degree) const {
  const int place = i - degree;
  return periodic_ ? place : std::clamp(place, 0, cells_);
}

/// Cox and de Boor's recursion on the polynomials themselves.
std::vector<double> SplineAxis::polynomials_in(int cell, int degree) const {
  // rising[a] = coefficients of the a-th function that is not zero here, lowest power first
  std::vector<std::vector<double>> rising = {{1.0}};
  for (int d = 1; d <= degree; ++d) {
    std::vector<std::vector<double>> next(static_cast<std::size_t>(d) + 1,
                                          std::vector<double>(static_cast<std::size_t>(d) + 1, 0.0));
    for (int a = 0; a <= d; ++a) {
      // function `cell + a` of degree d; knots are numbered for that degree
      const auto add = [&](const std::vector<double>& lower, double constant, double linear) {
        for (std::size_t m = 0; m < lower.size(); ++m) {
          next[static_cast<std::size_t>(a)][m] += constant * lower[m];
          next[static_cast<std::size_t>(a)][m + 1] += linear * lower[m];
        }
      };
      const double first = knot(cell + a, d), last = knot(cell + a + d + 1, d);
      if (a > 0) {  // left part: lower function a - 1
        const double width = knot(cell + a + d, d) - first;
        add(rising[static_cast<std::size_t>(a) - 1], (cell - first) / width, 1 / width);
      }
      if (a < d) {
        const double width = last - knot(cell + a + 1, d);
        add(rising[static_cast<std::size_t>(a)], (last - cell) / width, -1 / width);
      }
    }
    rising = std::move(next);
  }
  const auto size = static_cast<std::size_t>(degree) + 1;
  std::vector<double> falling(size * size);
  for (std::size_t a = 0; a < size; ++a)
    for (std::size_t m = 0; m < size; ++m) falling[(size - 1 - m) * size + a] = rising[a][m];
  return falling;
}

VectorXd SplineAxis::values(int less, int cell, double xi) const {
  const int size = degree_ - less + 1;
  const double* c = polynomials(less, cell);
  VectorXd sum = VectorXd::Zero(size);
  for (int m = 0; m < size; ++m) sum = sum * xi + Eigen::Map<const VectorXd>(c + m * size, size);
  return sum;
}

VectorXd SplineAxis::slopes(int less, int cell, double xi) const {
  const int size = degree_ - less + 1;
  const double* c = polynomials(less, cell);
  VectorXd sum = VectorXd::Zero(size);
  for (int m = 0; m + 1 < size; ++m)
    sum = sum * xi + (size - 1 - m) * Eigen::Map<const VectorXd>(c + m * size, size);
  return sum / cell_size();
}

VectorXd SplineAxis::curvatures(int cell, double xi) const {
  const int size = degree_ + 1;
  const double* c = polynomials(0, cell);
  VectorXd sum = VectorXd::Zero(size);
  for (int m = 0; m + 2 < size; ++m)
    sum = sum * xi + (size - 1 - m) * (size - 2 - m) * Eigen::Map<const VectorXd>(c + m * size, size);
  return sum / (cell_size() * cell_size());
}

template <class Values>
SparseMatrix SplineAxis::integrated(int less, const Values& values_at) const {
  const CellPoints gauss = cell_points(Seeding::Rule::Gauss, degree_ + 1);
  std::vector<Eigen::Triplet<double>> entries;
  for (int cell = 0; cell < cells_; ++cell) {
    const int size = degree_ - less + 1;
    MatrixXd block = MatrixXd::Zero(size, size);
    for (std::size_t q = 0; q < gauss.position.size(); ++q) {
      const VectorXd n = values_at(cell, gauss.position[q]);
      block += gauss.weight[q] * cell_size() * n * n.transpose();
    }
    for (int a = 0; a < size; ++a)
      for (int b = 0; b < size; ++b) entries.emplace_back(cell + a, cell + b, block(a, b));
  }
  SparseMatrix matrix(functions(less), functions(less));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

SparseMatrix SplineAxis::mass(int less) const {
  return integrated(less, [&](int cell, double xi) { return values(less, cell, xi); });
}

SparseMatrix SplineAxis::stiffness(int less) const {
  return integrated(less, [&](int cell, double xi) { return slopes(less, cell, xi); });
}

/// N_i' = k/(t_{i+k} - t_i) M_{i-1} - k/(t_{i+k+1} - t_{i+1}) M_i
SparseMatrix SplineAxis::derivative() const {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < functions(1); ++i) {
    const double slope = degree_ / ((knot(i + 1 + degree_, degree_) - knot(i + 1, degree_)) * cell_size());
    entries.emplace_back(i, i, -slope);
    entries.emplace_back(i, i + 1, slope);
  }
  SparseMatrix matrix(functions(1), functions(0));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

VectorXd SplineAxis::integrals(int less) const {
  return mass(less) * VectorXd::Ones(functions(less));  // the functions sum to one
}

VectorXd SplineAxis::end_values(int end) const {
  VectorXd all = VectorXd::Zero(functions(1));
  all.segment(end == 0 ? 0 : cells_ - 1, degree_) = values(1, end == 0 ? 0 : cells_ - 1, end);
  return all;
}

VectorXd SplineAxis::end_slopes(int end) const {
  VectorXd all = VectorXd::Zero(functions(1));
  all.segment(end == 0 ? 0 : cells_ - 1, degree_) = slopes(1, end == 0 ? 0 : cells_ - 1, end);
  return all;
}

}  // namespace mpm::incompressible

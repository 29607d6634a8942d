#include "solver/grid/axis.hpp"

namespace mpm {
namespace {

/// Knot i of the knot vector that starts with function 0, seen from a cell: in cells, the cell being [0, 1].
int knot(int i, int cell, int cells, bool periodic, int degree) {
  const int position = i - degree;
  return (periodic ? position : std::clamp(position, 0, cells)) - cell;
}

using Polynomial = std::vector<double>;  // coefficients of 1, s, s^2, ...

/// Adds (a + b s) p to sum.
void add_product(double a, double b, const Polynomial& p, Polynomial& sum) {
  for (std::size_t m = 0; m < p.size(); ++m) {
    sum[m] += a * p[m];
    if (m + 1 < sum.size()) sum[m + 1] += b * p[m];
  }
}

/// The degree + 1 functions that do not vanish in a cell, as polynomials, by the recursion of Cox and de
/// Boor.
std::vector<Polynomial> functions_in(int cell, int cells, bool periodic, int degree) {
  const auto t = [=](int i) { return knot(i, cell, cells, periodic, degree); };
  const auto size = static_cast<std::size_t>(degree + 1);
  // N_i of degree 0 is one on the cell's own knot span only: that of function cell + degree.
  std::vector<Polynomial> functions(size, Polynomial(size, 0.0));
  functions.back()[0] = 1;
  for (int p = 1; p <= degree; ++p) {
    for (int k = degree - p; k <= degree; ++k) {
      const int i = cell + k;
      Polynomial raised(size, 0.0);
      if (const int width = t(i + p) - t(i); width > 0 && k > degree - p)
        add_product(-static_cast<double>(t(i)) / width, 1.0 / width, functions[static_cast<std::size_t>(k)],
                    raised);
      if (const int width = t(i + p + 1) - t(i + 1); width > 0 && k < degree)
        add_product(static_cast<double>(t(i + p + 1)) / width, -1.0 / width,
                    functions[static_cast<std::size_t>(k + 1)], raised);
      functions[static_cast<std::size_t>(k)] = raised;
    }
  }
  return functions;
}

}  // namespace

Axis::Axis(double length, int cells, bool periodic, int degree)
    : length(length),
      h(length / cells),
      inverse_h(cells / length),
      cells(cells),
      degree(degree),
      periodic(periodic),
      count_(periodic ? cells : cells + degree) {
  for (int k = 0; k < cells + degree; ++k) {
    function_.push_back(periodic ? k % cells : k);
    double sum = 0;
    for (int i = k + 1; i <= k + degree; ++i) sum += knot(i, 0, cells, periodic, degree);
    // Without knots to average (degree 0) the function sits in the middle of its cell. The last control point
    // between walls is the wall itself, not cells * h, which may differ in the last bit.
    const double position = degree == 0 ? k + 0.5 : sum / degree;
    control_point_.push_back(!periodic && k == count_ - 1 && degree > 0 ? length : position * h);
  }
  const int reach = periodic ? 0 : std::max(degree - 1, 0);  // cells whose functions feel a wall
  std::size_t inner = 0;
  bool have_inner = false;
  for (int cell = 0; cell < cells; ++cell) {
    const bool is_inner = cell >= reach && cell < cells - reach;
    if (!is_inner || !have_inner) {
      const std::size_t start = coefficients_.size();
      const auto functions = functions_in(cell, cells, periodic, degree);
      for (std::size_t m = 0; m < functions.size(); ++m)
        for (const Polynomial& function : functions) coefficients_.push_back(function[m]);
      if (is_inner) {
        inner = start;
        have_inner = true;
      }
      piece_.push_back(start);
    } else {
      piece_.push_back(inner);
    }
  }
}

std::vector<double> Axis::integrals() const {
  std::vector<double> sum(static_cast<std::size_t>(count_), 0);
  for (int cell = 0; cell < cells; ++cell)
    for (int k = 0; k <= degree; ++k)
      for (int m = 0; m <= degree; ++m)
        sum[static_cast<std::size_t>(function(cell + k))] +=
            h * polynomials(cell)[m * (degree + 1) + k] / (m + 1);
  return sum;
}

}  // namespace mpm

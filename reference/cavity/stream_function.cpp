#include "reference/cavity/stream_function.hpp"

#include <gsl/gsl_integration.h>

#include <Eigen/LU>
#include <Eigen/Sparse>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "reference/cavity/nested_dissection.hpp"
#include "reference/interruption.hpp"
#include "reference/require.hpp"

namespace reference {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_newton_steps = 40;
constexpr double newton_tolerance = 1e-11;  // largest change of a coefficient; psi is some 0.1

/// The functions of an axis at the Gauss points of one of its spans.
struct Span {
  int first;        // function
  VectorXd weight;  // of the points
  MatrixXd of;      // function; point, derivative (0, 1, 2)
  MatrixXd pairs;   // function, other function; point, derivative, other derivative: their products
};

std::vector<Span> gauss_points(const SplineAxis& axis) {
  const Index count = axis.degree() + 1;
  const std::unique_ptr<gsl_integration_glfixed_table, decltype(&gsl_integration_glfixed_table_free)> table(
      gsl_integration_glfixed_table_alloc(static_cast<std::size_t>(count)),
      &gsl_integration_glfixed_table_free);
  std::vector<Span> spans;
  for (int s = 0; s < axis.spans(); ++s) {
    Span span{0, VectorXd(count), MatrixXd(count, 3 * count), MatrixXd(count * count, 9 * count)};
    for (Index g = 0; g < count; ++g) {
      double x = 0;
      gsl_integration_glfixed_point(axis.start(s), axis.start(s) + axis.width(s), static_cast<std::size_t>(g),
                                    &x, &span.weight[g], table.get());
      const SplineAxis::Local local = axis.at(x, s);
      span.first = local.first;
      span.of.middleCols<3>(3 * g) = local.of.transpose();
      for (Index d = 0; d < 3; ++d)
        for (Index e = 0; e < 3; ++e)
          span.pairs.col(9 * g + 3 * d + e) = (local.of.row(d).transpose() * local.of.row(e)).reshaped();
    }
    spans.push_back(std::move(span));
  }
  return spans;
}

/// The discrete equations among the coefficients that no wall prescribes: rows and columns 2 to size - 3.
class Equations {
 public:
  Equations(const SplineAxis& axis, const CavityViscosity& viscosity)
      : axis_(axis),
        viscosity_(viscosity),
        spans_(gauss_points(axis)),
        inner_(axis.size() - 4),
        matrix_(inner_ * inner_, inner_ * inner_) {
    lay_out();
  }

  /// Adds one step of Newton's method; the largest change of a coefficient.
  double improve(MatrixXd& coefficients) {
    assemble(coefficients);
    if (!analysed_) solver_.analyzePattern(matrix_);
    analysed_ = true;
    solver_.factorize(matrix_);
    if (solver_.info() != Eigen::Success) return std::nan("");
    const VectorXd step = solver_.solve(-residual_);
    coefficients.block(2, 2, inner_, inner_) += step.reshaped(inner_, inner_);
    return step.lpNorm<Eigen::Infinity>();
  }

 private:
  /// Every function meets those up to a degree away along either axis.
  void lay_out() {
    const Index p = axis_.degree(), n = inner_;
    Eigen::VectorXi count(n * n);
    const auto width = [&](Index i) { return std::min(n - 1, i + p) - std::max<Index>(0, i - p) + 1; };
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) count[i + n * j] = static_cast<int>(width(i) * width(j));
    matrix_.reserve(count);
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i)
        for (Index b = std::max<Index>(0, j - p); b <= std::min(n - 1, j + p); ++b)
          for (Index a = std::max<Index>(0, i - p); a <= std::min(n - 1, i + p); ++a)
            matrix_.insert(a + n * b, i + n * j) = 0;
    matrix_.makeCompressed();
  }

  double& entry(Index a, Index b, Index i, Index j) {
    const Index p = axis_.degree(), n = inner_, first_a = std::max<Index>(0, i - p),
                first_b = std::max<Index>(0, j - p), width = std::min(n - 1, i + p) - first_a + 1;
    return matrix_.valuePtr()[matrix_.outerIndexPtr()[i + n * j] + (b - first_b) * width + (a - first_a)];
  }

  void assemble(const MatrixXd& coefficients) {
    matrix_.coeffs().setZero();
    residual_ = VectorXd::Zero(inner_ * inner_);
    for (const Span& y : spans_) {
      between_steps();
      for (const Span& x : spans_) add(x, y, coefficients);
    }
  }

  /// A derivative of a function along x and y.
  struct Derivative {
    Index x, y;
  };
  static constexpr Derivative by_x{1, 0}, by_y{0, 1}, by_xx{2, 0}, by_xy{1, 1}, by_yy{0, 2};

  /// One cell. What its points ask of pairs of derivatives is summed along x with the products of functions
  /// there, then along y.
  void add(const Span& x, const Span& y, const MatrixXd& coefficients) {
    const Index p1 = axis_.degree() + 1;
    const MatrixXd psi = x.of.transpose() * coefficients.block(x.first, y.first, p1, p1) * y.of;
    of_pairs_.setZero(9 * p1, 9 * p1);
    MatrixXd of_tests = MatrixXd::Zero(3 * p1, 3 * p1);
    for (Index b = 0; b < p1; ++b)
      for (Index a = 0; a < p1; ++a) {
        const auto of_psi = [&](Derivative d) { return psi(3 * a + d.x, 3 * b + d.y); };
        const auto of_test = [&](Derivative d) -> double& { return of_tests(3 * a + d.x, 3 * b + d.y); };
        const auto of_pair = [&](Derivative test, Derivative trial) -> double& {
          return of_pairs_(9 * a + 3 * test.x + trial.x, 9 * b + 3 * test.y + trial.y);
        };
        const double weight = x.weight[a] * y.weight[b];
        const double psi_x = of_psi(by_x), psi_y = of_psi(by_y), psi_xy = of_psi(by_xy),
                     shear = of_psi(by_yy) - of_psi(by_xx), lap = of_psi(by_xx) + of_psi(by_yy);
        const auto [nu, by_q] = viscosity_.at(4 * psi_xy * psi_xy + shear * shear);
        // The stress 4 nu psi_xy, nu shear, and the momentum lap (psi_y phi_x - psi_x phi_y).
        of_test(by_xy) = weight * nu * 4 * psi_xy;
        of_test(by_yy) = weight * nu * shear;
        of_test(by_xx) = -weight * nu * shear;
        of_test(by_x) = weight * lap * psi_y;
        of_test(by_y) = -weight * lap * psi_x;
        // Their derivatives by psi.
        const double steeper = 2 * weight * by_q;
        const double both = steeper * 4 * psi_xy * shear, across = weight * nu + steeper * shear * shear;
        of_pair(by_xy, by_xy) = 4 * weight * nu + steeper * 16 * psi_xy * psi_xy;
        of_pair(by_xy, by_yy) = of_pair(by_yy, by_xy) = both;
        of_pair(by_xy, by_xx) = of_pair(by_xx, by_xy) = -both;
        of_pair(by_yy, by_yy) += across;
        of_pair(by_xx, by_xx) += across;
        of_pair(by_yy, by_xx) -= across;
        of_pair(by_xx, by_yy) -= across;
        for (const Derivative trial : {by_xx, by_yy}) {
          of_pair(by_x, trial) += weight * psi_y;
          of_pair(by_y, trial) -= weight * psi_x;
        }
        of_pair(by_x, by_y) += weight * lap;
        of_pair(by_y, by_x) -= weight * lap;
      }
    const MatrixXd load = x.of * of_tests * y.of.transpose();
    along_x_.noalias() = x.pairs * of_pairs_;
    block_.noalias() = along_x_ * y.pairs.transpose();  // test and trial along x; along y
    const auto inside = [&](Index i) { return i >= 0 && i < inner_; };
    for (Index j = 0; j < p1; ++j)
      for (Index i = 0; i < p1; ++i) {
        const Index column_x = x.first + i - 2, column_y = y.first + j - 2;
        if (!inside(column_x) || !inside(column_y)) continue;
        residual_[column_x + inner_ * column_y] += load(i, j);
        for (Index b = 0; b < p1; ++b)
          for (Index a = 0; a < p1; ++a) {
            const Index row_x = x.first + a - 2, row_y = y.first + b - 2;
            if (inside(row_x) && inside(row_y))
              entry(row_x, row_y, column_x, column_y) += block_(a + p1 * i, b + p1 * j);
          }
      }
  }

  const SplineAxis& axis_;
  const CavityViscosity& viscosity_;
  std::vector<Span> spans_;
  Index inner_;
  Eigen::SparseMatrix<double> matrix_;
  VectorXd residual_;
  MatrixXd of_pairs_, along_x_, block_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>, NestedDissection> solver_;
  bool analysed_ = false;
};

/// Coefficients of the spline that equals another at the Greville points.
MatrixXd interpolated(const SplineAxis& axis, const CavityStreamFunction& flow) {
  const int n = axis.size();
  MatrixXd collocation = MatrixXd::Zero(n, n), values(n, n);
  for (int i = 0; i < n; ++i) {
    const auto local = axis.at(axis.greville(i));
    collocation.block(i, local.first, 1, axis.degree() + 1) = local.of.row(0);
    for (int j = 0; j < n; ++j) values(i, j) = flow.stream(axis.greville(i), axis.greville(j));
  }
  const Eigen::PartialPivLU<MatrixXd> solver(collocation);
  const MatrixXd along = solver.solve(values);
  return solver.solve(along.transpose()).transpose();
}

}  // namespace

CavityStreamFunction::CavityStreamFunction(const CavityViscosity& viscosity, const Mesh& mesh,
                                           const CavityStreamFunction* start)
    : axis_(clustered_breaks(mesh.spans, mesh.clustering), mesh.degree) {
  require(mesh.spans >= 4, "stream function of the cavity: at least 4 spans along an axis");
  const int n = axis_.size();
  MatrixXd all = MatrixXd::Zero(n, n);
  if (start) all.block(2, 2, n - 4, n - 4) = interpolated(axis_, *start).block(2, 2, n - 4, n - 4);
  // psi_y = 1 at y = 1: the slope of a clamped spline is degree/width times its last difference.
  all.block(2, n - 2, n - 4, 1).setConstant(-axis_.width(axis_.spans() - 1) / axis_.degree());
  Equations equations(axis_, viscosity);
  coefficients_ = std::move(all);
  for (iterations_ = 1; iterations_ <= most_newton_steps; ++iterations_) {
    const double change = equations.improve(coefficients_);
    if (change < newton_tolerance) return;
    if (!std::isfinite(change)) break;
  }
  throw std::runtime_error("Newton's method does not find the stream function of the cavity");
}

double CavityStreamFunction::stream(double x, double y) const {
  const auto a = axis_.at(x), b = axis_.at(y);
  const int m = axis_.degree() + 1;
  return a.of.row(0).dot(coefficients_.block(a.first, b.first, m, m) * b.of.row(0).transpose());
}

std::array<double, 2> CavityStreamFunction::velocity(double x, double y) const {
  const auto a = axis_.at(x), b = axis_.at(y);
  const int m = axis_.degree() + 1;
  const auto local = coefficients_.block(a.first, b.first, m, m);
  return {a.of.row(0).dot(local * b.of.row(1).transpose()),
          -a.of.row(1).dot(local * b.of.row(0).transpose())};
}

}  // namespace reference

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
  VectorXd weight;
  std::vector<SplineAxis::Local> at;
};

std::vector<Span> gauss_points(const SplineAxis& axis) {
  const auto count = static_cast<std::size_t>(axis.degree()) + 1;
  const std::unique_ptr<gsl_integration_glfixed_table, decltype(&gsl_integration_glfixed_table_free)> table(
      gsl_integration_glfixed_table_alloc(count), &gsl_integration_glfixed_table_free);
  std::vector<Span> spans;
  for (int s = 0; s < axis.spans(); ++s) {
    Span span{VectorXd(static_cast<Index>(count)), {}};
    for (std::size_t i = 0; i < count; ++i) {
      double x = 0;
      gsl_integration_glfixed_point(axis.start(s), axis.start(s) + axis.width(s), i, &x,
                                    &span.weight[static_cast<Index>(i)], table.get());
      span.at.push_back(axis.at(x, s));
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

  /// One cell. Rows of the local matrices: points; columns: its functions, x fastest.
  void add(const Span& x, const Span& y, const MatrixXd& coefficients) {
    const Index p1 = axis_.degree() + 1, points = p1 * p1;
    const int first_x = x.at.front().first, first_y = y.at.front().first;
    const VectorXd local = coefficients.block(first_x, first_y, p1, p1).reshaped();
    tests_.resize(points * 5, points);
    trials_.resize(points * 5, points);
    VectorXd load = VectorXd::Zero(points);
    for (Index b = 0; b < p1; ++b)
      for (Index a = 0; a < p1; ++a) {
        const auto& at_x = x.at[static_cast<std::size_t>(a)].of;
        const auto& at_y = y.at[static_cast<std::size_t>(b)].of;
        const auto product = [&](int along, int across) -> Eigen::RowVectorXd {
          return (at_x.row(along).transpose() * at_y.row(across)).reshaped().transpose();
        };
        const double weight = x.weight[a] * y.weight[b];
        const Eigen::RowVectorXd by_x = product(1, 0), by_y = product(0, 1), by_xy = product(1, 1),
                                 by_xx = product(2, 0), by_yy = product(0, 2);
        const Eigen::RowVectorXd shear = by_yy - by_xx, laplacian = by_xx + by_yy;
        const double psi_x = by_x.dot(local), psi_y = by_y.dot(local), psi_xy = by_xy.dot(local),
                     s = shear.dot(local), lap = laplacian.dot(local);
        const auto [nu, by_q] = viscosity_.at(4 * psi_xy * psi_xy + s * s);
        const Eigen::RowVectorXd stretched = 4 * psi_xy * by_xy + s * shear;  // half of the change of q
        const Eigen::RowVectorXd carried = psi_y * by_x - psi_x * by_y;
        load += weight * (nu * stretched + lap * carried).transpose();
        const Index row = 5 * (a + p1 * b);
        const double root = std::sqrt(weight);
        tests_.row(row) = 4 * root * nu * by_xy, trials_.row(row) = root * by_xy;
        tests_.row(row + 1) = root * nu * shear, trials_.row(row + 1) = root * shear;
        tests_.row(row + 2) = 2 * root * by_q * stretched, trials_.row(row + 2) = root * stretched;
        tests_.row(row + 3) = root * carried, trials_.row(row + 3) = root * laplacian;
        tests_.row(row + 4) = root * lap * by_x, trials_.row(row + 4) = root * by_y;
        // The last term, - lap psi (phi_y)(dpsi_x), shares no factor with the others.
        extra_tests_.resize(points, points), extra_trials_.resize(points, points);
        extra_tests_.row(row / 5) = -root * lap * by_y, extra_trials_.row(row / 5) = root * by_x;
      }
    block_.noalias() = tests_.transpose() * trials_;
    block_.noalias() += extra_tests_.transpose() * extra_trials_;
    const auto inside = [&](Index i) { return i >= 0 && i < inner_; };
    for (Index j = 0; j < p1; ++j)
      for (Index i = 0; i < p1; ++i) {
        const Index column_x = first_x + i - 2, column_y = first_y + j - 2;
        if (!inside(column_x) || !inside(column_y)) continue;
        residual_[column_x + inner_ * column_y] += load[i + p1 * j];
        for (Index b = 0; b < p1; ++b)
          for (Index a = 0; a < p1; ++a) {
            const Index row_x = first_x + a - 2, row_y = first_y + b - 2;
            if (inside(row_x) && inside(row_y))
              entry(row_x, row_y, column_x, column_y) += block_(a + p1 * b, i + p1 * j);
          }
      }
  }

  const SplineAxis& axis_;
  const CavityViscosity& viscosity_;
  std::vector<Span> spans_;
  Index inner_;
  Eigen::SparseMatrix<double> matrix_;
  VectorXd residual_;
  MatrixXd tests_, trials_, extra_tests_, extra_trials_, block_;
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

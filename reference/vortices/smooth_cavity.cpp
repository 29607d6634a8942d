#include "reference/vortices/smooth_cavity.hpp"

#include <gsl/gsl_integration.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "reference/interruption.hpp"
#include "reference/require.hpp"

namespace reference {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The functions of an axis at places in [0, 1]: value, slope and curvature, one row a place.
struct Functions {
  MatrixXd value, slope, curvature;
};

Functions functions_at(const VectorXd& x, int count) {
  const int n = count + 4;
  const Eigen::Index places = x.size();
  MatrixXd p(places, n), d(places, n),
      dd(places, n);  // Legendre polynomials of s = 2 x - 1, derivatives by s
  p.col(0).setOnes(), d.col(0).setZero(), dd.col(0).setZero();
  p.col(1) = 2 * x.array() - 1, d.col(1).setOnes(), dd.col(1).setZero();
  for (int k = 1; k + 1 < n; ++k) {
    p.col(k + 1) = ((2 * k + 1) * p.col(1).cwiseProduct(p.col(k)) - k * p.col(k - 1)) / (k + 1);
    d.col(k + 1) = d.col(k - 1) + (2 * k + 1) * p.col(k);
    dd.col(k + 1) = dd.col(k - 1) + (2 * k + 1) * d.col(k);
  }
  Functions f{MatrixXd(places, count), MatrixXd(places, count), MatrixXd(places, count)};
  for (int k = 0; k < count; ++k) {
    const double scale = 1 / std::sqrt(2.0 * (2 * k + 3) * (2 * k + 3) * (2 * k + 5));
    const double b = -2.0 * (2 * k + 5) / (2 * k + 7), c = (2.0 * k + 3) / (2 * k + 7);
    const auto combined = [&](const MatrixXd& of) -> VectorXd {
      return scale * (of.col(k) + b * of.col(k + 2) + c * of.col(k + 4));
    };
    f.value.col(k) = combined(p);
    f.slope.col(k) = 2 * combined(d);
    f.curvature.col(k) = 4 * combined(dd);
  }
  return f;
}

/// Along x and along y of the part of the stream function that moves with the lid: values, slopes,
/// curvatures.
std::array<double, 3> lid_along(double x) {
  return {16 * x * x * (1 - x) * (1 - x), 32 * x * (1 - x) * (1 - 2 * x), 32 * (1 - 6 * x + 6 * x * x)};
}
std::array<double, 3> lid_across(double y) {
  return {y * y * (y - 1), y * (3 * y - 2), 6 * y - 2};
}

/// A stream function at the points of integration: slopes and Laplacian.
struct Field {
  VectorXd x, y, laplacian;
};

/// All functions of the square at all points of integration.
class Square {
 public:
  explicit Square(int functions) {
    // Products of three functions of degree functions + 3: exact.
    const auto n = static_cast<std::size_t>((3 * (functions + 3)) / 2 + 1);
    const std::unique_ptr<gsl_integration_glfixed_table, decltype(&gsl_integration_glfixed_table_free)> table(
        gsl_integration_glfixed_table_alloc(n), &gsl_integration_glfixed_table_free);
    VectorXd place(static_cast<Eigen::Index>(n)), weight(place.size());
    for (std::size_t i = 0; i < n; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      gsl_integration_glfixed_point(0, 1, i, &place[k], &weight[k], table.get());
    }
    const Functions f = functions_at(place, functions);
    const Eigen::Index m = place.size();
    weights_.resize(m * m);
    lid_ = {VectorXd(m * m), VectorXd(m * m), VectorXd(m * m)};
    x_.resize(m * m, functions * functions);
    y_.resize(m * m, functions * functions);
    laplacian_.resize(m * m, functions * functions);
    for (Eigen::Index b = 0; b < m; ++b)
      for (Eigen::Index a = 0; a < m; ++a) {
        const Eigen::Index q = a + m * b;
        weights_[q] = weight[a] * weight[b];
        const auto along = lid_along(place[a]), across = lid_across(place[b]);
        lid_.x[q] = along[1] * across[0];
        lid_.y[q] = along[0] * across[1];
        lid_.laplacian[q] = along[2] * across[0] + along[0] * across[2];
        for (int j = 0; j < functions; ++j)
          for (int i = 0; i < functions; ++i) {
            const Eigen::Index k = i + functions * j;
            x_(q, k) = f.slope(a, i) * f.value(b, j);
            y_(q, k) = f.value(a, i) * f.slope(b, j);
            laplacian_(q, k) = f.curvature(a, i) * f.value(b, j) + f.value(a, i) * f.curvature(b, j);
          }
      }
  }

  /// One step of Newton's method: what is to be added to the coefficients.
  [[nodiscard]] VectorXd step(const VectorXd& coefficients, double nu) const {
    const Field psi{lid_.x + x_ * coefficients, lid_.y + y_ * coefficients,
                    lid_.laplacian + laplacian_ * coefficients};
    const VectorXd w = weights_.cwiseProduct(psi.laplacian);
    const VectorXd residual = nu * laplacian_.transpose() * w + x_.transpose() * w.cwiseProduct(psi.y) -
                              y_.transpose() * w.cwiseProduct(psi.x);
    MatrixXd times(laplacian_.rows(), laplacian_.cols());
    times = weights_.asDiagonal() * laplacian_;
    MatrixXd matrix = nu * laplacian_.transpose() * times;
    times = weights_.cwiseProduct(psi.y).asDiagonal() * laplacian_ + w.asDiagonal() * y_;
    matrix += x_.transpose() * times;
    times = weights_.cwiseProduct(psi.x).asDiagonal() * laplacian_ + w.asDiagonal() * x_;
    matrix -= y_.transpose() * times;
    return matrix.partialPivLu().solve(-residual);
  }

 private:
  VectorXd weights_;
  Field lid_;
  MatrixXd x_, y_, laplacian_;  // one row a point, one column a function
};

/// The coefficients of few functions among those of more.
VectorXd among(const VectorXd& coefficients, int few, int more) {
  VectorXd all = VectorXd::Zero(more * more);
  for (int j = 0; j < few; ++j) all.segment(more * j, few) = coefficients.segment(few * j, few);
  return all;
}

constexpr int most_smooth_iterations = 30;

VectorXd solution(double nu, int functions, VectorXd guess) {
  const Square square(functions);
  for (int k = 0; k < most_smooth_iterations; ++k) {
    between_steps();
    const VectorXd step = square.step(guess, nu);
    guess += step;
    if (!guess.allFinite()) break;
    if (step.norm() <= 1e-12 * guess.norm()) return guess;
  }
  throw std::runtime_error("Newton's method does not find the regularised cavity: lower the Reynolds number");
}

}  // namespace

SmoothCavity::SmoothCavity(double reynolds, int functions) : functions_(functions) {
  require(std::isfinite(reynolds) && reynolds > 0,
          "regularised cavity: the Reynolds number must be positive");
  require(functions >= 4, "regularised cavity: at least 4 functions along an axis");
  // Few functions find the way; it takes two or three steps more with all of them.
  const int few = std::min(functions, 12);
  VectorXd a = solution(1 / reynolds, few, VectorXd::Zero(few * few));
  if (few < functions) a = solution(1 / reynolds, functions, among(a, few, functions));
  coefficients_.assign(a.data(), a.data() + a.size());
}

std::array<double, 2> SmoothCavity::velocity(double x, double y) const {
  const Functions along = functions_at(VectorXd::Constant(1, x), functions_),
                  across = functions_at(VectorXd::Constant(1, y), functions_);
  const Eigen::Map<const MatrixXd> a(coefficients_.data(), functions_, functions_);
  const auto lid_x = lid_along(x), lid_y = lid_across(y);
  return {lid_x[0] * lid_y[1] + along.value.row(0).dot(a * across.slope.row(0).transpose()),
          -lid_x[1] * lid_y[0] - along.slope.row(0).dot(a * across.value.row(0).transpose())};
}

}  // namespace reference

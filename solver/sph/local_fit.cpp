#include "solver/sph/local_fit.hpp"

#include <Eigen/Cholesky>
#include <limits>

namespace mpm::sph {
namespace {

constexpr int terms = 6;  // 1, x, y, x^2, xy, y^2
using Matrix = Eigen::Matrix<double, terms, terms>;
using Sides = Eigen::Matrix<double, terms, 2>;

/// Solves for the first n terms; false where they are not determined.
bool solve(Eigen::Index n, const Matrix& normal, const Sides& right, Sides& coefficients) {
  using AnySize = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, terms, terms>;
  const Eigen::LDLT<AnySize> factors(normal.topLeftCorner(n, n));  // one type for all n is compiled once
  const auto pivots = factors.vectorD();
  if (!(pivots.minCoeff() > 1e-10 * pivots.maxCoeff())) return false;
  coefficients.topRows(n) = factors.solve(right.topRows(n));
  return true;
}

}  // namespace

LocalFit fit_at(const Vec2& point, const Entries& entries, const EntryRows& rows, double reach,
                bool with_walls, const SmoothingKernel& kernel) {
  Matrix normal = Matrix::Zero();
  Sides right = Sides::Zero(), coefficients = Sides::Zero();
  const double scale = 1 / kernel.radius;
  const auto add = [&](std::uint32_t slot) {
    const Vec2 away = Vec2(entries.position[0][slot], entries.position[1][slot]) - point, d = scale * away;
    const double weight = kernel.weight(away.squaredNorm());
    if (weight == 0) return;
    const Eigen::Matrix<double, terms, 1> base{1, d.x(), d.y(), d.x() * d.x(), d.x() * d.y(), d.y() * d.y()};
    const Vec2 velocity(entries.velocity[0][slot], entries.velocity[1][slot]);
    normal += weight * base * base.transpose();
    right += weight * base * velocity.transpose();
  };
  rows.around(EntryRows::Kind::Inner, point, reach, add);
  if (with_walls) rows.around(EntryRows::Kind::Wall, point, reach, add);
  if (!(normal(0, 0) > 0)) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {Vec2(nan, nan), Mat2::Constant(nan)};
  }
  if (!solve(terms, normal, right, coefficients) && !solve(3, normal, right, coefficients))
    coefficients.row(0) = right.row(0) / normal(0, 0);
  return {coefficients.row(0).transpose(), scale * coefficients.middleRows<2>(1).transpose()};
}

}  // namespace mpm::sph

#include "reference/cavity/spline_axis.hpp"

#include <algorithm>
#include <cmath>

#include "reference/require.hpp"

namespace reference {

SplineAxis::SplineAxis(std::vector<double> breaks, int degree) : breaks_(std::move(breaks)), degree_(degree) {
  require(degree >= 2, "splines of an axis: the degree must be at least 2");
  require(breaks_.size() >= 2 && breaks_.front() == 0 && breaks_.back() == 1 &&
              std::ranges::adjacent_find(breaks_, std::greater_equal<>()) == breaks_.end(),
          "splines of an axis: the spans must ascend from 0 to 1");
  knots_.assign(static_cast<std::size_t>(degree), 0.0);
  knots_.insert(knots_.end(), breaks_.begin(), breaks_.end());
  knots_.insert(knots_.end(), static_cast<std::size_t>(degree), 1.0);
}

double SplineAxis::greville(int i) const {
  double sum = 0;
  for (int k = 1; k <= degree_; ++k) sum += knots_[static_cast<std::size_t>(i + k)];
  return sum / degree_;
}

SplineAxis::Local SplineAxis::at(double x) const {
  const auto above = std::ranges::upper_bound(breaks_, x) - breaks_.begin();
  return at(x, std::clamp(static_cast<int>(above) - 1, 0, spans() - 1));
}

SplineAxis::Local SplineAxis::at(double x, int span) const {
  const int p = degree_;
  const auto knot = [&](int i) { return knots_[static_cast<std::size_t>(i)]; };
  const int k = span + p;  // x lies between knots k and k + 1
  // Cox & de Boor's recurrence; the last three degrees are kept for the derivatives.
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(p + 1, p + 1);  // degree, function k - degree + column
  values(0, 0) = 1;
  for (int d = 1; d <= p; ++d)
    for (int j = 0; j <= d; ++j) {
      const int i = k - d + j;
      if (j > 0) values(d, j) += (x - knot(i)) / (knot(i + d) - knot(i)) * values(d - 1, j - 1);
      if (j < d) values(d, j) += (knot(i + d + 1) - x) / (knot(i + d + 1) - knot(i + 1)) * values(d - 1, j);
    }
  // Derivatives of splines of degree d from coefficients of degree d - 1, once and twice.
  const auto difference = [&](int d, const Eigen::RowVectorXd& lower) {
    Eigen::RowVectorXd upper = Eigen::RowVectorXd::Zero(d + 1);
    for (int j = 0; j <= d; ++j) {
      const int i = k - d + j;
      if (j > 0) upper[j] += d * lower[j - 1] / (knot(i + d) - knot(i));
      if (j < d) upper[j] -= d * lower[j] / (knot(i + d + 1) - knot(i + 1));
    }
    return upper;
  };
  Local local{span, Eigen::Matrix3Xd(3, p + 1)};
  local.of.row(0) = values.row(p);
  local.of.row(1) = difference(p, values.row(p - 1).head(p));
  local.of.row(2) = difference(p, difference(p - 1, values.row(p - 2).head(p - 1)));
  return local;
}

std::vector<double> clustered_breaks(int spans, double g) {
  require(spans >= 1, "clustered spans: at least one");
  std::vector<double> breaks(static_cast<std::size_t>(spans) + 1);
  for (int i = 0; i <= spans; ++i) {
    // From the nearer end, by exponentials: 1 + tanh would cancel.
    const int k = std::min(i, spans - i);
    const double s = double(k) / spans, whole = std::exp(2 * g);
    const double from_end =
        g > 0 ? whole * std::expm1(4 * g * s) / ((whole + std::exp(4 * g * s)) * std::expm1(2 * g)) : s;
    breaks[static_cast<std::size_t>(i)] = i == k ? from_end : 1 - from_end;
  }
  return breaks;
}

}  // namespace reference

#include "verification/convergence/eca_hoekstra.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "verification/convergence/least_squares.hpp"
#include "verification/convergence/root.hpp"
#include "verification/not_a_number.hpp"

namespace verification {

namespace {

constexpr double kOrderLimit = 12.0;  // an order beyond it is no order of a scheme
constexpr double kOrderStep = 0.02;   // of the scan; the sum of squares varies over Delta p of about 1

/// The ladder in scaled form: x = h/h_finest, y = (phi - phi_finest)/(max phi - min phi), weights of sum 1.
struct ScaledLadder {
  Eigen::ArrayXd log_x;
  Eigen::ArrayXd y;
  Eigen::ArrayXd weight;
  double finest_step;
  double finest_value;
  double range;
  bool weighted;
};

ScaledLadder scale_ladder(const std::vector<double>& steps, const std::vector<double>& values,
                          bool weighted) {
  const auto n = static_cast<Eigen::Index>(steps.size());
  const Eigen::Map<const Eigen::ArrayXd> h(steps.data(), n);
  const Eigen::Map<const Eigen::ArrayXd> phi(values.data(), n);
  ScaledLadder ladder;
  ladder.finest_step = steps.back();
  ladder.finest_value = values.back();
  ladder.range = phi.maxCoeff() - phi.minCoeff();
  ladder.weighted = weighted;
  ladder.log_x = (h / ladder.finest_step).log();
  ladder.y = (phi - ladder.finest_value) / ladder.range;
  ladder.weight = weighted ? Eigen::ArrayXd(h.inverse()) : Eigen::ArrayXd::Ones(n);
  ladder.weight /= ladder.weight.sum();
  return ladder;
}

struct LinearFit {
  Eigen::VectorXd coefficients;  // constant first, then one a column of the basis
  Eigen::ArrayXd residual;       // data minus fit
};

/// Weighted linear least squares of y on 1 and the columns of `basis`.
LinearFit fit_linear(const ScaledLadder& ladder, const Eigen::MatrixXd& basis) {
  const Eigen::Index n = ladder.y.size();
  Eigen::MatrixXd design(n, basis.cols() + 1);
  design << Eigen::VectorXd::Ones(n), basis;
  // Columns of one size, so that the rank decision of the QR does not depend on the exponent.
  const Eigen::VectorXd size = design.cwiseAbs().colwise().maxCoeff().transpose();
  const Eigen::VectorXd root_weight = ladder.weight.sqrt().matrix();
  const Eigen::MatrixXd scaled = root_weight.asDiagonal() * design * size.cwiseInverse().asDiagonal();
  const Eigen::VectorXd target = root_weight.cwiseProduct(ladder.y.matrix());
  LinearFit fit;
  fit.coefficients = least_squares(scaled, target).cwiseQuotient(size);
  fit.residual = ladder.y - (design * fit.coefficients).array();
  return fit;
}

double sum_of_squares(const ScaledLadder& ladder, const LinearFit& fit) {
  return (ladder.weight * fit.residual.square()).sum();
}

/// (x^p - 1)/p, which is ln x at p = 0: spans with 1 the same space as x^p and passes smoothly through p = 0.
Eigen::ArrayXd power_basis(const Eigen::ArrayXd& log_x, double p) {
  if (p == 0.0) return log_x;
  return log_x.unaryExpr([p](double l) { return std::expm1(p * l) / p; });
}

/// Derivative of power_basis with respect to p: l^2 (e^t (t - 1) + 1)/t^2, t = p l.
Eigen::ArrayXd power_basis_slope(const Eigen::ArrayXd& log_x, double p) {
  return log_x.unaryExpr([p](double l) {
    const double t = p * l;
    if (std::abs(t) > 0.5) return l * l * (std::exp(t) * (t - 1.0) + 1.0) / (t * t);
    double sum = 0.0;
    double term = 1.0;  // t^k / k!
    for (int k = 0; k < 16; ++k) {
      sum += term / (k + 2);
      term *= t / (k + 1);
    }
    return l * l * sum;
  });
}

double standard_deviation(const ScaledLadder& ladder, const LinearFit& fit, int parameters) {
  // Equal weights 1/n_g and normalised weights w_i both lead to n_g w_i.
  const auto n = static_cast<double>(ladder.y.size());
  return ladder.range * std::sqrt(n * sum_of_squares(ladder, fit) / (n - parameters));
}

GridFit fit_fixed(const ScaledLadder& ladder, ErrorModel model, const std::vector<double>& exponents) {
  Eigen::MatrixXd basis(ladder.y.size(), static_cast<Eigen::Index>(exponents.size()));
  for (std::size_t k = 0; k < exponents.size(); ++k) {
    basis.col(static_cast<Eigen::Index>(k)) = (exponents[k] * ladder.log_x).exp().matrix();
  }
  const LinearFit linear = fit_linear(ladder, basis);
  GridFit fit;
  fit.model = model;
  fit.weighted = ladder.weighted;
  fit.limit = ladder.finest_value + ladder.range * linear.coefficients[0];
  fit.exponents = exponents;
  for (std::size_t k = 0; k < exponents.size(); ++k) {
    fit.amplitudes.push_back(ladder.range * linear.coefficients[static_cast<Eigen::Index>(k) + 1]);
  }
  fit.finest_step = ladder.finest_step;
  fit.sigma = standard_deviation(ladder, linear, static_cast<int>(exponents.size()) + 1);
  return fit;
}

/// Sum of squares that the best straight line a + b basis leaves; the weights sum to one. What fit_linear
/// finds, without its matrices: the scan below asks for it a thousand times.
double squares_about_line(const ScaledLadder& ladder, const Eigen::ArrayXd& basis) {
  const Eigen::ArrayXd& w = ladder.weight;
  const Eigen::ArrayXd x = basis - (w * basis).sum(), y = ladder.y - (w * ladder.y).sum();
  return (w * (y - (w * x * y).sum() / (w * x.square()).sum() * x).square()).sum();
}

/// p of the smallest sum of squares in [-kOrderLimit, kOrderLimit].
double best_order(const ScaledLadder& ladder) {
  const int count = static_cast<int>(std::lround(kOrderLimit / kOrderStep));
  double best = 0.0;
  double smallest = std::numeric_limits<double>::infinity();
  for (int k = -count; k <= count; ++k) {
    const double p = k * kOrderStep;
    const double s = squares_about_line(ladder, power_basis(ladder.log_x, p));
    if (s < smallest) {
      smallest = s;
      best = p;
    }
  }
  // With the linear coefficients eliminated dS/dp is -2 b sum w r d(basis)/dp.
  const auto slope = [&](double p) {
    const LinearFit fit = fit_linear(ladder, power_basis(ladder.log_x, p).matrix());
    return -fit.coefficients[1] * (ladder.weight * fit.residual * power_basis_slope(ladder.log_x, p)).sum();
  };
  const double lower = std::max(best - kOrderStep, -kOrderLimit);
  const double upper = std::min(best + kOrderStep, kOrderLimit);
  const double root = find_root_between(slope, lower, upper);
  return std::isnan(root) ? best : root;
}

GridFit fit_power_law(const ScaledLadder& ladder) {
  const double p = best_order(ladder);
  GridFit fit = fit_fixed(ladder, ErrorModel::PowerLaw, {p});
  const LinearFit linear = fit_linear(ladder, power_basis(ladder.log_x, p).matrix());
  fit.sigma = standard_deviation(ladder, linear, 3);
  return fit;
}

GridFit smaller_sigma(const std::vector<GridFit>& fits) {
  return *std::min_element(fits.begin(), fits.end(),
                           [](const GridFit& a, const GridFit& b) { return a.sigma < b.sigma; });
}

}  // namespace

double GridFit::at(double h) const {
  double value = limit;
  for (std::size_t k = 0; k < exponents.size(); ++k) {
    value += amplitudes[k] * std::pow(h / finest_step, exponents[k]);
  }
  return value;
}

GridFit fit_power_law(const std::vector<double>& steps, const std::vector<double>& values, bool weighted) {
  check_ladder(steps, 4, "fit_power_law");
  if (values.size() != steps.size()) throw std::invalid_argument("fit_power_law: one value a step is needed");
  return fit_power_law(scale_ladder(steps, values, weighted));
}

EcaHoekstraResult eca_hoekstra(const std::vector<double>& steps, const std::vector<double>& values,
                               double formal_order, std::optional<std::size_t> level) {
  check_ladder(steps, 4, "eca_hoekstra");
  if (values.size() != steps.size()) throw std::invalid_argument("eca_hoekstra: one value a step is needed");
  if (!(formal_order >= 1.0) || !std::isfinite(formal_order)) {
    throw std::invalid_argument("eca_hoekstra: the formal order must be finite and at least 1");
  }
  const std::size_t i = level.value_or(steps.size() - 1);
  if (i >= steps.size()) throw std::invalid_argument("eca_hoekstra: there is no such level");

  if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) {
    return {Convergence::Invalid, nan, {}, nan, nan, nan, nan, nan};
  }
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  if (*least == *greatest) {
    GridFit constant;
    constant.limit = values.back();
    constant.finest_step = steps.back();
    return {Convergence::Floor, nan, constant, 0.0, 3.0, 0.0, 0.0, 0.0};
  }

  const ScaledLadder equal = scale_ladder(steps, values, false);
  const ScaledLadder weighted = scale_ladder(steps, values, true);
  std::vector<GridFit> candidates;
  for (const ScaledLadder* ladder : {&equal, &weighted}) {
    GridFit fit = fit_power_law(*ladder);
    if (fit.exponents[0] > 0.0) candidates.push_back(std::move(fit));
  }

  EcaHoekstraResult result;
  result.convergence = candidates.empty() ? Convergence::Divergent : Convergence::Monotone;
  if (!candidates.empty()) result.fit = smaller_sigma(candidates);
  const double p = candidates.empty() ? nan : result.fit.exponents[0];
  result.observed_order = p;
  if (!(p >= 0.5 && p <= formal_order)) {
    candidates.clear();
    for (const ScaledLadder* ladder : {&equal, &weighted}) {
      candidates.push_back(fit_fixed(*ladder, ErrorModel::FirstOrder, {1.0}));
      if (formal_order > 1.0) {
        candidates.push_back(fit_fixed(*ladder, ErrorModel::FormalOrder, {formal_order}));
      }
      if (!(p > formal_order)) {
        candidates.push_back(fit_fixed(*ladder, ErrorModel::FirstAndFormalOrder,
                                       {1.0, formal_order > 1.0 ? formal_order : 2.0}));
      }
    }
    result.fit = smaller_sigma(candidates);
  }

  const double sigma = result.fit.sigma;
  const double fitted = result.fit.at(steps[i]);
  result.data_range = (*greatest - *least) / static_cast<double>(steps.size() - 1);
  result.error_estimate = std::abs(fitted - result.fit.limit);
  result.fit_residual = std::abs(values[i] - fitted);
  const bool good_fit = sigma < result.data_range;
  result.safety_factor = good_fit && p >= 0.5 && p < 1.05 * formal_order ? 1.25 : 3.0;
  result.uncertainty =
      good_fit ? result.safety_factor * result.error_estimate + sigma + result.fit_residual
               : 3.0 * sigma / result.data_range * (result.error_estimate + sigma + result.fit_residual);
  return result;
}

}  // namespace verification

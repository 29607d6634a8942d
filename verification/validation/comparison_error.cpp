#include "verification/validation/comparison_error.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace verification {

std::string name(ValidationVerdict verdict) {
  switch (verdict) {
    case ValidationVerdict::ModelError:
      return "model error";
    case ValidationVerdict::Agrees:
      return "agrees within u_val";
    default:
      return "inconclusive";
  }
}

double ComparedValue::validation_uncertainty() const {
  return std::hypot(u_num, u_input, u_data);
}

ValidationVerdict judge(const ComparedValue& value, double k, double largest) {
  if (!(k > 0) || !(largest > 0))
    throw std::invalid_argument("a verdict needs a positive coverage factor and a positive largest error");
  if (value.u_num < 0 || value.u_input < 0 || value.u_data < 0)
    throw std::invalid_argument("a standard uncertainty cannot be negative");
  const double error = std::abs(value.error()), noise = k * value.validation_uncertainty();
  if (!std::isfinite(error) || !std::isfinite(noise)) return ValidationVerdict::Inconclusive;
  if (error > noise) return ValidationVerdict::ModelError;
  return noise <= largest ? ValidationVerdict::Agrees : ValidationVerdict::Inconclusive;
}

bool bears(const ComparedValue& value, double k, double largest) {
  return judge(value, k, largest) != ValidationVerdict::Inconclusive && std::abs(value.error()) <= largest;
}

JointComparison compare_jointly(const std::vector<double>& errors, const std::vector<double>& own,
                                const std::vector<std::vector<double>>& shared) {
  if (errors.empty() || own.size() != errors.size())
    throw std::invalid_argument("a joint comparison needs values, and one uncertainty for each");
  const auto n = static_cast<Eigen::Index>(errors.size());
  const Eigen::VectorXd e = Eigen::Map<const Eigen::VectorXd>(errors.data(), n);
  const Eigen::VectorXd u = Eigen::Map<const Eigen::VectorXd>(own.data(), n);
  Eigen::MatrixXd covariance = u.cwiseAbs2().asDiagonal();
  for (const std::vector<double>& cause : shared) {
    if (cause.size() != errors.size())
      throw std::invalid_argument("a shared cause needs its effect on every value");
    const Eigen::VectorXd s = Eigen::Map<const Eigen::VectorXd>(cause.data(), n);
    covariance += s * s.transpose();
  }
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (!covariance.allFinite() || !e.allFinite()) return {nan, nan};
  const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
  if (factor.info() != Eigen::Success) return {nan, nan};
  const double distance = e.dot(factor.solve(e));
  return {distance, gsl_cdf_chisq_Q(distance, static_cast<double>(n))};
}

}  // namespace verification

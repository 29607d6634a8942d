#include "verification/convergence/floor_fit.hpp"

#include <cmath>

#include "verification/convergence/least_squares.hpp"

namespace verification {

std::optional<FloorFit> fit_floor(const std::vector<double>& steps, const std::vector<double>& errors,
                                  double order) {
  if (steps.size() < 3 || steps.size() != errors.size()) return std::nullopt;
  const auto levels = static_cast<Eigen::Index>(steps.size());
  Eigen::MatrixXd shape(levels, 2);
  for (Eigen::Index k = 0; k < levels; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (!(errors[i] > 0) || !std::isfinite(errors[i])) return std::nullopt;
    // In units of the finest step and of each error: no column dwarfs the other.
    shape(k, 0) = std::pow(steps[i] / steps.back(), order) / errors[i];
    shape(k, 1) = 1 / errors[i];
  }
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(levels);
  const Eigen::Vector2d solution = least_squares(shape, ones);
  const double misfit = (shape * solution - ones).cwiseAbs().maxCoeff();
  return FloorFit{solution[0] / std::pow(steps.back(), order), solution[1], misfit};
}

}  // namespace verification

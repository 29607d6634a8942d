#pragma once

#include <optional>
#include <vector>

namespace verification {

/// error = coefficient h^order + floor, the order given.
struct FloorFit {
  double coefficient, floor;
  double misfit;  ///< largest |fit/error - 1|
};

/// Least squares of the relative residuals, so that every level weighs alike. `steps` [any unit] and
/// `errors`: one a level, positive. None with fewer than three levels: two unknowns fit two levels whatever
/// they are.
std::optional<FloorFit> fit_floor(const std::vector<double>& steps, const std::vector<double>& errors,
                                  double order);

}  // namespace verification

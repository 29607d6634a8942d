#pragma once

#include <string>
#include <vector>

#include "verification/convergence/order.hpp"
#include "verification/runs/run_data.hpp"

namespace verification {

/// Exponent k of dt ~ h^k at which the time error of a scheme falls at least as fast as its mesh error.
double formal_dt_exponent(const mpm::FormalOrder& formal);

/// Theory's orders of whatever simulates a scene. Throws ConfigError for a method that has no place in a
/// matrix.
mpm::FormalOrder formal_order(const SceneConfig& scene);

/// Order on a ladder, from its formal orders p (space), q (time) and its remap loss ~ h^r/dt: in
/// space with dt ~ h^k the smallest of p, q k and r - k; in time q, or NaN where the loss hides it (the error
/// then grows as dt shrinks, and no order in dt exists).
double expected_order(const mpm::FormalOrder& formal, Axis axis, double dt_exponent, Location location);

/// Slope of ln(error against the exact solution) on ln dt, and the smallest such error: what a lossy scheme
/// shows in place of an order.
struct ExactErrorSlope {
  OrderEstimate estimate;
  double smallest_error;
};
ExactErrorSlope exact_error_slope(const StudyData& data, const reports::OrderRecord& order);

/// Rows of the order matrix that a study with a [matrix] fills; verdicts are those of its "formal-order"
/// checks.
std::vector<reports::MatrixRecord> matrix_records(const StudyData& data);

}  // namespace verification

#pragma once

#include <string>
#include <vector>

#include "verification/convergence/order.hpp"
#include "verification/study/run_data.hpp"

namespace verification {

/// Combinations of scheme parts, each a variant of a study: [matrix] basis, transfer, stepping, each a list
/// of names.
struct MatrixEntry {
  std::string variant;                    ///< "cubic_full-mass_leapfrog"
  std::string basis, transfer, stepping;  ///< names
  double flip_fraction = 0;               ///< flip-blend only

  /// The entry as a TOML table [scheme].
  [[nodiscard]] std::string toml() const;
};

/// Names of parts listed under a key, all of them where it is absent; one that is not known is refused
/// (ConfigError).
std::vector<std::string> part_names(TomlTable& table, const std::string& key,
                                    const std::vector<mpm::SchemePart>& parts);

/// Reads [matrix]. Throws ConfigError.
std::vector<MatrixEntry> read_matrix(TomlTable table);

/// Exponent k of dt ~ h^k at which the time error of a scheme falls at least as fast as its mesh error.
double formal_dt_exponent(const mpm::Scheme& scheme);

/// Order of a scheme on a ladder, from its formal orders p (space), q (time) and its remap loss ~ h^r/dt: in
/// space with dt ~ h^k the smallest of p, q k and r - k; in time q, or NaN where the loss hides it (the error
/// then grows as dt shrinks, and no order in dt exists).
double expected_order(const mpm::Scheme& scheme, Axis axis, double dt_exponent, Location location);

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

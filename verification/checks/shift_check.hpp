#pragma once

#include <vector>

#include "verification/checks/check_reader.hpp"
#include "verification/validation/measurements.hpp"

namespace verification {

/// How far a record lies beside measurements whose clock started at an unknown time.
struct BestShift {
  double shift = 0;      ///< measured minus simulated time, that brings them together [s]
  double deviation = 0;  ///< root mean square of simulated minus measured after it, in the quantity's unit
};

/// The shift that minimises the sum of squares of S(t_i - shift) - D_i over the rows of a quantity, each row
/// with the weight of its uncertainty, among those that keep all times within the record. Times and values
/// are in SI units. Throws std::invalid_argument when no shift does.
BestShift best_shift(const RunFiles& run, const std::vector<Measurement>& rows);

/// Adds kind "shift": the best shift of a quantity of [validation] lies in a band, and what remains after it
/// below largest_deviation. Both in the table's scales.
void add_shift_kind(std::vector<CheckKind>& kinds);

}  // namespace verification

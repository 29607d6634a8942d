#pragma once

#include <vector>

#include "verification/runs/run_data.hpp"

namespace verification {

/// Shear rates (or viscosity ratios) of the cells at a time, from the resting plate up.
inline std::vector<double> cells_at(const RunData& run, double t, double reports::ShearRow::*value) {
  std::vector<double> values;
  for (const reports::ShearRow& row : run.shear)
    if (row.t == t && row.location == "cells") values.push_back(row.*value);
  return values;
}

}  // namespace verification

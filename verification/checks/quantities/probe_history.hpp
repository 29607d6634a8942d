#pragma once

#include <limits>
#include <vector>

#include "verification/runs/run_data.hpp"

namespace verification {

/// Velocity of the probe [m/s] at a time [s], linear between two rows of its history; NaN outside of them.
inline double interpolated(const std::vector<reports::HistoryRow>& history, double t) {
  for (std::size_t k = 1; k < history.size(); ++k)
    if (history[k].t >= t && history[k - 1].t <= t) {
      const double f = (t - history[k - 1].t) / (history[k].t - history[k - 1].t);
      return (1 - f) * history[k - 1].probe + f * history[k].probe;
    }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace verification

#pragma once

#include <string>

namespace reports {

/// What bounds a step that was chosen, where nothing is: a word that no step goes by.
inline constexpr const char* no_step = "none";

/// time-steps.csv: the step of a run whose scene says dt = "auto", and the numbers that it follows from.
/// Errors are relative L2 norms on the grid, the largest of all output times; NaN where there is none.
struct TimeStepRecord {
  std::string run, study, variant;
  double h = 0;   ///< [m]
  double dt = 0;  ///< chosen [s]
  /// "error", "stability" (limits of the scheme), "outputs" (the interval between them), "pilot" (a longer
  /// one diverged or has no order); "none": no step could be chosen, the study fails
  std::string bound;
  double fraction = 0;             ///< of the error in space that the error in time may be
  double stable = 0;               ///< longest step that the limits allow [s]
  double time_coefficient = 0;     ///< C_t [s^-q] of the error in time C_t dt^q
  double time_order = 0;           ///< q that is used, and
  double observed_time_order = 0;  ///< seen
  double space_coefficient = 0;    ///< C_h [m^-p] of the error in space C_h h^p
  double space_order = 0;          ///< p
  double time_error = 0;           ///< expected at this step
  double space_error = 0;          ///< expected on this mesh
  std::string remark;
};

/// pilots.csv: a run that was made to choose a step by.
struct PilotRecord {
  std::string run, study, variant;
  long cells = 0, particles = 0;
  double dt = 0;  ///< [s]
  long steps = 0;
  std::string status;  ///< "completed", or as in runs.csv
  double error = 0;    ///< against the solution, as in time-steps.csv
};

}  // namespace reports

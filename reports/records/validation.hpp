#pragma once

#include <string>

namespace reports {

/// validation.csv: one measured value beside the simulated one, or (measured NaN) a prediction.
struct ValidationRecord {
  std::string study, variant;
  std::string quantity, unit;
  double t = 0, x = 0, y = 0;             ///< as the table gives them; NaN where they do not apply
  double measured = 0, u_data = 0;        ///< D and its standard uncertainty, shared part included
  double simulated = 0;                   ///< S
  double error = 0;                       ///< E = S - D
  double u_num = 0, u_input = 0;          ///< standard uncertainties of S
  double u_val = 0;                       ///< of E
  double coverage = 0;                    ///< k
  double largest = 0;                     ///< model error that the study bears (of a prediction: k u_val)
  double area_above = 0, area_below = 0;  ///< sides of the area metric, both distributions normal
  std::string verdict;  ///< "model error", "agrees within u_val", "inconclusive", "prediction"
  bool borne = false;   ///< the gate: not inconclusive, and within `largest`
  std::string reason;   ///< of `largest`
  std::string note;     ///< of the measurement, or why there is no value
  std::string source;   ///< of the data
};

/// validation-joint.csv: the values of one table and quantity judged together.
struct JointValidationRecord {
  std::string study, variant, quantity, unit;
  long points = 0;
  double distance_squared = 0, p_value = 0;  ///< d^2 = E^T V^-1 E; chance of more if the model is right
  double bias = 0, scatter = 0;              ///< delta and sigma_M of positive values, else NaN
  double data_scatter = 0;                   ///< sigma_E used for them
  std::string source, obtained, licence;
};

/// validation-bias.csv: one quantity over all studies that measured it.
struct ValidationBiasRecord {
  std::string quantity;
  long studies = 0, pairs = 0;
  double bias = 0, scatter = 0, data_scatter = 0;
};

/// Verdicts of a ValidationRecord that the reports tell apart.
inline constexpr const char* prediction_verdict = "prediction";
inline constexpr const char* inconclusive_verdict = "inconclusive";

}  // namespace reports

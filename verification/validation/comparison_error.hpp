#pragma once

#include <string>
#include <vector>

namespace verification {

/// What a comparison of one simulated value with one measured value says (ASME V&V 20-2009).
enum class ValidationVerdict {
  ModelError,   ///< |E| > k u_val: the model is wrong by about E
  Agrees,       ///< |E| <= k u_val, and k u_val is within what the user needs to know
  Inconclusive  ///< k u_val exceeds that need (or is not a number): noise, which proves nothing
};
/// "model error", "agrees within u_val", "inconclusive".
std::string name(ValidationVerdict verdict);

/// A simulated value S beside a measured one D, each with its standard uncertainties, all in one unit.
struct ComparedValue {
  double simulated = 0, measured = 0;
  double u_num = 0;    ///< of S, from its refinement ladder
  double u_input = 0;  ///< of S, from the inputs of the simulation
  double u_data = 0;   ///< of D, digitisation included

  /// E = S - D.
  [[nodiscard]] double error() const { return simulated - measured; }
  /// u_val, u_val^2 = u_num^2 + u_input^2 + u_data^2: the standard uncertainty of E as an estimate of the
  /// model's error, the three being independent.
  [[nodiscard]] double validation_uncertainty() const;
};

/// Verdict at coverage factor k > 0 (2: about 95 %), for somebody who bears a model error of up to `largest`
/// (> 0, in the unit of the values). A NaN anywhere is inconclusive. An E that stands out of the noise is a
/// model error even where the noise exceeds `largest`.
/// Throws std::invalid_argument for a k or a largest that is not positive, or a negative uncertainty.
ValidationVerdict judge(const ComparedValue& value, double k, double largest);

/// Whether a gate may be green: not inconclusive, and |E| <= largest.
bool bears(const ComparedValue& value, double k, double largest);

/// Several values judged together.
struct JointComparison {
  double distance_squared = 0;  ///< d^2 = E^T V^-1 E; NaN where V is not positive definite
  double p_value = 0;           ///< chance of a d^2 at least this large if the model is right
};

/// d^2 of n comparison errors against chi^2 with n degrees of freedom (ASME V&V 20.1): errors shared by the
/// values, as of an input or of a calibration, do not count n times.
///
/// `shared`: each a vector of n, the effect of one standard deviation of one shared cause on every E (an
/// input's sensitivity times its uncertainty; the shared part of the data). V = diag(own^2) + sum s s^T, with
/// `own` the standard uncertainty of each E that it shares with no other.
/// Throws std::invalid_argument for no value at all or sizes that differ.
JointComparison compare_jointly(const std::vector<double>& errors, const std::vector<double>& own,
                                const std::vector<std::vector<double>>& shared);

}  // namespace verification

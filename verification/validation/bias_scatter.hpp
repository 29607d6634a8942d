#pragma once

#include <vector>

namespace verification {

/// One quantity of one case: computed and measured, both positive.
struct CasePair {
  double computed = 0, measured = 0;
};

/// Bias and scatter of a model over many cases of one quantity, after the fire models' guides (NIST FDS
/// Validation Guide, chapter on model uncertainty; McGrattan & Toman 2011).
struct BiasScatter {
  double bias = 0;              ///< delta: computed over true value, in the mean; 1 is none
  double scatter = 0;           ///< sigma_M, relative standard deviation of the model about its bias
  double data_uncertainty = 0;  ///< sigma_E that was used: see below
};

/// With r = ln(computed/measured): sigma_M^2 + sigma_E^2 is the variance of r (n - 1 in the denominator) and
/// delta = exp(mean r + (sigma_M^2 - sigma_E^2)/2). `relative_data_uncertainty` is sigma_E; as in the guides
/// it counts at most as half of the variance, so that a scatter of nothing is never claimed. NaN throughout
/// for fewer than two pairs or values that are not positive and finite. Throws std::invalid_argument for a
/// negative uncertainty.
BiasScatter bias_and_scatter(const std::vector<CasePair>& pairs, double relative_data_uncertainty);

/// Chance that the true value exceeds `critical`, given a computed value and the model's bias and scatter;
/// all three counted from the same base, e.g. the ambient temperature: the true value is normal with mean
/// computed/delta and deviation sigma_M computed/delta.
double exceedance_probability(double computed, double critical, const BiasScatter& model);

}  // namespace verification

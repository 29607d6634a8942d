#pragma once

#include <limits>
#include <string>
#include <vector>

#include "verification/validation/compare_table.hpp"
#include "verification/validation/latin_hypercube.hpp"

namespace verification {

/// An input of the simulation that is not known exactly.
struct UncertainInput {
  std::string key;  ///< dotted path of a number in the scene, e.g. "fluid.kinematic_viscosity"
  InputDistribution::Shape shape = InputDistribution::Shape::Normal;
  double uncertainty = 0;  ///< one standard deviation, of the value where `relative`
  bool relative = false;
  std::string source;  ///< where value and uncertainty come from
};

/// [validation] of a study: what its runs are compared with, and how good they must be.
struct ValidationSpec {
  std::vector<MeasurementTable> tables;  ///< predictions are a table without a file and without values
  std::vector<std::string> variants;     ///< that are compared, each by itself; empty: every one

  [[nodiscard]] bool compares(const std::string& variant) const;
  ComparisonRules rules;
  std::vector<UncertainInput> inputs;
  int samples = 0;  ///< of a Latin hypercube; 0: sensitivities, two runs an input
};

/// Variants of the runs that vary the inputs of `variant`, in the order in which they are planned: input by
/// input minus, plus; or sample by sample.
std::vector<std::string> input_variants(const ValidationSpec& spec, const std::string& variant);

}  // namespace verification

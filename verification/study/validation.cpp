#include "verification/study/validation.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace verification {

bool ValidationSpec::compares(const std::string& variant) const {
  return variants.empty() || std::ranges::count(variants, variant) > 0;
}

std::vector<std::string> input_variants(const ValidationSpec& spec, const std::string& variant) {
  const std::string stem = variant.empty() ? "" : variant + ".";
  std::vector<std::string> names;
  if (spec.inputs.empty()) return names;
  for (int s = 1; s <= spec.samples; ++s) names.push_back(fmt::format("{}sample{:03}", stem, s));
  if (spec.samples > 0) return names;
  for (std::size_t i = 1; i <= spec.inputs.size(); ++i)
    for (const char* side : {"minus", "plus"}) names.push_back(fmt::format("{}input{}-{}", stem, i, side));
  return names;
}

}  // namespace verification

#include "verification/checks/expected_checks.hpp"

#include <algorithm>
#include <stdexcept>

#include "verification/checks/check_keys.hpp"
#include "verification/checks/stability_checks.hpp"

namespace verification {
namespace {

std::size_t runs_at_level(const CheckSpec& spec, const Study& study) {
  std::size_t runs = 0;
  for (const std::string& variant : spec.variants) {
    const auto levels = study.runs_of(variant);
    if (spec.level == "finest" || spec.level == "coarsest")
      runs += levels.empty() ? 0 : 1;
    else
      runs += static_cast<std::size_t>(std::ranges::count_if(
          levels, [&](const PlannedRun* run) { return spec.level == "all" || is_level(*run, spec.level); }));
  }
  return runs;
}

}  // namespace

std::optional<std::size_t> expected_checks(const CheckSpec& spec, const Study& study) {
  const std::size_t variants = spec.variants.size(), locations = spec.locations.size(),
                    times = spec.times.size();
  const std::string& kind = spec.kind;
  if (is_stability_kind(kind)) return std::nullopt;
  if (kind == "error" || kind == "difference") return runs_at_level(spec, study) * locations * times;
  if (kind == "order" || kind == "growth") return variants * locations * times;
  if (kind == "formal-order") return variants * locations;
  if (kind == "particle-bias") return runs_at_level(spec, study) * times;
  if (kind == "conservation" || kind == "scalar" || kind == "chatter") return runs_at_level(spec, study);
  if (kind == "shift") return 2 * runs_at_level(spec, study);
  if (kind == "ordering") return 1;
  if (kind == "ratio" || kind == "crossing") return variants;
  if (kind == "divergence") return study.runs.size();
  if (kind == "outcome") return study.runs.size();
  throw std::logic_error("checks of kind '" + kind + "' are not counted");
}

bool declares_fate(const Study& study) {
  return std::ranges::any_of(study.checks, [](const CheckSpec& spec) {
    return spec.kind == "divergence" || spec.kind == "outcome";
  });
}

std::size_t expected_gates(const Study& study) {
  if (!study.validation) return 0;
  const auto compared = std::ranges::count_if(
      study.variants, [&](const std::string& variant) { return study.validation->compares(variant); });
  std::size_t rows = 0;
  for (const MeasurementTable& table : study.validation->tables) rows += table.rows.size();
  return rows * static_cast<std::size_t>(compared);
}

std::optional<std::size_t> expected_checks(const Study& study) {
  std::size_t total = study.runs.empty() || declares_fate(study) ? 0 : 1;
  total += expected_gates(study);
  for (const CheckSpec& spec : study.checks) {
    const auto expected = expected_checks(spec, study);
    if (!expected) return std::nullopt;
    total += *expected;
  }
  return total;
}

}  // namespace verification

#include "verification/checks/check_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "verification/runs/measures.hpp"

namespace verification {

std::string label(const std::string& variant) {
  return variant.empty() ? "" : variant + ": ";
}

void require_upper(TomlTable& table, CheckSpec& spec, double lower) {
  if (!table.has("upper")) table.fail_missing("upper", "give the tolerance");
  if (!std::isfinite(spec.lower)) spec.lower = lower;
}

void require_band(TomlTable& table) {
  for (const char* key : {"lower", "upper"})
    if (!table.has(key)) table.fail_missing(key, "give a two-sided band");
}

void read_locations(TomlTable& table, const Study& study, CheckSpec& spec) {
  std::vector<std::string> delivered{"grid", "particles"};
  if (study.solver) {
    delivered.clear();
    for (const Location location : study.solver->locations) delivered.push_back(name(location));
  }
  const std::vector<std::string> words = table.has("locations") ? table.texts("locations") : delivered;
  spec.locations_by_default = !table.has("locations");
  if (words.empty()) table.fail("locations", "is empty: a check of nothing proves nothing");
  for (const std::string& word : words) {
    if (word != "grid" && word != "particles") table.fail("locations", "may hold \"grid\" and \"particles\"");
    if (std::ranges::count(delivered, word) == 0)
      table.fail("locations", "\"" + word + "\" is not what the study's solver delivers (solver.locations)");
    spec.locations.push_back(word == "grid" ? Location::Grid : Location::Particles);
  }
}

void read_norm(TomlTable& table, CheckSpec& spec) {
  spec.norm = table.text("norm", "l2");
  if (spec.norm != "l1" && spec.norm != "l2" && spec.norm != "linf")
    table.fail("norm", "must be \"l1\", \"l2\" or \"linf\"");
}

void read_times(TomlTable& table, const Study& study, CheckSpec& spec) {
  const std::vector<double>& outputs = study.runs.front().scene.outputs;
  spec.times = table.has("times") ? table.numbers("times") : outputs;
  for (const PlannedRun& run : study.runs) {
    if (std::ranges::count(spec.variants, run.variant) == 0) continue;
    for (const double t : spec.times)
      if (std::ranges::count(run.scene.outputs, t) == 0)
        table.fail("times", fmt::format("{} s is no output time of run {}", t, run.run));
  }
}

void read_scale(TomlTable& table, CheckSpec& spec) {
  if (!table.has("relative_to")) return;
  if (table.is_text("relative_to")) {
    spec.relative_to = table.text("relative_to");
    if (spec.relative_to != "steady" && spec.relative_to != "present")
      table.fail("relative_to", "must be \"steady\", \"present\" or a velocity in m/s");
    return;
  }
  spec.relative_to = "value";
  spec.scale = table.positive("relative_to");
}

double relative_error(const CheckSpec& spec, const RunData& run, const reports::ErrorRecord& error) {
  const double norm = pick(error, spec.norm);
  if (spec.relative_to == "steady") return norm * error.scale / run.plan->scene.flow->velocity_scale();
  if (spec.relative_to == "present") return norm * error.scale / error.exact_max;
  if (spec.relative_to == "value") return norm * error.scale / spec.scale;
  return norm;
}

CheckSpec with_scale(CheckSpec spec, const reports::ErrorRecord& error) {
  const double times = error.scale / error.exact_max;
  if (spec.relative_to == "present")
    spec.reason += " (relative to the fastest exact velocity at its time)";
  else if (spec.relative_to == "value")
    spec.reason += fmt::format(" (relative to {:.3g} m/s)", spec.scale);
  else if (spec.relative_to.empty() && times > large_scale)
    spec.reason +=
        fmt::format(" (warning: relative to {:.3g} m/s, {:.2g} times the fastest exact velocity at its time)",
                    error.scale, times);
  return spec;
}

bool is_level(const PlannedRun& run, const std::string& tag) {
  return run.run.ends_with("." + tag);
}

namespace {

bool is_extreme(const std::string& level) {
  return level == "finest" || level == "coarsest";
}

}  // namespace

void read_level(TomlTable& table, const Study& study, CheckSpec& spec) {
  spec.level = table.text("level", "finest");
  if (is_extreme(spec.level) || spec.level == "all") return;
  for (const std::string& variant : spec.variants)
    if (std::ranges::none_of(study.runs_of(variant),
                             [&](const PlannedRun* run) { return is_level(*run, spec.level); }))
      table.fail(
          "level",
          "must be \"finest\", \"coarsest\", \"all\" or a level as run names end with it, e.g. \"n20\"");
}

void read_against(TomlTable& table, const Study& study, CheckSpec& spec) {
  spec.against = table.text("against");
  if (std::ranges::count(study.variants, spec.against) == 0)
    table.fail("against", "'" + spec.against + "' is no variant of this study");
  std::erase(spec.variants, spec.against);
  if (spec.variants.empty()) table.fail("against", "leaves no variant to compare");
}

std::vector<const RunData*> levels_of(const CheckSpec& spec, const StudyData& data,
                                      const std::string& variant) {
  auto runs = data.runs_of(variant);
  if (spec.level == "finest") return {runs.back()};
  if (spec.level == "coarsest") return {runs.front()};
  if (spec.level != "all")
    std::erase_if(runs, [&](const RunData* run) { return !is_level(*run->plan, spec.level); });
  return runs;
}

std::string label(const CheckSpec& spec, const RunData& run) {
  if (is_extreme(spec.level) || run.record.run.size() <= run.record.study.size())
    return label(run.plan->variant);
  return run.record.run.substr(run.record.study.size() + 1) + ": ";
}

}  // namespace verification

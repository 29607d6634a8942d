#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "verification/checks/check_keys.hpp"
#include "verification/checks/check_reader.hpp"
#include "verification/checks/quantities/quantities.hpp"

namespace verification {
namespace {

using Records = std::vector<reports::CheckRecord>;

void read_quantity(TomlTable& table, const Study& study, CheckSpec& spec) {
  spec.quantity = table.text("quantity");
  const auto& known = quantity_names();
  if (std::ranges::count(known, spec.quantity) == 0) {
    std::string list;
    for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
    table.fail("quantity", "'" + spec.quantity + "' is not known; choose one of: " + list);
  }
  if (needs_time(spec.quantity)) {
    spec.times = {table.positive("t")};
    for (const PlannedRun& run : study.runs)
      if (std::ranges::count(spec.variants, run.variant) > 0 &&
          std::ranges::count(run.scene.outputs, spec.times[0]) == 0)
        table.fail("t", "is no output time of run " + run.run);
  }
  if (needs_place(spec.quantity)) {
    spec.place = table.number("place");
    if (spec.place < 0 || spec.place > 1)
      table.fail("place", "must lie between 0 and 1 (fraction of the gap)");
  }
  read_level(table, study, spec);
}

double observe(const CheckSpec& spec, const RunData& run) {
  return evaluate({spec.quantity, spec.times.empty() ? 0 : spec.times[0], spec.place}, run);
}

std::string described(const CheckSpec& spec) {
  std::string text = spec.quantity;
  if (needs_place(spec.quantity)) text += fmt::format(" at {} H", spec.place);
  if (!spec.times.empty()) text += fmt::format(", t = {} s", spec.times[0]);
  return text;
}

const RunData& only_run(const CheckSpec& spec, const StudyData& data, const std::string& variant) {
  return *levels_of(spec, data, variant).back();
}

// ---- scalar: a quantity of each variant in a band

void read_scalar(TomlTable& table, const Study& study, CheckSpec& spec) {
  if (!table.has("lower") && !table.has("upper")) table.fail_missing("upper", "give a bound");
  read_quantity(table, study, spec);
}

void evaluate_scalar(const CheckSpec& spec, const StudyData& data, Records& records) {
  for (const std::string& variant : spec.variants)
    for (const RunData* run : levels_of(spec, data, variant))
      records.push_back(judge(spec, data, label(spec, *run) + described(spec), observe(spec, *run),
                              unit_of(spec.quantity)));
}

// ---- ordering: the variants in the order given have a growing quantity

void read_ordering(TomlTable& table, const Study& study, CheckSpec& spec) {
  if (!table.has("lower"))
    table.fail_missing("lower", "give the smallest relative step from one variant to the next");
  if (spec.variants.size() < 2) table.fail("variants", "needs at least two, in growing order");
  read_quantity(table, study, spec);
}

void evaluate_ordering(const CheckSpec& spec, const StudyData& data, Records& records) {
  double smallest = std::numeric_limits<double>::infinity();
  std::string names;
  for (std::size_t k = 0; k < spec.variants.size(); ++k) {
    names += (k ? " < " : "") + spec.variants[k];
    if (k == 0) continue;
    const double a = observe(spec, only_run(spec, data, spec.variants[k - 1]));
    const double b = observe(spec, only_run(spec, data, spec.variants[k]));
    const double step = (b - a) / std::abs(a);
    if (!(step >= smallest)) smallest = step;  // keeps a NaN
  }
  records.push_back(
      judge(spec, data, fmt::format("smallest step of {}: {}", described(spec), names), smallest, "1"));
}

// ---- ratio: a quantity relative to that of another variant

void read_ratio(TomlTable& table, const Study& study, CheckSpec& spec) {
  require_band(table);
  read_quantity(table, study, spec);
  read_against(table, study, spec);
}

void evaluate_ratio(const CheckSpec& spec, const StudyData& data, Records& records) {
  const double unit = observe(spec, only_run(spec, data, spec.against));
  for (const std::string& variant : spec.variants)
    records.push_back(judge(spec, data,
                            fmt::format("{} of {} over {}", described(spec), variant, spec.against),
                            observe(spec, only_run(spec, data, variant)) / unit, "1"));
}

// ---- crossing: when the probe histories of two variants change order

void read_crossing(TomlTable& table, const Study& study, CheckSpec& spec) {
  require_band(table);
  read_level(table, study, spec);
  read_against(table, study, spec);
}

void evaluate_crossing(const CheckSpec& spec, const StudyData& data, Records& records) {
  for (const std::string& variant : spec.variants)
    records.push_back(judge(spec, data, fmt::format("{} crosses {}", variant, spec.against),
                            crossing_time(only_run(spec, data, variant), only_run(spec, data, spec.against)),
                            "s"));
}

}  // namespace

void add_quantity_kinds(std::vector<CheckKind>& kinds) {
  kinds.push_back({"scalar", read_scalar, evaluate_scalar});
  kinds.push_back({"ordering", read_ordering, evaluate_ordering});
  kinds.push_back({"ratio", read_ratio, evaluate_ratio});
  kinds.push_back({"crossing", read_crossing, evaluate_crossing});
}

}  // namespace verification

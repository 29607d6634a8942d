#include "reports/records/report_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>

namespace reports {

bool holds(const CheckRecord& check) {
  return check.verdict == "pass" && check.lower <= check.observed && check.observed <= check.upper;
}

std::vector<const CheckRecord*> failures(const Results& results) {
  std::vector<const CheckRecord*> failed;
  for (const CheckRecord& check : results.checks) {
    if (!holds(check)) failed.push_back(&check);
  }
  return failed;
}

bool passed(const Results& results) {
  return !results.checks.empty() && failures(results).empty();
}

std::string verdict_line(const Results& results) {
  if (results.checks.empty()) return "FAIL: no check was made";
  const std::size_t all = results.checks.size();
  return fmt::format("{}: {} of {} checks hold", passed(results) ? "PASS" : "FAIL",
                     all - failures(results).size(), all);
}

std::vector<StudyRecord> studies_of(const Results& results) {
  std::vector<StudyRecord> studies = results.studies;
  const auto mention = [&](const std::string& name) {
    const bool known =
        std::any_of(studies.begin(), studies.end(), [&](const StudyRecord& s) { return s.study == name; });
    if (!known) studies.push_back({name, name, "", ""});
  };
  for (const CheckRecord& check : results.checks) mention(check.study);
  for (const OrderRecord& order : results.orders) mention(order.study);
  for (const RunRecord& run : results.runs) mention(run.study);
  for (const FigureRecord& figure : results.figures)
    if (!figure.study.empty()) mention(figure.study);  // a figure of a whole chapter belongs to no study
  return studies;
}

std::vector<const CheckRecord*> checks_of(const Results& results, const std::string& study) {
  std::vector<const CheckRecord*> checks;
  for (const CheckRecord& check : results.checks) {
    if (check.study == study) checks.push_back(&check);
  }
  // Failures first, each kind in the order of the file.
  std::stable_partition(checks.begin(), checks.end(),
                        [](const CheckRecord* check) { return !holds(*check); });
  return checks;
}

std::vector<const OrderRecord*> orders_of(const Results& results, const std::string& study) {
  std::vector<const OrderRecord*> orders;
  for (const OrderRecord& order : results.orders) {
    if (order.study == study) orders.push_back(&order);
  }
  return orders;
}

bool completed(const RunRecord& run) {
  return run.status == "completed";
}

double wall_time_of(const Results& results, const std::string& study) {
  std::set<std::string_view> runs;
  for (const RunRecord& run : results.runs)
    if (run.study == study) runs.insert(run.run);
  double sum = std::numeric_limits<double>::quiet_NaN();
  for (const TimingRecord& timing : results.timings) {
    if (!std::isfinite(timing.wall_s) || !runs.contains(timing.run)) continue;
    sum = (std::isnan(sum) ? 0 : sum) + timing.wall_s;
  }
  return sum;
}

namespace {

bool belongs(const RateTable& table, const LevelRecord& level) {
  return table.variant == level.variant && table.axis == level.axis && table.location == level.location &&
         table.norm == level.norm;
}

void fill(RateTable& table, const std::vector<const LevelRecord*>& levels) {
  const double missing = std::numeric_limits<double>::quiet_NaN();
  std::set<double> times;
  std::set<double, std::greater<>> steps;
  for (const LevelRecord* level : levels) times.insert(level->t), steps.insert(level->step);
  table.times.assign(times.begin(), times.end());
  for (const double step : steps) {
    RateTable::Row row{step, {}, {}, {}};
    for (const double t : table.times) {
      const auto level = std::find_if(levels.begin(), levels.end(),
                                      [&](const LevelRecord* l) { return l->step == step && l->t == t; });
      row.errors.push_back(level == levels.end() ? missing : (*level)->value);
      row.used.push_back(level == levels.end() || (*level)->used);
      const std::size_t column = row.errors.size() - 1;
      if (table.rows.empty()) {
        row.rates.push_back(missing);
      } else {
        const RateTable::Row& coarser = table.rows.back();
        const double slope =
            std::log(coarser.errors[column] / row.errors[column]) / std::log(coarser.step / row.step);
        row.rates.push_back(std::isfinite(slope) ? slope : missing);
      }
    }
    table.rows.push_back(row);
  }
}

}  // namespace

std::string step_symbol(const std::string& axis) {
  return axis == "time" ? "dt [s]" : axis == "mach" ? "Ma" : "h [m]";
}

std::vector<RateTable> rate_tables(const Results& results, const std::string& study) {
  std::vector<RateTable> tables;
  std::vector<std::vector<const LevelRecord*>> levels;
  for (const LevelRecord& level : results.levels) {
    if (level.study != study) continue;
    auto found =
        std::find_if(tables.begin(), tables.end(), [&](const RateTable& t) { return belongs(t, level); });
    if (found == tables.end()) {
      found = tables.insert(tables.end(), {level.variant, level.axis, level.location, level.norm, {}, {}});
      levels.emplace_back();
    }
    levels[static_cast<std::size_t>(found - tables.begin())].push_back(&level);
  }
  std::vector<RateTable> shown;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const RateTable& table = tables[i];
    const bool has_l2 = std::any_of(tables.begin(), tables.end(), [&](const RateTable& other) {
      return other.norm == "l2" && other.variant == table.variant && other.axis == table.axis &&
             other.location == table.location;
    });
    if (has_l2 && table.norm != "l2") continue;
    fill(tables[i], levels[i]);
    shown.push_back(table);
  }
  return shown;
}

std::string number(double value, int digits) {
  if (std::isnan(value)) return "nan";
  return fmt::format("{:.{}g}", value, digits);
}

std::string rate(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.3f}", value);
}

std::string bounds(const CheckRecord& check) {
  const double infinity = std::numeric_limits<double>::infinity();
  if (check.lower == -infinity && check.upper == infinity) return "any";
  if (check.lower == -infinity) return "at most " + number(check.upper);
  if (check.upper == infinity) return "at least " + number(check.lower);
  return number(check.lower) + " to " + number(check.upper);
}

std::string observed(const CheckRecord& check) {
  if (check.lower <= check.observed && check.observed <= check.upper) return number(check.observed);
  int digits = 4;
  while (digits < 17 && (number(check.observed, digits) == number(check.lower, digits) ||
                         number(check.observed, digits) == number(check.upper, digits))) {
    ++digits;
  }
  // In the last digits the shortest form that reads back: 1e-06, not 9.9999999999999995e-07.
  return digits < 17 ? number(check.observed, digits) : fmt::format("{}", check.observed);
}

std::string with_unit(const std::string& value, const CheckRecord& check) {
  return check.unit.empty() || check.unit == "1" || check.unit == "-" ? value : value + " " + check.unit;
}

std::string order_with_interval(const OrderRecord& order) {
  if (std::isnan(order.observed)) return "none";
  std::string text = fmt::format("{:.3f}", order.observed);
  if (std::isfinite(order.ci_lower) && std::isfinite(order.ci_upper)) {
    text += fmt::format(" [{:.3f}, {:.3f}]", order.ci_lower, order.ci_upper);
  }
  return text;
}

}  // namespace reports

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include "reports/figures/drawing/figure_script.hpp"
#include "reports/figures/figures.hpp"
#include "reports/files/io_error.hpp"

namespace reports {
namespace {

constexpr std::size_t most_curves = 8;

struct Ladder {
  std::string variant, location;
  double t;
  std::vector<LevelRecord> levels;  // coarse to fine
  const OrderRecord* order = nullptr;
};

std::string axis_of(const FigureRecord& record, const Results& results) {
  std::set<std::string> axes;
  for (const LevelRecord& level : results.levels) {
    if (level.study == record.study) axes.insert(level.axis);
  }
  if (record.across.empty() && axes.size() <= 1) return axes.empty() ? "space" : *axes.begin();
  if (record.across == "space" || record.across == "time" || record.across == "mach") return record.across;
  throw IoError(fmt::format("figures.csv: figure '{}' needs across = space, time or mach", record.figure));
}

std::vector<Ladder> ladders_of(const FigureRecord& record, const Results& results, const std::string& axis) {
  const std::vector<std::string> locations = locations_of(record), variants = split_list(record.labels);
  std::vector<Ladder> ladders;
  const auto matches = [&](const auto& row) {
    return row.study == record.study && row.axis == axis && row.norm == norm_of(record) &&
           std::find(locations.begin(), locations.end(), row.location) != locations.end() &&
           (variants.empty() || std::find(variants.begin(), variants.end(), row.variant) != variants.end());
  };
  const auto same = [](const Ladder& ladder, const auto& row) {
    return ladder.variant == row.variant && ladder.location == row.location && ladder.t == row.t;
  };
  for (const LevelRecord& level : results.levels) {
    if (!matches(level)) continue;
    auto found =
        std::find_if(ladders.begin(), ladders.end(), [&](const Ladder& l) { return same(l, level); });
    if (found == ladders.end()) {
      ladders.push_back({level.variant, level.location, level.t, {}});
      found = std::prev(ladders.end());
    }
    found->levels.push_back(level);
  }
  for (Ladder& ladder : ladders) {
    std::sort(ladder.levels.begin(), ladder.levels.end(),
              [](const LevelRecord& a, const LevelRecord& b) { return a.step > b.step; });
    for (const OrderRecord& order : results.orders) {
      if (matches(order) && same(ladder, order)) ladder.order = &order;
    }
  }
  return ladders;
}

// Keep what one can tell apart: first and last time, then the last alone, then the first ladders. Returns
// what to say.
std::string keep_legible(std::vector<Ladder>& ladders) {
  std::set<double> times;
  std::set<std::string> variants;
  for (const Ladder& ladder : ladders) times.insert(ladder.t), variants.insert(ladder.variant);
  if (ladders.size() <= most_curves && (variants.size() == 1 || times.size() == 1)) return "";
  const double first = *times.begin(), last = *times.rbegin();
  std::string note;
  const auto keep = [&](auto wanted) {
    ladders.erase(std::remove_if(ladders.begin(), ladders.end(), [&](const Ladder& l) { return !wanted(l); }),
                  ladders.end());
  };
  if (times.size() > 1 && variants.size() == 1) {
    keep([&](const Ladder& l) { return l.t == first || l.t == last; });
    note = fmt::format(" Shown: first and last of {} times.", times.size());
  } else if (times.size() > 1) {
    keep([&](const Ladder& l) { return l.t == last; });
    note = fmt::format(" Shown: t = {:.4g} s, the last of {} times.", last, times.size());
  }
  const std::size_t most = 2 * most_curves;
  if (ladders.size() > most) {
    note += fmt::format(" Shown: the first {} of {} curves.", most, ladders.size());
    ladders.resize(most);
  }
  return note;
}

std::string legend_of(const Ladder& ladder, bool several_variants) {
  std::string legend = several_variants ? ladder.variant + ", " : "";
  legend += fmt::format("{}, t = {:.4g} s", ladder.location, ladder.t);
  if (!ladder.order) return legend;
  const OrderRecord& order = *ladder.order;
  if (!std::isfinite(order.observed)) return legend + ": no order (" + order.classification + ")";
  legend += fmt::format(": order {:.3f}", order.observed);
  if (std::isfinite(order.ci_lower) && std::isfinite(order.ci_upper)) {
    legend += fmt::format(" [{:.3f}, {:.3f}]", order.ci_lower, order.ci_upper);
  }
  return legend;
}

// A slope of the theoretical order just below every fitted curve that has it.
void add_reference_slopes(FigureScript& script, const std::vector<Ladder>& ladders) {
  std::set<double> orders;
  for (const Ladder& ladder : ladders) {
    if (ladder.order && std::isfinite(ladder.order->theoretical)) orders.insert(ladder.order->theoretical);
  }
  static constexpr const char* dashes[] = {"2", "3", "4", "5"};
  std::size_t count = 0;
  for (const double p : orders) {
    double constant = std::numeric_limits<double>::infinity(), coarse = 0, fine = constant;
    for (const Ladder& ladder : ladders) {
      if (!ladder.order || ladder.order->theoretical != p) continue;
      for (const LevelRecord& level : ladder.levels) {
        if (!level.used || !(level.value > 0) || !std::isfinite(level.value)) continue;
        constant = std::min(constant, level.value / std::pow(level.step, p));
        coarse = std::max(coarse, level.step);
        fine = std::min(fine, level.step);
      }
    }
    if (!std::isfinite(constant) || coarse <= fine) continue;
    constant *= 0.6;
    script.line({{coarse, constant * std::pow(coarse, p)}, {fine, constant * std::pow(fine, p)}}, "#555555",
                fmt::format("slope of the theoretical order {:.4g}", p), 1.5, dashes[count++ % 4]);
  }
}

// Ticks at the steps themselves: a ladder rarely spans the two decades that automatic ticks need.
void add_step_ticks(FigureScript& script, const std::vector<Ladder>& ladders) {
  std::set<double> steps;
  for (const Ladder& ladder : ladders) {
    for (const LevelRecord& level : ladder.levels) {
      if (level.step > 0 && std::isfinite(level.step)) steps.insert(level.step);
    }
  }
  if (steps.empty()) return;
  std::string ticks;
  double previous = 0;
  for (const double step : steps) {
    // Labels closer than this factor would run into each other.
    const bool labelled = step > previous * 1.35;
    if (labelled) previous = step;
    const double exponent = std::floor(std::log10(step) + 1e-12);
    const std::string mantissa = fmt::format("{:.3g}", step / std::pow(10, exponent));
    const std::string label =
        fmt::format("{}10^{{{:.0f}}}", mantissa == "1" ? std::string() : mantissa + "·", exponent);
    ticks += fmt::format("{}'{}' {:.9g}", ticks.empty() ? "" : ", ", labelled ? label : "", step);
  }
  script.statement("set xtics (" + ticks + ")");
  script.statement(fmt::format("set xrange [{:.6g}:{:.6g}]", *steps.begin() / 1.3, *steps.rbegin() * 1.3));
}

}  // namespace

Figure convergence_figure(const FigureRecord& record, const Results& results) {
  const std::string axis = axis_of(record, results);
  std::vector<Ladder> ladders = ladders_of(record, results, axis);
  Figure figure;
  if (ladders.empty()) return figure;
  const std::string note = keep_legible(ladders);
  std::set<std::string> variants;
  for (const Ladder& ladder : ladders) variants.insert(ladder.variant);

  const std::string norm = norm_symbol(norm_of(record));
  FigureScript script(record.title,
                      axis == "space"  ? "cell size h [m]"
                      : axis == "mach" ? "Mach number [-]"
                                       : "time step dt [s]",
                      axis != "time" ? fmt::format("relative {} error [-]", norm)
                                     : fmt::format("relative {} difference to next finer dt [-]", norm));
  script.logarithmic_x();
  script.logarithmic_y();
  add_step_ticks(script, ladders);
  std::vector<std::string> colours, marks;  // what has been given a colour or a mark, in order of appearance
  const auto index_in = [](std::vector<std::string>& known, const std::string& key) {
    const auto found = std::find(known.begin(), known.end(), key);
    if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
    known.push_back(key);
    return known.size() - 1;
  };
  bool any_dropped = false;
  long not_finite = 0;
  for (const Ladder& ladder : ladders) {
    const std::string colour =
        curve_colour(index_in(colours, variants.size() > 1 ? ladder.variant : fmt::format("{}", ladder.t)));
    const Mark mark = curve_mark(index_in(marks, ladder.location));
    Curve used, dropped;
    for (const LevelRecord& level : ladder.levels) {
      if (!std::isfinite(level.value)) ++not_finite;
      (level.used ? used : dropped).emplace_back(level.step, level.value);
    }
    any_dropped = any_dropped || !dropped.empty();
    script.line_and_points(used, colour, mark.filled, legend_of(ladder, variants.size() > 1));
    script.points(dropped, colour, mark.hollow, used.empty() ? legend_of(ladder, variants.size() > 1) : "",
                  1);
  }
  if (script.empty()) return figure;
  add_reference_slopes(script, ladders);
  figure.script = script.text(record.figure);
  figure.caption = "Orders are least-squares slopes with their 95 % confidence interval.";
  if (any_dropped) figure.caption += " Hollow marks: levels left out of the fit.";
  if (not_finite)
    figure.caption += fmt::format(" {} level(s) without a finite value are not drawn.", not_finite);
  figure.caption += note;
  return figure;
}

}  // namespace reports

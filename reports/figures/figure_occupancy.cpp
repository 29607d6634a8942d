#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "reports/figures/drawing/figure_script.hpp"
#include "reports/figures/figures.hpp"
#include "reports/records/directory/run_files.hpp"

namespace reports {

Figure occupancy_figure(const std::filesystem::path& dir, const FigureRecord& record,
                        const Results& results) {
  FigureScript script(record.title, "t [s]", "particles of a cell over their mean");
  const std::vector<LabelledRun> runs = runs_of(record, results);
  double most_of_all = 0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    std::map<double, std::pair<double, double>> range;  // by time: emptiest and fullest cell
    for (const StateRow& row : read_state(dir, runs[r].run->run)) {
      if (row.location != "cells") continue;
      const double share = row.density / row.density_exact;
      const auto [entry, first] = range.try_emplace(row.t, share, share);
      entry->second = {std::min(entry->second.first, share), std::max(entry->second.second, share)};
    }
    Curve fewest, most;
    for (const auto& [t, shares] : range) {
      fewest.emplace_back(t, shares.first);
      most.emplace_back(t, shares.second);
      most_of_all = std::max(most_of_all, shares.second);
    }
    const std::string colour = curve_colour(r);
    script.line_and_points(fewest, colour, curve_mark(r).hollow, runs[r].label + ", fewest");
    script.line_and_points(most, colour, curve_mark(r).filled, runs[r].label + ", most");
  }
  Figure figure;
  if (script.empty()) return figure;
  script.y_range(0, 1.25 * most_of_all);  // an empty cell lies on the axis
  figure.script = script.text(record.figure);
  figure.caption = fmt::format("Emptiest and fullest cell of {} at every output time.", method_of(runs));
  return figure;
}

}  // namespace reports

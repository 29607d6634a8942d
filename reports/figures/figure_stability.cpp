#include <algorithm>
#include <cmath>

#include "reports/figures/drawing/figure_script.hpp"
#include "reports/figures/figures.hpp"

namespace reports {
namespace {

/// The rows of one line of the map.
struct Boundary {
  std::string scheme, motion;
  Curve predicted, measured;
};

std::string scheme_of(const StabilityRecord& record) {
  return record.basis + "_" + record.transfer + "_" + record.stepping;
}

std::vector<Boundary> boundaries(const FigureRecord& record, const Results& results) {
  std::vector<Boundary> found;
  for (const std::string& scheme : split_list(record.runs))
    for (const std::string& motion : split_list(record.location)) {
      Boundary boundary{scheme, motion, {}, {}};
      for (const StabilityRecord& row : results.stability) {
        if (row.study != record.study || row.waves != record.across || scheme_of(row) != scheme ||
            row.motion != motion)
          continue;
        if (row.kind == "boundary")
          boundary.predicted.emplace_back(row.r_predicted, row.cfl_predicted);
        else
          boundary.measured.emplace_back(row.r_measured, row.cfl_measured);
      }
      // A boundary without end (an implicit scheme's) is drawn as far as it was followed.
      if (!boundary.predicted.empty() || !boundary.measured.empty()) found.push_back(boundary);
    }
  return found;
}

std::string legend_of(const Boundary& boundary, bool several_motions) {
  std::string legend = boundary.scheme;
  std::replace(legend.begin(), legend.end(), '_', ' ');
  return several_motions ? legend + ", " + boundary.motion : legend;
}

}  // namespace

Figure stability_figure(const FigureRecord& record, const Results& results) {
  Figure figure;
  const std::vector<Boundary> found = boundaries(record, results);
  if (found.empty()) return figure;
  FigureScript script(record.title, "r = ν dt/h² [-]", "c dt/h [-]");
  const auto motions = split_list(record.location);
  double widest = 0, highest = 0;
  for (const Boundary& boundary : found)
    for (const Curve& curve : {boundary.predicted, boundary.measured})
      for (const auto& [r, cfl] : curve) {
        if (std::isfinite(r)) widest = std::max(widest, r);
        if (std::isfinite(cfl)) highest = std::max(highest, cfl);
      }
  script.statement("set xrange [0:" + std::to_string(1.06 * widest) + "]");
  script.y_range(0, 1.08 * highest);
  std::size_t index = 0;
  for (const Boundary& boundary : found) {
    const bool rest = boundary.motion == motions.front();
    const std::string colour = curve_colour(index / motions.size());
    const Mark mark = curve_mark(index / motions.size());
    script.line(boundary.predicted, colour, legend_of(boundary, motions.size() > 1), 2, rest ? "solid" : "2");
    script.points(boundary.measured, colour, rest ? mark.filled : mark.hollow, "", 1.2);
    ++index;
  }
  if (script.empty()) return figure;
  figure.script = script.text(record.figure);
  figure.caption =
      "Stable below each line: spectral radius of the amplification matrix one (predicted). Marks: largest "
      "stable step of the solver, by bisection, along rays of growing dt.";
  return figure;
}

}  // namespace reports

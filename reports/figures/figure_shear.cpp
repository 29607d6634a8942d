#include <fmt/format.h>

#include <algorithm>

#include "reports/figures/drawing/figure_script.hpp"
#include "reports/figures/figures.hpp"
#include "reports/files/io_error.hpp"
#include "reports/records/directory/run_files.hpp"

namespace reports {

Figure shear_figure(const std::filesystem::path& dir, const FigureRecord& record, const Results& results) {
  const bool viscosity = record.kind == "viscosity";
  const std::vector<LabelledRun> runs = runs_of(record, results);
  std::vector<std::vector<ShearRow>> rows;
  double largest_place = 0;
  for (const LabelledRun& run : runs) {
    rows.push_back(read_shear(dir, run.run->run));
    std::erase_if(rows.back(), [&](const ShearRow& row) { return row.t != record.t; });
    for (const ShearRow& row : rows.back()) largest_place = std::max(largest_place, row.place);
  }
  const Unit length = readable_length(largest_place);
  FigureScript script(record.title, fmt::format("y [{}]", length.name),
                      viscosity ? "viscosity mu/mu0 [-]" : "shear rate [1/s]");
  bool any_exact = false;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    Curve exact, measured;
    for (const ShearRow& row : rows[r])
      (row.location == "exact" ? exact : measured)
          .emplace_back(row.place * length.factor, viscosity ? row.viscosity_ratio : row.shear_rate);
    any_exact = any_exact || !exact.empty();
    script.line(exact, curve_colour(r), "", 1.3);
    script.points(measured, curve_colour(r), curve_mark(r).filled, runs[r].label, 0.7);
  }
  Figure figure;
  if (script.empty()) return figure;
  if (any_exact) script.legend_line("#555555", solution_name(runs), 1.3);
  figure.script = script.text(record.figure);
  figure.caption = fmt::format("t = {:.4g} s. Lines: reference solution. Marks: {} at cell centres.",
                               record.t, method_of(runs));
  return figure;
}

}  // namespace reports

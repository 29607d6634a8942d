#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/figures/drawing/figure_script.hpp"
#include "reports/records/records.hpp"

namespace reports {

/// A diagram ready to be drawn.
struct Figure {
  std::string name, study;
  std::string title;    ///< the claim
  std::string caption;  ///< what is shown and what was left out, one or two sentences
  std::string script;   ///< for gnuplot; "" when there is nothing finite to draw
};

/// Build the diagram that `record` asks for from the tables and, for profiles and histories, the files in
/// `dir`.
/// @throws IoError if the record names an unknown kind or run, or a file that it needs is missing.
Figure build_figure(const std::filesystem::path& dir, const FigureRecord& record, const Results& results);

// One function a kind; each fills title, caption and script.
Figure profiles_figure(const std::filesystem::path& dir, const FigureRecord& record, const Results& results);
/// Kinds "history" (velocity at the probe) and "energy" (kinetic energy of the whole scene).
Figure history_figure(const std::filesystem::path& dir, const FigureRecord& record, const Results& results);
/// Kinds "shear-rate" and "viscosity": across a channel at one time, one colour a run (the paper's Figs 4, 5,
/// 9, 10).
Figure shear_figure(const std::filesystem::path& dir, const FigureRecord& record, const Results& results);

/// Kind "pressure": pressure of the particles across the flow at one time, one colour a run.
Figure pressure_figure(const std::filesystem::path& dir, const FigureRecord& record, const Results& results);
/// Kind "occupancy": particles of the emptiest and of the fullest cell over time.
Figure occupancy_figure(const std::filesystem::path& dir, const FigureRecord& record, const Results& results);
Figure convergence_figure(const FigureRecord& record, const Results& results);
Figure work_precision_figure(const FigureRecord& record, const Results& results);
/// Stable regions in the plane of r = nu dt/h^2 and c dt/h: predicted boundaries, measured points.
Figure stability_figure(const FigureRecord& record, const Results& results);

/// Kind "regularisation": error over mesh and regularisation of a yield stress, and a path through the plane.
Figure regularisation_figure(const FigureRecord& record, const Results& results);
/// Kind "yielded": where the fluid of a box flows at one time, and its stream lines; a diagram a run.
Figure yielded_figure(const std::filesystem::path& dir, const FigureRecord& record, const Results& results);

/// Kind "validation": measured values with error bars, simulated ones with their band.
Figure validation_figure(const FigureRecord& record, const Results& results);
/// Kind "validation-parts": the three parts of u_val^2 of every point, as bars.
Figure validation_parts_figure(const FigureRecord& record, const Results& results);
/// Kind "computed-measured": one quantity over all studies, with bias and scatter.
Figure computed_measured_figure(const FigureRecord& record, const Results& results);

// What the kinds share.

/// The parts of a list joined by ';'; none for "".
std::vector<std::string> split_list(const std::string& list);

/// A run and the name under which it stands in the legend.
struct LabelledRun {
  const RunRecord* run;
  std::string label;
};
/// What the lines are: "exact" where every fluid is Newtonian, else "reference" (computed, to a stated
/// error).
std::string solution_name(const std::vector<LabelledRun>& runs);
/// Whose points they are: "MPM", or what the runs say, joined by " and ".
std::string method_of(const std::vector<LabelledRun>& runs);
std::vector<LabelledRun> runs_of(const FigureRecord& record, const Results& results);

/// Locations asked for; "grid" and "particles" if none is named.
std::vector<std::string> locations_of(const FigureRecord& record);

/// A factor from SI to a unit in which `largest` reads well, and that unit ("m", "mm", "µm").
struct Unit {
  double factor;
  std::string name;
};
Unit readable_length(double largest);

/// At most `count` of the sorted distinct `times`, first and last among them.
std::vector<double> chosen_times(std::vector<double> times, std::size_t count);

/// Whether one line serves for all curves: they agree to a thousandth of `largest`, about a line's width.
bool coincide(const std::vector<Curve>& curves, double largest);

/// Norm as it is printed: "L2" for "l2". l2 is taken when the record names none.
std::string norm_of(const FigureRecord& record);
std::string norm_symbol(const std::string& norm);

}  // namespace reports

#include "reports/figures/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/figures/drawing/figure_script.hpp"
#include "reports/files/io_error.hpp"
#include "reports/records/directory/result_files.hpp"

namespace reports {

std::vector<std::string> split_list(const std::string& list) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin < list.size()) {
    const std::size_t end = std::min(list.find(';', begin), list.size());
    parts.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::vector<LabelledRun> runs_of(const FigureRecord& record, const Results& results) {
  std::vector<LabelledRun> chosen;
  const std::vector<std::string> names = split_list(record.runs), labels = split_list(record.labels);
  if (names.empty()) {
    for (const RunRecord& run : results.runs) {
      if (run.study == record.study) chosen.push_back({&run, run.run});
    }
  }
  for (const std::string& name : names) {
    const auto found = std::find_if(results.runs.begin(), results.runs.end(),
                                    [&](const RunRecord& run) { return run.run == name; });
    if (found == results.runs.end()) {
      throw IoError(fmt::format("figures.csv: figure '{}' names run '{}', which runs.csv does not have",
                                record.figure, name));
    }
    chosen.push_back({&*found, name});
  }
  if (!labels.empty() && labels.size() != chosen.size()) {
    throw IoError(fmt::format("figures.csv: figure '{}' has {} labels for {} runs", record.figure,
                              labels.size(), chosen.size()));
  }
  for (std::size_t i = 0; i < labels.size(); ++i) chosen[i].label = labels[i];
  // The built-in solver's variants are told apart by their names alone; whoever else made points is named.
  for (LabelledRun& run : chosen)
    if (run.run->method != RunRecord().method && run.label.find(run.run->method) == std::string::npos)
      run.label += (run.label.empty() ? "" : ", ") + run.run->method;
  return chosen;
}

std::string solution_name(const std::vector<LabelledRun>& runs) {
  const bool newtonian = std::all_of(runs.begin(), runs.end(),
                                     [](const LabelledRun& run) { return run.run->fluid == "newtonian"; });
  return newtonian ? "exact" : "reference";
}

std::string method_of(const std::vector<LabelledRun>& runs) {
  std::vector<std::string> methods;
  for (const LabelledRun& run : runs)
    if (std::ranges::count(methods, run.run->method) == 0) methods.push_back(run.run->method);
  std::string text;
  for (const std::string& method : methods) text += (text.empty() ? "" : " and ") + method;
  return text;
}

std::vector<std::string> locations_of(const FigureRecord& record) {
  const std::vector<std::string> named = split_list(record.location);
  return named.empty() ? std::vector<std::string>{"grid", "particles"} : named;
}

Unit readable_length(double largest) {
  if (largest >= 0.5) return {1, "m"};
  if (largest >= 0.5e-5) return {1e3, "mm"};
  return {1e6, "µm"};
}

std::vector<double> chosen_times(std::vector<double> times, std::size_t count) {
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  if (times.size() <= count || count < 2) return times;
  std::vector<double> few;
  for (std::size_t i = 0; i < count; ++i) few.push_back(times[i * (times.size() - 1) / (count - 1)]);
  return few;
}

std::string norm_of(const FigureRecord& record) {
  return record.norm.empty() ? "l2" : record.norm;
}

std::string norm_symbol(const std::string& norm) {
  if (norm == "l1") return "L1";
  if (norm == "l2") return "L2";
  if (norm == "linf") return "L∞";
  return norm;
}

namespace {

double value_at(const Curve& curve, double t) {
  const auto after =
      std::lower_bound(curve.begin(), curve.end(), t, [](const auto& p, double x) { return p.first < x; });
  if (after == curve.end()) return curve.back().second;
  if (after == curve.begin()) return after->second;
  const auto before = after - 1;
  return before->second +
         (t - before->first) / (after->first - before->first) * (after->second - before->second);
}

}  // namespace

bool coincide(const std::vector<Curve>& curves, double largest) {
  for (const Curve& curve : curves) {
    if (curve.empty() || curves[0].empty()) return false;
    for (const auto& [t, value] : thinned(curve, 50)) {
      if (!(std::abs(value - value_at(curves[0], t)) <= 1e-3 * largest)) return false;
    }
  }
  return true;
}

Figure build_figure(const std::filesystem::path& dir, const FigureRecord& record, const Results& results) {
  require_plain_name("figure", record.figure);
  Figure figure;
  if (record.kind == "profiles") {
    figure = profiles_figure(dir, record, results);
  } else if (record.kind == "history" || record.kind == "energy") {
    figure = history_figure(dir, record, results);
  } else if (record.kind == "shear-rate" || record.kind == "viscosity") {
    figure = shear_figure(dir, record, results);
  } else if (record.kind == "pressure") {
    figure = pressure_figure(dir, record, results);
  } else if (record.kind == "occupancy") {
    figure = occupancy_figure(dir, record, results);
  } else if (record.kind == "convergence") {
    figure = convergence_figure(record, results);
  } else if (record.kind == "work-precision") {
    figure = work_precision_figure(record, results);
  } else if (record.kind == "stability-map") {
    figure = stability_figure(record, results);
  } else if (record.kind == "regularisation") {
    figure = regularisation_figure(record, results);
  } else if (record.kind == "yielded") {
    figure = yielded_figure(dir, record, results);
  } else if (record.kind == "validation") {
    figure = validation_figure(record, results);
  } else if (record.kind == "validation-parts") {
    figure = validation_parts_figure(record, results);
  } else if (record.kind == "computed-measured") {
    figure = computed_measured_figure(record, results);
  } else {
    throw IoError(fmt::format(
        "figures.csv: figure '{}' is of unknown kind '{}'; known are profiles, history, "
        "energy, convergence, work-precision, shear-rate, viscosity, pressure, occupancy, stability-map, "
        "regularisation, yielded, validation, validation-parts, computed-measured",
        record.figure, record.kind));
  }
  figure.name = record.figure;
  figure.study = record.study;
  figure.title = record.title;
  return figure;
}

}  // namespace reports

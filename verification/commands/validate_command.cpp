#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/files/atomic_file.hpp"
#include "reports/files/csv.hpp"
#include "reports/pages/report.hpp"
#include "reports/records/directory/result_files.hpp"
#include "reports/records/directory/run_files.hpp"
#include "reports/records/report_data.hpp"
#include "verification/commands/commands.hpp"
#include "verification/commands/output.hpp"
#include "verification/commands/provenance_of.hpp"
#include "verification/config/config_error.hpp"
#include "verification/flows/reference_store.hpp"
#include "verification/runs/validate.hpp"

namespace verification {
namespace {

using reports::column;

/// Samples of one run, whoever wrote them.
struct LoadedRun {
  std::vector<reports::ProfileRow> profile;
  std::vector<reports::HistoryRow> history;
  std::vector<reports::SurfaceRow> surface;
};

std::vector<reports::ProfileRow> read_interchange(const std::filesystem::path& file) {
  using Row = reports::ProfileRow;
  return reports::read_csv(
      file, std::make_tuple(column("t", &Row::t), column("location", &Row::location), column("x", &Row::x),
                            column("y", &Row::y), column("u", &Row::u), column("v", &Row::v)));
}

/// A run of a result directory by its name, or, without one, the profile.csv that a solver hands in.
LoadedRun load(const std::filesystem::path& dir, const std::string& run) {
  LoadedRun loaded;
  if (run.empty()) {
    if (!std::filesystem::exists(dir / "profile.csv"))
      throw ConfigError(
          dir.string() +
          ": no profile.csv (t,location,x,y,u,v) here; or name runs of a result directory, coarse to "
          "fine, with --run");
    loaded.profile = read_interchange(dir / "profile.csv");
    return loaded;
  }
  loaded.profile = reports::read_profile(dir, run);
  if (std::filesystem::exists(dir / "profiles" / (run + ".history.csv")))
    loaded.history = reports::read_history(dir, run);
  if (std::filesystem::exists(dir / "profiles" / (run + ".surface.csv")))
    loaded.surface = reports::read_surface(dir, run);
  return loaded;
}

/// Cell sizes of a ladder from the numbers of cells in runs.csv: only their ratios matter.
std::vector<double> steps_of(const std::filesystem::path& dir, const std::vector<std::string>& runs) {
  using Run = reports::RunRecord;
  const std::vector<Run> all = reports::read_csv(
      dir / "runs.csv", std::make_tuple(column("run", &Run::run), column("cells", &Run::cells)));
  std::vector<double> steps;
  for (const std::string& name : runs) {
    const auto run = std::ranges::find(all, name, &Run::run);
    if (run == all.end()) throw ConfigError((dir / "runs.csv").string() + ": no run '" + name + "'");
    if (run->cells < 1) throw ConfigError((dir / "runs.csv").string() + ": run '" + name + "' has no cells");
    steps.push_back(1.0 / static_cast<double>(run->cells));
    if (steps.size() > 1 && !(steps.back() < steps[steps.size() - 2]))
      throw ConfigError("--run: '" + name +
                        "' is not finer than the run before it; name them coarse to fine");
  }
  return steps;
}

/// One quantity at a time: the largest error that is borne has its unit.
MeasurementTable chosen_rows(MeasurementTable table, const std::string& quantity) {
  const std::string wanted = quantity.empty() ? table.rows.front().quantity : quantity;
  const auto other = [&](const Measurement& row) { return row.quantity != wanted; };
  if (quantity.empty() && std::ranges::any_of(table.rows, other))
    throw ConfigError(table.file.string() + ": holds several quantities; choose one with --quantity");
  std::erase_if(table.rows, other);
  if (table.rows.empty()) throw ConfigError(table.file.string() + ": no value of '" + wanted + "'");
  return table;
}

void print_point(const reports::ValidationRecord& r) {
  say("{:<4} {:<16} {:>10} {:>10} {:>12} {:>12} {:>11} {:>9} {:>9} {:>9} {}\n", r.borne ? "pass" : "FAIL",
      r.quantity, reports::number(r.t), std::isnan(r.y) ? "-" : reports::number(r.y),
      reports::number(r.measured), reports::number(r.simulated), reports::number(r.error, 3),
      reports::number(r.u_num, 2), reports::number(r.u_input, 2), reports::number(r.u_data, 2), r.verdict);
}

}  // namespace

int validate_command(const ValidateOptions& options) {
  const MeasurementTable table = chosen_rows(read_measurements(options.data), options.quantity);
  ComparisonRules rules;
  rules.coverage = options.coverage;
  rules.velocity = options.velocity;
  rules.length = options.length;
  if (table.scaled && !(options.velocity > 0 && options.length > 0))
    throw ConfigError(table.file.string() + ": values are scaled: give --velocity [m/s] and --length [m]");
  rules.stated_u_num = options.u_num;
  rules.stated_u_input = options.u_input;
  for (const Measurement& row : table.rows)
    rules.bears[row.quantity] = {options.largest_error, "stated on the command line"};

  std::vector<LoadedRun> loaded;
  if (options.runs.empty()) loaded.push_back(load(options.result, ""));
  for (const std::string& run : options.runs) loaded.push_back(load(options.result, run));
  ComparedRuns runs;
  runs.formal_order = options.formal_order;
  for (const LoadedRun& run : loaded) runs.levels.push_back({&run.profile, &run.history, &run.surface});
  if (std::isnan(options.u_num)) {
    if (options.runs.size() < 3)
      throw ConfigError(
          "u_num is not known: name three runs or more of one ladder with --run, or state a relative "
          "standard uncertainty with --u-num");
    runs.steps = steps_of(options.result, options.runs);
  }

  Study study;
  study.name = options.data.stem().string();
  study.title = "Comparison with " + options.data.filename().string();
  study.claim = table.source;
  StudyData data;
  data.study = &study;
  append_comparison(data, "", compare_table(table, runs, rules, Missing::Refuse));

  say("{}\n{:<4} {:<16} {:>10} {:>10} {:>12} {:>12} {:>11} {:>9} {:>9} {:>9} verdict at k = {:g}\n",
      table.source, "", "quantity", "t", "y", "D", "S", "E", "u_num", "u_input", "u_D", options.coverage);
  for (const reports::ValidationRecord& point : data.validation) print_point(point);
  for (const reports::JointValidationRecord& joint : data.joint_validation)
    say("{}: d^2 = {} of {} values, p = {}; bias {}, scatter {}\n", joint.quantity,
        reports::number(joint.distance_squared), joint.points, reports::number(joint.p_value, 3),
        reports::number(joint.bias), reports::number(joint.scatter, 3));
  const bool passed = std::ranges::all_of(data.validation,
                                          [](const reports::ValidationRecord& point) { return point.borne; });
  if (!options.out.empty()) {
    reports::Results results;
    results.studies.push_back({study.name, study.title, study.claim, "", ""});
    results.checks = data.checks;
    results.validation = data.validation;
    results.joint_validation = data.joint_validation;
    results.validation_bias = validation_bias(data.validation);
    add_validation_figures(study, rules);
    results.figures = study.figures;
    for (const reports::FigureRecord& figure : computed_measured_figures(results.validation_bias))
      results.figures.push_back(figure);
    reports::ensure_directory(options.out);
    reports::write_provenance(options.out, provenance_of(options.command_line));
    reports::write_results(options.out, results);
    const reports::ReportOutcome outcome =
        reports::write_report(options.out, {cache_directory(), job_count(0)});
    for (const std::string& warning : outcome.warnings) warn("warning: {}\n", warning);
  }
  return passed ? 0 : 1;
}

}  // namespace verification

#include "verification/suite/run_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/files/atomic_file.hpp"
#include "reports/files/io_error.hpp"
#include "reports/process/child.hpp"
#include "reports/records/directory/result_files.hpp"
#include "verification/not_a_number.hpp"
#include "verification/runs/interruption.hpp"

namespace verification {
namespace {

namespace fs = std::filesystem;
/// Seconds that a control may take; the shipped ones take less than a tenth of one.
constexpr double longest = 600;

reports::CheckRecord check_of(const Study& study, const std::string& name, double observed, double wanted,
                              const std::string& unit, const std::string& reason) {
  return {study.name, name, observed, wanted, wanted, unit, observed == wanted ? "pass" : "fail", reason};
}

bool is_red(const reports::CheckRecord& check) {
  return check.verdict != "pass";
}

bool is_meant(const ControlSpec::MustFail& must, const reports::CheckRecord& check) {
  return is_red(check) && check.check.find(must.check) != std::string::npos &&
         check.reason.find(must.because) != std::string::npos;
}

/// Its own directory, from empty. A control is judged by what it writes now.
fs::path fresh_directory(const fs::path& out, const std::string& name) {
  const fs::path controls = out / "controls", folder = controls / name;
  for (const fs::path& path : {controls, folder})
    if (fs::is_symlink(path)) throw reports::IoError(path.string() + ": is a link; remove it");
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  reports::ensure_directory(folder);
  return folder;
}

std::string demand(const ControlSpec& control) {
  std::string text;
  for (const ControlSpec::MustFail& must : control.must_fail) {
    text += (text.empty() ? "" : "; ") + must.check;
    if (must.count > 1) text += fmt::format(" ({} checks)", must.count);
    if (!must.because.empty()) text += " because of \"" + must.because + "\"";
  }
  return text;
}

std::string said(const reports::Results& results) {
  std::string text;
  for (const reports::CheckRecord& check : results.checks)
    if (is_red(check))
      text += fmt::format("{}{}: {:.4g}", text.empty() ? "" : "; ", check.check, check.observed);
  return text;
}

}  // namespace

ControlOutcome run_control(const Study& study, const fs::path& out) {
  const ControlSpec& control = *study.control;
  const fs::path folder = fresh_directory(out, study.name);
  const fs::path log = out / "controls" / (study.name + ".txt");
  std::error_code ignored;
  reports::ChildCommand command;
  command.arguments = {fs::read_symlink("/proc/self/exe", ignored).string(),
                       "run",
                       control.file.string(),
                       "--plain",
                       "--no-cache",
                       "--jobs",
                       "1",
                       "--studies",
                       control.file.parent_path().string(),
                       "--out",
                       fs::absolute(folder).string()};
  command.environment = {{"NO_COLOR", "1"}};
  command.log = log;
  command.timeout = longest;
  command.stop = interruption_noted;
  const reports::ChildEnd end = reports::run_child(command);
  throw_if_interrupted();

  reports::Results results;
  std::vector<Shown> shown;
  std::string trouble;
  try {
    results = reports::read_results(folder);
    shown = shown_failures(folder, reports::read_file(log), results);
  } catch (const reports::IoError& error) {
    trouble = fmt::format("; it left no whole report ({}; {})", end.text(), error.what());
    results = {};
    shown.clear();
    for (const char* where : {"the console", "junit.xml", "summary.md", "report.md", "report.html"})
      shown.push_back({where, nan, nan});
  }
  ControlOutcome outcome =
      judged_control(study, end.well() || end.exit_code > 0 ? end.exit_code : nan, results, shown, trouble);
  outcome.wall_s = end.seconds;
  return outcome;
}

ControlOutcome judged_control(const Study& study, double exit_code, const reports::Results& results,
                              const std::vector<Shown>& shown, const std::string& trouble) {
  const ControlSpec& control = *study.control;
  ControlOutcome outcome;
  auto& checks = outcome.checks;
  checks.push_back(check_of(study, "exit code", exit_code, control.exit_code, "1",
                            "0 all checks pass, 1 a check failed, 3 a solver did" + trouble));
  for (const ControlSpec::MustFail& must : control.must_fail)
    checks.push_back(check_of(
        study, "red for it: " + must.check,
        static_cast<double>(
            std::ranges::count_if(results.checks, [&](const auto& c) { return is_meant(must, c); })),
        static_cast<double>(must.count), "checks",
        "planted: " + control.planted +
            (must.because.empty() ? "" : "; its reason must say \"" + must.because + "\"") + trouble));
  const auto others = std::ranges::count_if(results.checks, [&](const reports::CheckRecord& check) {
    return is_red(check) &&
           std::ranges::none_of(control.must_fail, [&](const auto& must) { return is_meant(must, check); });
  });
  checks.push_back(check_of(study, "red without cause",
                            results.checks.empty() ? nan : static_cast<double>(others), 0, "checks",
                            "the fault that is planted turns nothing else red" + trouble));
  const auto red = static_cast<double>(std::ranges::count_if(results.checks, is_red));
  double claims = static_cast<double>(
      std::ranges::count_if(results.claims, [](const auto& claim) { return !claim.stands; }));
  for (const Shown& one : shown) {
    checks.push_back(check_of(study, "failures in " + one.where, one.failures, red, "checks",
                              "as many as checks.csv has, under a verdict that fits" + trouble));
    if (one.where.starts_with("report.") && one.claims != claims) claims = nan;
  }
  checks.push_back(check_of(study, "claims that do not stand", claims, control.claims_refused, "claims",
                            "in claims.csv, report.md and report.html alike" + trouble));

  const bool seen = std::ranges::none_of(checks, is_red);
  outcome.record = {study.name,
                    control.planted,
                    demand(control),
                    said(results),
                    std::isnan(exit_code) ? -1 : std::lround(exit_code),
                    "controls/" + study.name,
                    seen};
  return outcome;
}

}  // namespace verification

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "reports/atomic_file.hpp"
#include "reports/console_table.hpp"
#include "reports/report.hpp"
#include "verification/commands/commands.hpp"
#include "verification/commands/provenance_of.hpp"
#include "verification/commands/terminal.hpp"
#include "verification/config/config_error.hpp"
#include "verification/study/study_reader.hpp"
#include "verification/suite/run_suite.hpp"

namespace verification {
namespace {

/// Studies named by the user (a name, or the path of a .toml file), or those of the suite.
std::vector<Study> chosen_studies(const RunOptions& options) {
  const Suite suite =
      suite_named(options.suite.empty() ? (options.names.empty() ? "full" : "deep") : options.suite);
  std::vector<Study> chosen;
  if (options.names.empty()) {
    for (Study& study : read_studies(options.studies))
      if (study.suite <= suite) chosen.push_back(std::move(study));
    return chosen;
  }
  for (const std::string& name : options.names) {
    const bool is_file = name.ends_with(".toml");
    const std::filesystem::path file =
        is_file ? std::filesystem::path(name) : options.studies / (name + ".toml");
    if (!is_file && !std::filesystem::exists(file))
      throw ConfigError("study '" + name + "' is not known in " + options.studies.string() +
                        "; `mpm-verify list` names them, and a path ending in .toml is read as a file");
    Study study = read_study(file);
    if (std::ranges::any_of(chosen, [&](const Study& other) { return other.name == study.name; }))
      throw ConfigError("study '" + study.name + "' is named twice");
    if (study.suite <= suite) chosen.push_back(std::move(study));
  }
  return chosen;
}

void print_study_line(const StudyData& data, bool colour) {
  const auto failed =
      std::ranges::count_if(data.checks, [](const auto& check) { return check.verdict != "pass"; });
  double wall = 0;
  for (const RunData& run : data.runs) wall += run.timing.wall_s;
  for (const auto& timing : data.stability_timings) wall += timing.wall_s;
  const char* verdict =
      failed ? (colour ? "\033[31mFAIL\033[0m" : "FAIL") : (colour ? "\033[32mpass\033[0m" : "pass");
  fmt::print("{} {:<34} {:>4} of {:>4} checks {:>5} runs {:>8.2f} s\n", verdict, data.study->name,
             data.checks.size() - static_cast<std::size_t>(failed), data.checks.size(),
             data.runs.size() + data.stability_timings.size(), wall);
  std::fflush(stdout);
}

}  // namespace

int run_command(const RunOptions& options) {
  const std::vector<Study> studies = chosen_studies(options);
  if (studies.empty()) throw ConfigError("no study of that suite: nothing would be verified");
  const int jobs =
      options.jobs > 0 ? options.jobs : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));

  SuiteListener listener;
  const bool progress = show_progress(), colour = use_colour();
  if (progress)
    listener.run_ended = [](long done, long total, const std::string& run) {
      fmt::print(stderr, "\r\033[K[{}/{} runs] {}", done, total, run);
      if (done == total) fmt::print(stderr, "\r\033[K");
    };
  listener.study_ended = [&](const StudyData& data) {
    if (progress) fmt::print(stderr, "\r\033[K");
    print_study_line(data, colour);
  };
  // Provenance first: an interrupted run still says what made its files.
  reports::ensure_directory(options.out);
  reports::write_provenance(options.out, provenance_of(options.command_line));
  const SuiteOutcome outcome = run_suite(studies, options.out, jobs, listener);
  const reports::ReportOutcome report = reports::write_report(options.out);

  fmt::print("\n{}", reports::console_table(outcome.results.checks, colour));
  for (const std::string& warning : report.warnings) fmt::print(stderr, "warning: {}\n", warning);
  fmt::print("report: {}\n", (options.out / "report.html").string());
  if (!outcome.failures.empty()) {
    for (const std::string& failure : outcome.failures) fmt::print(stderr, "error: run {}\n", failure);
    return 3;
  }
  return report.passed ? 0 : 1;
}

}  // namespace verification

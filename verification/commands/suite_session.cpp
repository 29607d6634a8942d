#include "verification/commands/suite_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "reports/compare/earlier_run.hpp"
#include "reports/files/atomic_file.hpp"
#include "reports/pages/console_table.hpp"
#include "reports/pages/report.hpp"
#include "reports/records/directory/result_directory.hpp"
#include "reports/summaries/scoreboard.hpp"
#include "verification/commands/output.hpp"
#include "verification/commands/provenance_of.hpp"
#include "verification/commands/terminal.hpp"
#include "verification/config/config_error.hpp"
#include "verification/reading/control_reader.hpp"
#include "verification/reading/scoreboard_reader.hpp"
#include "verification/reading/study_folder.hpp"
#include "verification/reading/study_reader.hpp"
#include "verification/runs/interruption.hpp"
#include "verification/scene/scene_cost.hpp"
#include "verification/suite/run_suite.hpp"
#include "verification/suite/steps/settle_steps.hpp"

namespace verification {
namespace {

void print_study_line(const StudyData& data, bool colour) {
  const auto failed =
      std::ranges::count_if(data.checks, [](const auto& check) { return check.verdict != "pass"; });
  double wall = 0;
  for (const RunData& run : data.runs) wall += run.timing.wall_s;
  for (const auto& timing : data.stability_timings) wall += timing.wall_s;
  const char* verdict =
      failed ? (colour ? "\033[31mFAIL\033[0m" : "FAIL") : (colour ? "\033[32mpass\033[0m" : "pass");
  say("{} {:<34} {:>4} of {:>4} checks {:>5} runs {:>8.2f} s\n", verdict, data.study->name,
      data.checks.size() - static_cast<std::size_t>(failed), data.checks.size(),
      data.runs.size() + data.stability_timings.size(), wall);
  std::fflush(stdout);
}

/// Says of studies whose runs are all expected to complete which steps are longer than the scheme is known to
/// bear.
void warn_of_steps(const std::vector<Study>& studies) {
  for (const Study& study : studies) {
    const bool fate_declared = std::ranges::any_of(study.checks, [](const CheckSpec& check) {
      return check.kind == "divergence" || check.kind == "outcome";
    });
    if (fate_declared) continue;
    for (const PlannedRun& run : study.runs)
      if (const std::string warning = run.solver ? "" : step_warning(run.scene); !warning.empty()) {
        warn("warning: run {}: {}\n", run.run, warning);
        break;  // one of a study is enough
      }
  }
}

/// How long a suite has still to go, from what its runs cost and how fast those that ended went.
class TimeLeft {
 public:
  explicit TimeLeft(const std::vector<Study>& studies) {
    for (const Study& study : studies) {
      for (const PlannedRun& run : study.runs)
        cost_[run.run] = run.scene.particle_steps() * (study.repetitions + 1);
      for (const StabilityCase& one : study.stability.cases)
        cost_[study.name + "." + one.name()] = study.stability.cost(one);
    }
    for (const auto& [run, cost] : cost_) left_ += cost;
  }

  /// "about 40 s left", after one more run has ended.
  std::string after(const std::string& run) {
    const auto found = cost_.find(run);
    const double cost = found == cost_.end() ? 0 : found->second;
    done_ += cost;
    left_ = std::max(0.0, left_ - cost);
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    const double seconds = done_ > 0 ? elapsed * left_ / done_ : 0;
    if (seconds >= 90) return fmt::format("about {:.0f} min left", seconds / 60);
    return fmt::format("about {:.0f} s left", std::ceil(seconds));
  }

 private:
  std::map<std::string, double> cost_;  // particle-steps
  double done_ = 0, left_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

std::vector<Study> chosen_studies(const std::filesystem::path& studies, const std::vector<std::string>& names,
                                  const std::string& suite_name, Controls controls) {
  const Suite suite = suite_named(suite_name.empty() ? (names.empty() ? "full" : "deep") : suite_name);
  std::vector<Study> chosen;
  if (names.empty()) {
    for (Study& study : read_studies(studies))
      if (restrict_to(study, suite)) chosen.push_back(std::move(study));
  }
  for (const std::string& name : names) {
    Study study = name.ends_with(".toml") ? read_study(name) : read_study_named(studies, name);
    if (std::ranges::any_of(chosen, [&](const Study& other) { return other.name == study.name; }))
      throw ConfigError("study '" + study.name + "' is named twice");
    if (suite_name.empty() || restrict_to(study, suite)) chosen.push_back(std::move(study));
  }
  for (Study& study : chosen) {
    if (controls == Controls::Plain) study.control.reset();
    if (study.control) leave_to_control(study);
  }
  require_distinct_runs(chosen);
  if (chosen.empty()) throw ConfigError("no study of that suite: nothing would be verified");
  return chosen;
}

void settle_and_say(std::vector<Study>& studies, RunCache& cache, int jobs) {
  settle_steps(studies, cache, jobs, [](const std::string& line) {
    say("{}\n", line);
    std::fflush(stdout);
  });
}

int run_session(std::vector<Study> studies, const SuiteSession& session, RunCache& cache) {
  SuiteListener listener;
  const bool progress = show_progress(), colour = use_colour();
  listener.study_ended = [&](const StudyData& data) {
    if (progress) warn("\r\033[K");
    print_study_line(data, colour);
  };
  const reports::ResultDirectory ours(session.out, session.force);
  const reports::EarlierRun earlier(session.out);
  // Provenance first: an interrupted run still says what made its files.
  reports::write_provenance(session.out, provenance_of(session.command_line));
  SuiteOutcome outcome;
  const auto stopped = [&](int signal) {
    if (progress) warn("\r\033[K");
    warn("mpm-verify: interrupted; {} holds the studies that had ended{}\n", session.out.string(),
         cache.on() ? ", and the same command goes on from there" : "");
    return 128 + signal;
  };
  try {
    const InterruptionGuard guard;
    settle_and_say(studies, cache, session.jobs);
    warn_of_steps(studies);
    if (progress)
      listener.run_ended = [left = TimeLeft(studies)](long done, long total, const std::string& run) mutable {
        warn("\r\033[K[{}/{} runs, {}] {}", done, total, left.after(run), run);
        if (done == total) warn("\r\033[K");
      };
    outcome = run_suite(studies, session.out, session.jobs, cache, listener,
                        session.keep_profiles ? Profiles::All : Profiles::Needed);
  } catch (const Interrupted& stop) {
    return stopped(stop.signal);
  } catch (const std::exception&) {
    // What fails after a signal fails because of it: a child that was stopped leaves half of its files.
    if (const int signal = noted_signal()) return stopped(signal);
    throw;
  }
  cache.prune();
  earlier.write_changes();
  const reports::ReportOutcome report =
      reports::write_report(session.out, {session.cache, session.jobs, session.pdf});

  const auto lines = reports::without_expected_outcomes(outcome.results);
  say("\n{}", reports::console_table(lines, colour, outcome.results.checks.size() - lines.size()));
  for (const std::string& warning : report.warnings) warn("warning: {}\n", warning);
  if (const std::string warning = cache.warning(); !warning.empty()) warn("warning: {}\n", warning);
  say("runs: {}, of which {} taken from the cache\n", outcome.runs, outcome.from_cache);
  say("report: {}\n", (session.out / "report.html").string());
  if (!outcome.failures.empty()) {
    for (const std::string& failure : outcome.failures) warn("error: run {}\n", failure);
    return 3;
  }
  return report.passed ? 0 : 1;
}

}  // namespace verification

#include "verification/suite/run_suite.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <limits>
#include <mutex>
#include <numeric>
#include <thread>

#include "reports/atomic_file.hpp"
#include "reports/io_error.hpp"
#include "reports/result_files.hpp"
#include "verification/checks/check_reader.hpp"
#include "verification/study/measures.hpp"
#include "verification/study/run_external.hpp"
#include "verification/study/run_simulation.hpp"
#include "verification/study/scheme_matrix.hpp"

namespace verification {
namespace {

struct Job {
  std::size_t study, run;
  double cost;
  bool measures_limit = false;  ///< `run` is then a case of the study's [stability]
};

std::vector<Job> longest_first(const std::vector<Study>& studies) {
  std::vector<Job> jobs;
  for (std::size_t s = 0; s < studies.size(); ++s)
    for (std::size_t r = 0; r < studies[s].runs.size(); ++r)
      jobs.push_back({s, r, studies[s].runs[r].scene.particle_steps()});
  for (std::size_t s = 0; s < studies.size(); ++s)
    for (std::size_t c = 0; c < studies[s].stability.cases.size(); ++c)
      jobs.push_back({s, c, studies[s].stability.cost(studies[s].stability.cases[c]), true});
  std::ranges::stable_sort(jobs, std::ranges::greater{}, &Job::cost);
  return jobs;
}

/// A run that could not be simulated at all: recorded, so that the tables say so.
RunData failed_run(const Study& study, const PlannedRun& plan, const std::string& why) {
  RunData data;
  data.plan = &plan;
  data.record = describe_run(study, plan, 0, "failed: " + why);
  data.timing.run = plan.run;
  return data;
}

/// What the scenes of a study were declared not to need (DESIGN: model only what a scene needs).
std::string left_out(const Study& study) {
  if (study.runs.empty()) return "walls (a uniform periodic lattice)";
  const auto all = [&](auto&& holds) { return std::ranges::all_of(study.runs, holds); };
  const auto any = [&](auto&& holds) { return std::ranges::any_of(study.runs, holds); };
  const auto words = [&](auto&& holds, const std::string& what) {
    return all(holds) ? what + "; " : any(holds) ? what + " (some variants); " : std::string();
  };
  std::string text =
      words([](const PlannedRun& r) { return !r.scene.fluid.solver.pressure; }, "pressure and density");
  text += words([](const PlannedRun& r) { return r.scene.discretisation.cells_along == 1; },
                "variation along the flow (one periodic cell)");
  text +=
      words([](const PlannedRun& r) { return r.scene.fluid.label == "newtonian"; }, "shear rate (Newtonian)");
  return text.empty() ? "nothing" : text.substr(0, text.size() - 2);
}

/// Figures in the order of their numbers, conclusions after them.
int place_in_paper(const reports::ClaimRecord& claim) {
  const std::size_t digit = claim.source.find_first_of("0123456789");
  const int number = digit == std::string::npos ? 0 : std::stoi(claim.source.substr(digit));
  return claim.source.starts_with("Fig") ? number : 1000 + number;
}

class SuiteRunner {
 public:
  SuiteRunner(const std::vector<Study>& studies, std::filesystem::path out, const SuiteListener& listener)
      : studies_(studies), out_(std::move(out)), listener_(listener), jobs_(longest_first(studies)) {
    for (const Study& study : studies) {
      StudyData data;
      data.study = &study;
      data.runs.resize(study.runs.size());
      data_.push_back(std::move(data));
      limits_.emplace_back(study.stability.cases.size());
      remaining_.push_back(study.runs.size() + study.stability.cases.size());
    }
  }

  SuiteOutcome run(int threads) {
    reports::ensure_directory(out_ / "profiles");
    reports::ensure_directory(out_ / "scenes");
    std::vector<std::jthread> pool;
    for (int i = 1; i < threads; ++i) pool.emplace_back([this] { work(); });
    work();
    pool.clear();
    SuiteOutcome outcome{collect(), failures_};
    std::ranges::sort(outcome.failures);
    if (stop_cause_) {
      try {
        reports::write_results(out_, outcome.results);
      } catch (const reports::IoError&) {
        // The first failure is the one to report; what was written before it stays.
      }
      std::rethrow_exception(stop_cause_);
    }
    reports::write_results(out_, outcome.results);
    return outcome;
  }

 private:
  void work() {
    while (!stopped_) {
      const std::size_t next = next_++;
      if (next >= jobs_.size()) return;
      try {
        jobs_[next].measures_limit ? measure(jobs_[next]) : perform(jobs_[next]);
      } catch (...) {
        const std::scoped_lock lock(mutex_);
        if (!stop_cause_) stop_cause_ = std::current_exception();
        stopped_ = true;
      }
    }
  }

  void perform(const Job& job) {
    const Study& study = studies_[job.study];
    const PlannedRun& plan = study.runs[job.run];
    reports::write_file(out_ / "scenes" / (plan.run + ".toml"), plan.scene.toml);
    RunData data = simulate(study, plan);
    reports::write_profile(out_, plan.run, data.profile);
    reports::write_history(out_, plan.run, data.history);
    if (!data.shear.empty()) reports::write_shear(out_, plan.run, data.shear);

    const std::scoped_lock lock(mutex_);
    data_[job.study].runs[job.run] = std::move(data);
    if (listener_.run_ended) listener_.run_ended(++done_, static_cast<long>(jobs_.size()), plan.run);
    if (--remaining_[job.study] == 0) conclude(data_[job.study]);
  }

  /// A case of a [stability].
  void measure(const Job& job) {
    const Study& study = studies_[job.study];
    const StabilityCase& one = study.stability.cases[job.run];
    const std::string run = study.name + "." + one.name();
    const auto begin = std::chrono::steady_clock::now();
    std::vector<reports::StabilityRecord> records;
    std::string failure;
    try {
      records = measure_case(study.name, study.stability, one);
    } catch (const std::exception& error) {
      failure = run + ": " + error.what();
    }
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;

    const std::scoped_lock lock(mutex_);
    if (!failure.empty()) failures_.push_back(failure);
    StudyData& data = data_[job.study];
    limits_[job.study][job.run] = std::move(records);
    data.stability_timings.push_back({run, wall.count(), std::numeric_limits<double>::quiet_NaN()});
    if (listener_.run_ended) listener_.run_ended(++done_, static_cast<long>(jobs_.size()), run);
    if (--remaining_[job.study] > 0) return;
    for (const auto& of_case : limits_[job.study])
      data.stability.insert(data.stability.end(), of_case.begin(), of_case.end());
    std::ranges::sort(data.stability_timings, {}, &reports::TimingRecord::run);
    conclude(data);
  }

  RunData simulate(const Study& study, const PlannedRun& plan) {
    RunData data;
    try {
      data = study.solver_command.empty() ? run_simulation(study, plan) : run_external(study, plan, out_);
    } catch (const reports::IoError&) {
      throw;
    } catch (const std::exception& error) {
      data = failed_run(study, plan, error.what());
      const std::scoped_lock lock(mutex_);
      failures_.push_back(plan.run + ": " + error.what());
    }
    data.errors = measure_errors(data);
    return data;
  }

  void conclude(StudyData& data) {
    measure_orders(data);
    evaluate_checks(data);
    data.matrix = matrix_records(data);
    for (RunData& run : data.runs) {
      run.profile = {};  // on disk by now; a suite would hold gigabytes otherwise
      run.history = {};
      run.shear = {};
    }
    if (listener_.study_ended) listener_.study_ended(data);
  }

  [[nodiscard]] reports::Results collect() const {
    reports::Results results;
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    for (std::size_t s = 0; s < studies_.size(); ++s) {
      if (remaining_[s] > 0) continue;
      const Study& study = studies_[s];
      results.studies.push_back({study.name, study.title, study.claim, name(study.suite), left_out(study)});
      for (const RunData& run : data_[s].runs) {
        results.runs.push_back(run.record);
        results.timings.push_back(run.timing);
        append(results.errors, run.errors);
      }
      append(results.levels, data_[s].levels);
      append(results.orders, data_[s].orders);
      append(results.checks, data_[s].checks);
      append(results.claims, data_[s].claims);
      append(results.matrix, data_[s].matrix);
      append(results.stability, data_[s].stability);
      append(results.timings, data_[s].stability_timings);
      append(results.figures, study.figures);
    }
    std::ranges::stable_sort(results.claims, {}, place_in_paper);
    return results;
  }

  const std::vector<Study>& studies_;
  std::filesystem::path out_;
  const SuiteListener& listener_;
  std::vector<Job> jobs_;
  std::vector<StudyData> data_;
  std::vector<std::vector<std::vector<reports::StabilityRecord>>> limits_;  // by study and case
  std::vector<std::size_t> remaining_;
  std::vector<std::string> failures_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;
  long done_ = 0;
  std::exception_ptr stop_cause_;
};

}  // namespace

SuiteOutcome run_suite(const std::vector<Study>& studies, const std::filesystem::path& out, int jobs,
                       const SuiteListener& listener) {
  return SuiteRunner(studies, out, listener).run(std::max(1, jobs));
}

}  // namespace verification

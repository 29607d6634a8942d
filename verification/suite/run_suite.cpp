#include "verification/suite/run_suite.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <limits>
#include <mutex>
#include <stdexcept>

#include "reports/files/atomic_file.hpp"
#include "reports/files/io_error.hpp"
#include "reports/records/directory/result_files.hpp"
#include "verification/checks/check_reader.hpp"
#include "verification/runs/foreign/run_foreign.hpp"
#include "verification/runs/interruption.hpp"
#include "verification/runs/measures.hpp"
#include "verification/runs/run_simulation.hpp"
#include "verification/runs/scheme_matrix.hpp"
#include "verification/runs/scores.hpp"
#include "verification/runs/settle_locations.hpp"
#include "verification/runs/validate.hpp"
#include "verification/suite/collect.hpp"
#include "verification/suite/run_control.hpp"
#include "verification/suite/run_entry.hpp"
#include "verification/suite/schedule.hpp"
#include "verification/suite/slots.hpp"
#include "verification/suite/steps/settle_steps.hpp"

namespace verification {
namespace {

/// Keeps a part of a suite from passing for the whole.
reports::CheckRecord unfinished(long done, long total) {
  return {"suite",
          "runs that ended",
          static_cast<double>(done),
          static_cast<double>(total),
          static_cast<double>(total),
          "1",
          "fail",
          "the suite was stopped: only the studies that had ended are here; run it again to go on"};
}

class SuiteRunner {
 public:
  SuiteRunner(const std::vector<Study>& studies, const std::filesystem::path& out, RunCache& cache,
              const SuiteListener& listener, Profiles profiles)
      : studies_(studies), out_(out), cache_(cache), listener_(listener), profiles_(studies, out, profiles) {
    for (const Study& study : studies) {
      StudyData data;
      data.study = &study;
      data.runs.resize(study.runs.size());
      data_.push_back(std::move(data));
      limits_.emplace_back(study.stability.cases.size());
      remaining_.push_back(study.runs.size() + study.stability.cases.size() + (study.control ? 1 : 0));
      outcome_.runs += static_cast<long>(remaining_.back());
    }
  }

  SuiteOutcome run(int threads) {
    reports::ensure_directory(out_ / "profiles");
    reports::ensure_directory(out_ / "scenes");
    reports::remove_tables(out_);
    const Schedule jobs = schedule(studies_);
    slots_.set(threads);
    const auto perform_job = [this](const Job& job) {
      switch (job.kind) {
        case Job::Kind::Reference:
          return prepare(job);
        case Job::Kind::Limit:
          return measure(job);
        case Job::Kind::Control:
          return control(job);
        default:
          return perform(job);
      }
    };
    std::exception_ptr stopped = perform_all(jobs.shared, threads, perform_job);
    if (!stopped) stopped = perform_all(jobs.alone, 1, perform_job);

    outcome_.results = collect(ended_studies());
    std::ranges::sort(outcome_.failures);
    if (stopped) {
      outcome_.results.checks.push_back(unfinished(done_, outcome_.runs));
      try {
        reports::write_results(out_, outcome_.results);
      } catch (const reports::IoError&) {
        // The first failure is the one to report; what was written before it stays.
      }
      std::rethrow_exception(stopped);
    }
    reports::write_results(out_, outcome_.results);
    return outcome_;
  }

 private:
  /// Computes the reference of a run, unless that is kept: then those that need the same are, as a rule, and
  /// one that is not computes it for itself.
  void prepare(const Job& job) {
    throw_if_interrupted();
    const Study& study = studies_[job.study];
    const PlannedRun& plan = study.runs[job.run];
    if (cache_.load(study, plan)) return;
    try {
      static_cast<void>(plan.scene.flow->exact(plan.scene.reference_times()));  // the store keeps it
    } catch (const std::exception&) {
      // The runs that need it will say so, each under its name.
    }
  }

  void perform(const Job& job) {
    throw_if_interrupted();
    const Study& study = studies_[job.study];
    const PlannedRun& plan = study.runs[job.run];
    const Slots::Hold hold(slots_, plan.solver ? plan.solver->cores : 1);
    reports::keep_file(out_ / "scenes" / (plan.run + ".toml"), plan.scene_text());
    std::optional<RunData> kept = cache_.load(study, plan);
    RunData data = kept ? std::move(*kept) : simulate(study, plan);
    const bool from_cache = data.timing.source == reports::timing_from_cache;
    data.errors = measure_errors(data);
    profiles_.write(data);

    std::unique_lock lock(mutex_);
    data_[job.study].runs[job.run] = std::move(data);
    if (!count(job, plan.run, from_cache)) return;
    lock.unlock();
    conclude(data_[job.study]);
  }

  /// A case of a [stability].
  void measure(const Job& job) {
    throw_if_interrupted();
    const Study& study = studies_[job.study];
    const StabilityCase& one = study.stability.cases[job.run];
    reports::TimingRecord timing;
    timing.run = study.name + "." + one.name();
    timing.particle_steps_per_s = std::numeric_limits<double>::quiet_NaN();
    const auto kept = cache_.load(study.stability.content(one));
    std::optional<MeasuredLimits> limits = kept ? decode_limits(*kept, study.name) : std::nullopt;
    const bool from_cache = limits.has_value();
    if (from_cache)
      timing.source = reports::timing_from_cache;
    else
      limits = limits_of(study, one, timing.run);
    timing.wall_s = limits->wall_s;

    std::unique_lock lock(mutex_);
    StudyData& data = data_[job.study];
    limits_[job.study][job.run] = std::move(limits->records);
    data.stability_timings.push_back(timing);
    if (!count(job, timing.run, from_cache)) return;
    lock.unlock();
    for (const auto& of_case : limits_[job.study])
      data.stability.insert(data.stability.end(), of_case.begin(), of_case.end());
    std::ranges::sort(data.stability_timings, {}, &reports::TimingRecord::run);
    conclude(data);
  }

  void control(const Job& job) {
    throw_if_interrupted();
    const Study& study = studies_[job.study];
    ControlOutcome outcome = run_control(study, out_);
    reports::TimingRecord timing;
    timing.run = study.name;
    timing.wall_s = outcome.wall_s;
    timing.particle_steps_per_s = std::numeric_limits<double>::quiet_NaN();

    std::unique_lock lock(mutex_);
    StudyData& data = data_[job.study];
    data.checks = std::move(outcome.checks);
    data.controls = {std::move(outcome.record)};
    data.stability_timings = {timing};
    if (!count(job, study.name, false)) return;
    lock.unlock();
    conclude(data);
  }

  /// Notes, under the lock, that a job has ended. True when it was the last of its study.
  bool count(const Job& job, const std::string& name, bool from_cache) {
    outcome_.from_cache += from_cache;
    ++done_;
    if (listener_.run_ended) listener_.run_ended(done_, outcome_.runs, name);
    return --remaining_[job.study] == 0;
  }

  MeasuredLimits limits_of(const Study& study, const StabilityCase& one, const std::string& run) {
    const auto begin = std::chrono::steady_clock::now();
    try {
      if (!cache_.may_run())
        throw std::runtime_error("is not among the finished runs, and nothing may be run here");
      MeasuredLimits limits{measure_case(study.name, study.stability, one), 0};
      limits.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      cache_.save(study.stability.content(one), encode_limits(limits));
      return limits;
    } catch (const std::exception& error) {
      const std::scoped_lock lock(mutex_);
      outcome_.failures.push_back(run + ": " + error.what());
      return {};
    }
  }

  RunData simulate(const Study& study, const PlannedRun& plan) {
    try {
      if (!cache_.may_run() && !plan.solver)
        throw std::runtime_error("is not among the finished runs, and nothing may be run here");
      RunData data =
          plan.solver ? run_foreign(study, plan, out_, cache_.deliveries()) : run_simulation(study, plan);
      cache_.save(study, data);
      return data;
    } catch (const reports::IoError&) {
      throw;
    } catch (const Interrupted&) {
      throw;
    } catch (const std::exception& error) {
      std::string why = error.what();
      if (!cache_.may_run()) why = cache_.failure(study, plan).value_or(why);
      const std::scoped_lock lock(mutex_);
      outcome_.failures.push_back(plan.run + ": " + why);
      return failed_run(study, plan, why);
    }
  }

  /// Without the lock: nobody else works on a study whose jobs have all ended.
  void conclude(StudyData& data) {
    settle_locations(data);
    compare_with_finest(data);
    measure_orders(data);
    evaluate_checks(data);
    data.matrix = matrix_records(data);
    data.scores = score_records(data);
    validate(data);
    require_all_checks(data);
    for (reports::CheckRecord& check : unsettled_steps(*data.study)) data.checks.push_back(std::move(check));
    const bool failed =
        std::ranges::any_of(data.checks, [](const auto& check) { return check.verdict != "pass"; });
    for (RunData& run : data.runs) {
      if (failed) profiles_.write_all(run);
      run.profile = {};  // on disk by now; a suite would hold gigabytes otherwise
      run.history = {};
      run.shear = {};
      run.state = {};
      run.surface = {};
      run.start = {};
    }
    const std::scoped_lock lock(mutex_);
    if (listener_.study_ended) listener_.study_ended(data);
  }

  [[nodiscard]] std::vector<const StudyData*> ended_studies() const {
    std::vector<const StudyData*> ended;
    for (std::size_t s = 0; s < data_.size(); ++s)
      if (remaining_[s] == 0) ended.push_back(&data_[s]);
    return ended;
  }

  const std::vector<Study>& studies_;
  std::filesystem::path out_;
  RunCache& cache_;
  const SuiteListener& listener_;
  KeptProfiles profiles_;
  Slots slots_;
  std::vector<StudyData> data_;
  std::vector<std::vector<std::vector<reports::StabilityRecord>>> limits_;  // by study and case
  std::vector<std::size_t> remaining_;
  SuiteOutcome outcome_;
  std::mutex mutex_;
  long done_ = 0;
};

}  // namespace

SuiteOutcome run_suite(const std::vector<Study>& studies, const std::filesystem::path& out, int jobs,
                       RunCache& cache, const SuiteListener& listener, Profiles profiles) {
  return SuiteRunner(studies, out, cache, listener, profiles).run(std::max(1, jobs));
}

}  // namespace verification

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "reports/files/atomic_file.hpp"
#include "reports/files/io_error.hpp"
#include "reports/process/child.hpp"
#include "reports/records/directory/result_directory.hpp"
#include "verification/commands/elsewhere/shard_commands.hpp"
#include "verification/commands/elsewhere/slurm.hpp"
#include "verification/commands/output.hpp"
#include "verification/commands/provenance_of.hpp"
#include "verification/config/config_error.hpp"
#include "verification/runs/interruption.hpp"

namespace verification {
namespace {

namespace fs = std::filesystem;

/// One suite on its way through Slurm. All that it knows is in files of `out`: manifest.json, the shards'
/// shard.json, and in slurm/ the scripts, logs, the numbers of the jobs and the exit code of the last.
class Submission {
 public:
  explicit Submission(const SubmitOptions& options)
      : options_(options),
        out_(fs::absolute(options.out)),
        folder_(out_ / "slurm"),
        slurm_(folder_ / "slurm.log") {
    reports::ensure_directory(folder_);
    reports::ensure_directory(out_ / "shards");
    manifest_ = plan();
    write_scripts();
  }

  void show() const {
    for (const char* name : {"chunk.sh", "collect.sh"})
      say("# {}\n{}\n", (folder_ / name).string(), reports::read_file(folder_ / name));
    say("sbatch {}\n", fmt::join(chunk_arguments(unfinished()), " "));
    say("sbatch {}\n", fmt::join(collect_arguments("ARRAY"), " "));
  }

  int submit_and_follow() {
    for (int round = 0;; ++round) {
      if (!go_on_with_jobs()) {
        const std::vector<int> tasks = unfinished();
        if (round > options_.retries) return give_up(tasks);
        submit(tasks, round);
      }
      if (options_.detach) {
        say("jobs {} and {} are in the queue; the same command without --detach follows them\n", chunks_,
            collect_);
        return 0;
      }
      follow();
      if (const auto code = collected()) return report(*code);
    }
  }

 private:
  [[nodiscard]] Manifest plan() const {
    PlanOptions plan;
    plan.studies = options_.studies;
    plan.names = options_.names;
    plan.suite = options_.suite;
    plan.shards = options_.shards;
    plan.out = out_;
    plan.command_line = options_.command_line;
    std::string before;
    if (fs::exists(out_ / "manifest.json")) before = reports::read_file(out_ / "manifest.json");
    Manifest made = write_plan(plan);
    if (!before.empty() && before != reports::read_file(out_ / "manifest.json")) {
      // Other studies, shards or program: nothing that is there belongs to it.
      for (const char* stale : {"shards", "results"}) fs::remove_all(out_ / stale);
      for (const char* stale : {"jobs", "collect.code"}) fs::remove(folder_ / stale);
      reports::ensure_directory(out_ / "shards");
    }
    return made;
  }

  void write_scripts() const {
    std::error_code error;
    const std::string program = shell_word(fs::read_symlink("/proc/self/exe", error).string());
    std::string suite;
    for (const std::string& name : manifest_.suite.names) suite += " " + shell_word(name);
    if (!manifest_.suite.suite.empty()) suite += " --suite " + manifest_.suite.suite;
    const std::string shards = shell_word((out_ / "shards").string());
    reports::write_file(
        folder_ / "chunk.sh",
        fmt::format("#!/bin/sh\n{} run{} --studies {} --shard \"$SLURM_ARRAY_TASK_ID/{}\" \\\n"
                    "  --out {}/\"$SLURM_ARRAY_TASK_ID\" --jobs {}\ncode=$?\n"
                    "# 3: a run that could not be simulated. It is noted, and the verdict will say so.\n"
                    "[ $code -eq 3 ] && exit 0\nexit $code\n",
                    program, suite, shell_word(manifest_.suite.studies.string()), manifest_.shards, shards,
                    options_.jobs));
    reports::write_file(folder_ / "collect.sh",
                        fmt::format("#!/bin/sh\n{} collect {} --out {} --jobs {}\ncode=$?\n"
                                    "echo $code > {}.new && mv {}.new {}\nexit $code\n",
                                    program, shards, shell_word((out_ / "results").string()), options_.jobs,
                                    code_word(), code_word(), code_word()));
  }

  [[nodiscard]] std::string code_word() const { return shell_word((folder_ / "collect.code").string()); }

  [[nodiscard]] std::vector<std::string> common_arguments(const char* name) const {
    std::vector<std::string> arguments{fmt::format("--job-name=mpm-verify-{}", name),
                                       fmt::format("--cpus-per-task={}", options_.jobs), "--requeue",
                                       "--chdir=" + out_.string()};
    if (!options_.partition.empty()) arguments.push_back("--partition=" + options_.partition);
    if (!options_.time_limit.empty()) arguments.push_back("--time=" + options_.time_limit);
    for (const std::string& word : reports::split_command(options_.resources)) arguments.push_back(word);
    return arguments;
  }

  [[nodiscard]] std::vector<std::string> chunk_arguments(const std::vector<int>& tasks) const {
    std::vector<std::string> arguments = common_arguments("chunks");
    arguments.push_back("--array=" + array_of(tasks));
    arguments.push_back("--output=" + (folder_ / "chunk-%a.log").string());
    arguments.push_back((folder_ / "chunk.sh").string());
    return arguments;
  }

  [[nodiscard]] std::vector<std::string> collect_arguments(const std::string& after) const {
    std::vector<std::string> arguments = common_arguments("collect");
    if (!after.empty()) arguments.push_back("--dependency=afterok:" + after);
    arguments.push_back("--output=" + (folder_ / "collect.log").string());
    arguments.push_back((folder_ / "collect.sh").string());
    return arguments;
  }

  [[nodiscard]] std::vector<int> unfinished() const {
    std::vector<int> tasks;
    for (int k = 1; k <= manifest_.shards; ++k)
      if (!is_complete(out_ / "shards" / std::to_string(k))) tasks.push_back(k);
    return tasks;
  }

  /// Jobs that an earlier call submitted and that are still in the queue.
  bool go_on_with_jobs() {
    std::string text;
    try {
      text = reports::read_file(folder_ / "jobs");
    } catch (const reports::IoError&) {
      return false;
    }
    const std::size_t blank = text.find(' ');
    chunks_ = text.substr(0, blank);
    collect_ = blank == text.npos ? "" : text.substr(blank + 1, text.find('\n') - blank - 1);
    if (slurm_.states(collect_).empty()) return false;
    say("following jobs {} and {}, which are in the queue\n", chunks_, collect_);
    return true;
  }

  void submit(const std::vector<int>& tasks, int round) {
    std::error_code ignored;
    fs::remove(folder_ / "collect.code", ignored);
    chunks_ = tasks.empty() ? "" : slurm_.submit(chunk_arguments(tasks));
    collect_ = slurm_.submit(collect_arguments(chunks_));
    reports::write_file(folder_ / "jobs", chunks_ + " " + collect_ + "\n");
    if (!tasks.empty())
      say("{}: job {}, tasks {} of {}\n", round == 0 ? "submitted" : "submitted again", chunks_,
          array_of(tasks), manifest_.shards);
    say("collected by: job {}\n", collect_);
    std::fflush(stdout);
  }

  void wait() const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(options_.poll);
    while (std::chrono::steady_clock::now() < end) {
      throw_if_interrupted();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }

  /// Until both jobs have left the queue. A collecting job whose array did not end well waits for ever: it is
  /// taken out.
  void follow() {
    std::size_t told = static_cast<std::size_t>(-1);
    const auto tell = [&] {
      const std::size_t left = unfinished().size();
      if (left != told)
        say("{} of {} shards are complete\n", static_cast<std::size_t>(manifest_.shards) - left,
            manifest_.shards);
      std::fflush(stdout);
      told = left;
    };
    while (!chunks_.empty() && !slurm_.states(chunks_).empty()) {
      tell();
      wait();
    }
    tell();
    if (!unfinished().empty()) return slurm_.cancel(collect_);
    while (!collected() && !slurm_.states(collect_).empty()) wait();
  }

  /// Exit code of the collecting job, once it has ended.
  [[nodiscard]] std::optional<int> collected() const {
    try {
      return std::stoi(reports::read_file(folder_ / "collect.code"));
    } catch (const reports::IoError&) {
      return std::nullopt;
    }
  }

  [[nodiscard]] int report(int code) const {
    constexpr std::size_t verdict_lines = 3;
    say("{}\n", reports::last_lines(folder_ / "collect.log", verdict_lines));
    return code;
  }

  [[nodiscard]] int give_up(const std::vector<int>& tasks) const {
    if (tasks.empty()) {
      warn("mpm-verify: the collecting job did not end; its log: {}\n", (folder_ / "collect.log").string());
      return 3;
    }
    warn("mpm-verify: tasks {} did not end in {} attempts; their logs: {}\n", array_of(tasks),
         options_.retries + 1, (folder_ / "chunk-TASK.log").string());
    return 3;
  }

  const SubmitOptions& options_;
  fs::path out_, folder_;
  Slurm slurm_;
  Manifest manifest_;
  std::string chunks_, collect_;
};

}  // namespace

int submit_command(const SubmitOptions& options) {
  const InterruptionGuard guard;
  const reports::ResultDirectory ours(options.out);
  reports::write_provenance(options.out, provenance_of(options.command_line));
  Submission submission(options);
  if (options.dry_run) {
    submission.show();
    return 0;
  }
  try {
    return submission.submit_and_follow();
  } catch (const Interrupted& stop) {
    warn("mpm-verify: interrupted; what was submitted goes on, and the same command follows it\n");
    return 128 + stop.signal;
  }
}

}  // namespace verification

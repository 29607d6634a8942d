#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verification/suite/shards/manifest.hpp"

// Verbs for runs elsewhere: docs/cluster.md. Exit codes and mistakes as in commands.hpp.
namespace verification {

struct PlanOptions {
  std::filesystem::path studies;
  std::vector<std::string> names;
  std::string suite, shards;  ///< shards: "", "auto" or a number
  std::filesystem::path out;
  bool force = false;
  std::string command_line;
};
/// Writes the scenes of every run and manifest.json.
int plan_command(const PlanOptions& options);
/// The same without a word.
Manifest write_plan(const PlanOptions& options);

struct JudgeOptions {
  std::filesystem::path dir;  ///< that plan_command() wrote, with results/RUN put into it
  std::filesystem::path out;  ///< "": dir/verdict
  int jobs = 0;
  bool pdf = false;
  std::string command_line;
};
/// The verdict from the results that lie in a plan: nothing is run.
int judge_command(const JudgeOptions& options);

struct CollectOptions {
  std::vector<std::filesystem::path> dirs;
  std::filesystem::path out = "results", studies;
  int jobs = 0;
  bool force = false, pdf = false, keep_profiles = false;
  std::string command_line;
};
/// One result directory from the shards of a suite, as one run of it would have made; nothing is simulated.
int collect_command(const CollectOptions& options);

struct SubmitOptions {
  std::filesystem::path studies;
  std::vector<std::string> names;
  std::string suite, shards = "auto", engine = "slurm";
  std::filesystem::path out;
  int jobs = 1;            ///< cores of a task
  int retries = 2;         ///< times that what failed or was lost is submitted again
  double poll = 10;        ///< seconds between questions to the queue
  std::string partition;   ///< "": the cluster's own
  std::string time_limit;  ///< of a task, as sbatch takes it; "": the cluster's own
  std::string resources;   ///< further arguments of sbatch
  bool dry_run = false;    ///< write the scripts, submit nothing
  bool detach = false;     ///< do not follow
  std::string command_line;
};
/// Runs a suite as an array of jobs, follows it, submits again what failed or was lost, and collects.
int submit_command(const SubmitOptions& options);

}  // namespace verification

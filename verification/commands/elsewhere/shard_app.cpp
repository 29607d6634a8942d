#include "verification/commands/elsewhere/shard_app.hpp"

namespace verification {
namespace {

constexpr const char* names_help = "Names of studies or paths of study files (default: the whole suite)";
constexpr const char* suite_help = "quick, full, deep or peers (default: full, or all that is named)";

}  // namespace

ShardApp::ShardApp(CLI::App& app, std::string& studies, const char* studies_help) {
  plan_app_ = app.add_subcommand(
      "plan", "Write the scene of every run, and a manifest, for whoever runs them elsewhere");
  plan_app_->add_option("STUDY", plan_.names, names_help);
  plan_app_->add_option("--suite", plan_.suite, suite_help);
  plan_app_->add_option("--out", plan_.out, "Directory of the plan")->required();
  plan_app_->add_option("--shards", plan_.shards,
                        "Say which of N parts a run belongs to; auto: parts of about a minute");
  plan_app_->add_option("--studies", studies, studies_help);
  plan_app_->add_flag("--force", plan_.force, "Write into --out even if it holds files of others");

  judge_app_ = app.add_subcommand(
      "judge", "The verdict from results that were put into a plan, results/RUN/profile.csv: nothing is run");
  judge_app_->add_option("DIR", judge_.dir, "Directory that `plan` wrote")->required();
  judge_app_->add_option("--out", judge_.out, "Directory of the report (default: DIR/verdict)");
  judge_app_->add_option("--jobs", judge_.jobs, "Runs judged at the same time")->check(CLI::Range(1, 1024));
  judge_app_->add_flag("--pdf", judge_.pdf, "Print report.pdf too");

  collect_app_ = app.add_subcommand(
      "collect",
      "One result directory from shards (`run --shard K/N`), with the same bytes as one run of the suite. "
      "Nothing is simulated: exit code 2, and the runs that are missing, if there are any");
  collect_app_->add_option("DIR", collect_.dirs, "Shards, or directories that hold them")->required();
  collect_app_->add_option("--out", collect_.out, "Directory of the results")->capture_default_str();
  collect_app_->add_option("--jobs", collect_.jobs, "Runs judged at the same time")
      ->check(CLI::Range(1, 1024));
  collect_app_->add_option("--studies", collect_.studies, "Directory of the studies, if it is another here");
  collect_app_->add_flag("--force", collect_.force, "Write into --out even if it holds files of others");
  collect_app_->add_flag("--pdf", collect_.pdf, "Print report.pdf too");
  collect_app_->add_flag("--keep-profiles", collect_.keep_profiles, "Keep the profiles of every run");

  submit_app_ = app.add_subcommand("submit",
                                   "Run a suite on a cluster: an array of jobs, one a shard, and one that "
                                   "collects them; what failed or was "
                                   "lost is submitted again. The same command goes on with what is there");
  submit_app_->add_option("STUDY", submit_.names, names_help);
  submit_app_->add_option("--suite", submit_.suite, suite_help);
  submit_app_->add_option("--engine", submit_.engine, "Batch system")
      ->check(CLI::IsMember({"slurm"}))
      ->capture_default_str();
  submit_app_->add_option("--out", submit_.out, "Directory that all nodes see")->required();
  submit_app_->add_option("--shards", submit_.shards, "Tasks of the array; auto: of about a minute")
      ->capture_default_str();
  submit_app_->add_option("--jobs", submit_.jobs, "Cores of a task")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  submit_app_->add_option("--retries", submit_.retries, "Times that what failed or was lost is run again")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
  submit_app_->add_option("--poll", submit_.poll, "Seconds between questions to the queue")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  submit_app_->add_option("--partition", submit_.partition, "Partition (default: the cluster's)");
  submit_app_->add_option("--time", submit_.time_limit, "Time limit of a task, as sbatch takes it");
  submit_app_->add_option("--sbatch", submit_.resources, "Further arguments of sbatch, in quotes");
  submit_app_->add_option("--studies", studies, studies_help);
  submit_app_->add_flag("--dry-run", submit_.dry_run, "Write and print the scripts, submit nothing");
  new_app_ = app.add_subcommand("new", "Write a study, or a solver with a study of it, that run as they are");
  new_app_->add_option("WHAT", new_.what, "study or solver")
      ->required()
      ->check(CLI::IsMember({"study", "solver"}));
  new_app_->add_option("NAME", new_.name, "Its name")->required();
  new_app_->add_option("--language", new_.language, "Of a solver")
      ->check(CLI::IsMember({"sh", "python", "cpp"}))
      ->capture_default_str();

  submit_app_->add_flag("--detach", submit_.detach, "Submit and return; the same command follows later");
}

std::optional<int> ShardApp::run(const std::filesystem::path& studies, const std::string& command_line) {
  plan_.studies = submit_.studies = new_.studies = studies;
  plan_.command_line = judge_.command_line = collect_.command_line = submit_.command_line = command_line;
  if (*plan_app_) return plan_command(plan_);
  if (*judge_app_) return judge_command(judge_);
  if (*collect_app_) return collect_command(collect_);
  if (*submit_app_) return submit_command(submit_);
  if (*new_app_) return new_command(new_);
  return std::nullopt;
}

}  // namespace verification

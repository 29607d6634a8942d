#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace verification {

/// What is asked of Slurm, by its own commands (sbatch, squeue, scancel). States come from the queue and from
/// files, not from accounting, which a cluster may not have. Throws ConfigError when a command is not there
/// or refuses.
class Slurm {
 public:
  /// `log`: where the output of the commands goes.
  explicit Slurm(std::filesystem::path log) : log_(std::move(log)) {}

  /// Submits a script; the number of the job.
  [[nodiscard]] std::string submit(const std::vector<std::string>& arguments) const;
  /// Tasks or jobs of this number that are in the queue, by state ("RUNNING"); empty when there are none.
  [[nodiscard]] std::map<std::string, int> states(const std::string& job) const;
  /// Takes a job out of the queue, if it is there.
  void cancel(const std::string& job) const;

 private:
  std::filesystem::path log_;
};

/// "1-3,7" from 1, 2, 3, 7.
std::string array_of(const std::vector<int>& tasks);

/// A word as a shell takes it for itself.
std::string shell_word(const std::string& word);

}  // namespace verification

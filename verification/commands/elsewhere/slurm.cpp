#include "verification/commands/elsewhere/slurm.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "reports/files/atomic_file.hpp"
#include "reports/process/child.hpp"
#include "verification/config/config_error.hpp"
#include "verification/runs/interruption.hpp"

namespace verification {
namespace {

struct Said {
  reports::ChildEnd end;
  std::string output;
};

Said ask(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  reports::ChildCommand command;
  command.arguments = arguments;
  command.log = log;
  command.stop = interruption_noted;
  Said said{reports::run_child(command), ""};
  throw_if_interrupted();
  if (!said.end.error.empty())
    throw ConfigError(arguments.front() + ": " + said.end.error +
                      "; submit from a machine that has Slurm's commands (Debian: slurm-client)");
  said.output = reports::read_file(log);
  return said;
}

}  // namespace

std::string Slurm::submit(const std::vector<std::string>& arguments) const {
  std::vector<std::string> command{"sbatch", "--parsable"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const Said said = ask(command, log_);
  // "JOB" or "JOB;CLUSTER", after warnings perhaps.
  std::istringstream lines(said.output);
  std::string job;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line.find_first_not_of("0123456789") >= std::min(line.size(), line.find(';')))
      job = line.substr(0, line.find(';'));
  if (!said.end.well() || job.empty())
    throw ConfigError("sbatch: " + said.end.text() + ": " + reports::last_lines(log_, 3));
  return job;
}

std::map<std::string, int> Slurm::states(const std::string& job) const {
  const Said said = ask({"squeue", "--noheader", "--array", "--jobs", job, "--format", "%T"}, log_);
  std::map<std::string, int> found;
  if (!said.end.well()) {
    // A job that ended a while ago is unknown to it. Anything else is passing: ask again.
    if (said.output.find("Invalid job id") == std::string::npos) found["UNKNOWN"] = 1;
    return found;
  }
  std::istringstream lines(said.output);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) ++found[line];
  return found;
}

void Slurm::cancel(const std::string& job) const {
  static_cast<void>(ask({"scancel", job}, log_));
}

std::string array_of(const std::vector<int>& tasks) {
  std::string text;
  for (std::size_t i = 0; i < tasks.size();) {
    std::size_t last = i;
    while (last + 1 < tasks.size() && tasks[last + 1] == tasks[last] + 1) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ",", tasks[i]);
    if (last > i) text += fmt::format("-{}", tasks[last]);
    i = last + 1;
  }
  return text;
}

std::string shell_word(const std::string& word) {
  if (!word.empty() && word.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
                                              "_-+=./:,@%") == std::string::npos)
    return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace verification

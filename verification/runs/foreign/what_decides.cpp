#include "verification/runs/foreign/what_decides.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "reports/files/atomic_file.hpp"
#include "reports/files/content_hash.hpp"
#include "reports/files/program.hpp"
#include "reports/process/child.hpp"
#include "verification/runs/interruption.hpp"

namespace verification {
namespace {

namespace fs = std::filesystem;

/// A name for the content of a file, or of all files of a directory in the order of their names.
std::string content_of(const fs::path& path) {
  static std::mutex mutex;
  static std::map<std::string, std::string> known;  // by path, size and time: runs of a study share inputs
  if (fs::is_directory(path)) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(path))
      if (entry.is_regular_file()) files.push_back(entry.path());
    std::ranges::sort(files);
    std::string all;
    for (const fs::path& file : files)
      all += file.lexically_relative(path).string() + " " + content_of(file) + "\n";
    return reports::content_name(all);
  }
  std::error_code error;
  const std::string key = fmt::format("{} {} {}", path.string(), fs::file_size(path, error),
                                      fs::last_write_time(path, error).time_since_epoch().count());
  {
    const std::scoped_lock lock(mutex);
    if (const auto found = known.find(key); found != known.end()) return found->second;
  }
  const std::string name = reports::content_name(reports::read_file(path));
  const std::scoped_lock lock(mutex);
  return known[key] = name;
}

/// The file that a word of a command names, if any.
fs::path file_named(const std::string& word, const ForeignSolver& solver, bool is_program) {
  std::error_code error;
  if (word == "{mpm-verify}") return fs::read_symlink("/proc/self/exe", error);
  if (is_program && word.find('/') == word.npos) return reports::find_program(word);
  const fs::path path = solver.directory / word;
  return fs::is_regular_file(path, error) ? path : fs::path();
}

}  // namespace

std::string version_of(const ForeignSolver& solver) {
  if (solver.version_command.empty()) return "";
  static std::mutex mutex;
  static std::map<std::string, std::string> known;
  const std::string key =
      fmt::format("{}\n{}", solver.directory.string(), fmt::join(solver.version_command, "\n"));
  const std::scoped_lock lock(mutex);  // also so that the command runs once
  if (const auto found = known.find(key); found != known.end()) return found->second;
  reports::ChildCommand command;
  command.arguments = solver.version_command;
  command.directory = solver.directory;
  command.environment = solver.environment;
  command.log =
      fs::temp_directory_path() / fmt::format("mpm-verify-{}-{}.txt", getpid(), reports::content_name(key));
  command.stop = interruption_noted;
  const reports::ChildEnd end = reports::run_child(command);
  const std::string last = reports::last_lines(command.log, 3);
  std::ifstream log(command.log);
  std::stringstream in;
  in << log.rdbuf();
  std::error_code ignored;
  fs::remove(command.log, ignored);
  throw_if_interrupted();
  if (!end.well())
    throw std::runtime_error(fmt::format("{}: the command of solver.version: {}{}{}", solver.name, end.text(),
                                         last.empty() ? "" : "; it said: ", last));
  std::string line;
  while (std::getline(in, line)) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == line.npos) continue;
    line = line.substr(begin, line.find_last_not_of(" \t\r") - begin + 1);
    return known[key] = line;
  }
  throw std::runtime_error(solver.name + ": the command of solver.version printed nothing");
}

std::string what_decides(const PlannedRun& plan, const std::string& version) {
  const ForeignSolver& solver = *plan.solver;
  if (!solver.remembered) return "";
  std::string text = fmt::format("scene\n{}\n", plan.handed);
  for (std::size_t i = 0; i < solver.command.size(); ++i) {
    const std::string& word = solver.command[i];
    text += "word " + word + "\n";
    if (word.find("{run}") != word.npos) text += "run " + plan.run + "\n";
    if (const fs::path file = file_named(word, solver, i == 0); !file.empty())
      text += "content " + content_of(file) + "\n";
  }
  for (const auto& [key, value] : solver.environment) text += fmt::format("environment {}={}\n", key, value);
  for (const fs::path& input : solver.inputs)
    text +=
        fmt::format("input {} {}\n", input.lexically_relative(solver.directory).string(), content_of(input));
  text += fmt::format("version {}\ncores {}\n", version, solver.cores);
  for (const Record record : solver.delivers) text += "delivers " + name(record) + "\n";
  return text;
}

}  // namespace verification

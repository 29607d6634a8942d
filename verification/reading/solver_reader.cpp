#include "verification/reading/solver_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "reports/figures/figures.hpp"
#include "reports/process/child.hpp"
#include "verification/checks/check_reader.hpp"
#include "verification/reading/figure_reader.hpp"
#include "verification/runs/foreign/delivered_files.hpp"
#include "verification/scene/handed_scene.hpp"

namespace verification {
namespace {

std::vector<std::string> read_command(TomlTable& table, const std::string& key) {
  std::vector<std::string> command;
  if (table.is_text(key)) {
    try {
      command = reports::split_command(table.text(key));
    } catch (const std::invalid_argument& error) {
      table.fail(key, error.what());
    }
  } else {
    command = table.texts(key);
  }
  if (command.empty() || command.front().empty())
    table.fail(key, "is empty: name the program that runs a scene, or remove [solver] for the built-in one");
  return command;
}

constexpr const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
constexpr const char* letters_and_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";

/// Refuses what looks like a placeholder, {name} with a letter first, and is none of those that are known.
/// Other braces are somebody else's, such as those of a shell.
void require_placeholders(const TomlTable& table, const std::string& key, const std::string& word,
                          const std::vector<std::string>& known) {
  for (std::size_t begin = word.find('{'); begin != std::string::npos; begin = word.find('{', begin + 1)) {
    const std::size_t end = word.find_first_not_of(letters_and_digits, begin + 1);
    if (end == std::string::npos || word[end] != '}') continue;
    if (word.find_first_of(letters, begin + 1) != begin + 1) continue;
    const std::string found = word.substr(begin, end + 1 - begin);
    if (std::ranges::count(known, found) == 0)
      table.fail(key, fmt::format("'{}' is no placeholder; there are {}", found, fmt::join(known, " ")));
  }
}

/// What runs a scene, or where its results lie already.
void read_source(TomlTable& table, ForeignSolver& solver) {
  if (table.has("results")) {
    if (table.has("command"))
      table.fail("results", "cannot stand beside command: either something is run, or it is there already");
    solver.results = table.text("results");
    require_placeholders(table, "results", solver.results, {"{run}"});
    if (solver.results.empty())
      table.fail("results", "is empty: name the directory of a run, e.g. \"theirs/{run}\"");
    return;
  }
  solver.command = read_command(table, "command");
  for (const std::string& word : solver.command)
    require_placeholders(table, "command", word, ForeignSolver::placeholders());
}

/// What decides its results besides the scene and the command.
void read_what_decides(TomlTable& table, ForeignSolver& solver) {
  if (table.has("version")) {
    solver.version_command = read_command(table, "version");
    for (const std::string& word : solver.version_command) require_placeholders(table, "version", word, {});
    solver.remembered = true;
  }
  if (table.has("inputs")) {
    for (const std::string& word : table.texts("inputs")) {
      solver.inputs.push_back(solver.directory / word);
      if (!std::filesystem::exists(solver.inputs.back()))
        table.fail("inputs", "'" + solver.inputs.back().string() + "' is not there");
    }
    solver.remembered = true;
  }
  TomlTable options = table.table("options");
  if (table.has("options")) {
    solver.options = options.print_as("solver.options");
  }
}

std::vector<Record> read_delivers(TomlTable& table) {
  std::vector<Record> records{Record::Profile};
  if (!table.has("delivers")) return records;
  records.clear();
  for (const std::string& word : table.texts("delivers")) {
    const auto known = {Record::Profile, Record::History, Record::Shear, Record::State};
    const auto found = std::ranges::find(known, word, [](Record record) { return name(record); });
    if (found == known.end())
      table.fail("delivers",
                 "may hold \"profile\", \"history\", \"shear\" and \"state\", not \"" + word + "\"");
    records.push_back(*found);
  }
  if (std::ranges::count(records, Record::Profile) == 0)
    table.fail("delivers", "must hold \"profile\": there is nothing to judge without one");
  return records;
}

/// Where results are there already, what the first of them holds; else empty.
std::vector<std::string> delivered_locations(const ForeignSolver& solver) {
  const std::size_t mark = solver.results.find("{run}");
  if (mark != solver.results.npos) {
    std::error_code error;
    const std::filesystem::path parent = solver.results.substr(0, solver.results.rfind('/', mark));
    for (const auto& entry : std::filesystem::recursive_directory_iterator(parent, error)) {
      if (entry.path().filename() != "profile.csv") continue;
      std::vector<std::string> words;
      for (const Location location : locations_in(entry.path())) words.push_back(name(location));
      if (!words.empty()) return words;
    }
  }
  return {};
}

}  // namespace

ForeignSolver read_solver(TomlTable table, const std::filesystem::path& study_file) {
  ForeignSolver solver;
  read_source(table, solver);
  solver.is_named = table.has("name");
  solver.name = table.text("name", solver.is_there()
                                       ? std::filesystem::path(solver.results).begin()->string()
                                       : std::filesystem::path(solver.command.front()).filename().string());
  if (solver.name.empty()) table.fail("name", "is empty: it stands in every table and legend");
  const std::filesystem::path folder = std::filesystem::absolute(study_file).parent_path();
  solver.directory = folder / table.text("working_directory", ".");
  if (!std::filesystem::is_directory(solver.directory))
    table.fail("working_directory", "'" + solver.directory.string() + "' is no directory");
  if (solver.is_there()) solver.results = (solver.directory / solver.results).string();
  read_what_decides(table, solver);
  solver.cores = table.integer("cores", 1);
  if (solver.cores < 1) table.fail("cores", "must be at least 1");
  TomlTable environment = table.table("environment");
  for (const std::string& key : environment.keys()) solver.environment[key] = environment.text(key);
  solver.timeout = table.positive("timeout", solver.timeout);
  solver.delivers = read_delivers(table);
  std::vector<std::string> words =
      table.has("locations") ? table.texts("locations") : delivered_locations(solver);
  solver.locations_known = table.has("locations") || !words.empty();
  if (!solver.locations_known) words = {"grid", "particles"};
  for (const std::string& word : words) {
    if (word != "grid" && word != "particles") table.fail("locations", "may hold \"grid\" and \"particles\"");
    solver.locations.push_back(word == "grid" ? Location::Grid : Location::Particles);
  }
  if (solver.locations.empty()) table.fail("locations", "is empty: name what the profile holds");
  if (table.has("points_across")) {
    solver.points_across = table.integer("points_across");
    if (solver.points_across < 1) table.fail("points_across", "must be at least 1");
    solver.points_reason = table.text("points_reason");
    if (solver.points_reason.find_first_not_of(" \t\n") == std::string::npos)
      table.fail("points_reason", "must say why other than cells across will do");
  }
  table.refuse_unknown_keys();
  return solver;
}

void give_to(PlannedRun& planned, const std::shared_ptr<const ForeignSolver>& solver,
             const TomlTable& scene) {
  planned.solver = solver;
  if (!solver) return;
  planned.handed = handed_scene(planned.scene, solver->options);
  const auto asks_dt = [](const std::string& word) { return word.find("{dt}") != word.npos; };
  if (!planned.scene.dt_given && std::ranges::any_of(solver->command, asks_dt))
    scene.fail("time.dt", "is missing, and the solver's command asks for {dt}: give it, or remove {dt}");
}

void require_delivered(const TomlTable& root, const Study& study) {
  const auto require = [&](const std::string& what, const std::string& key, Record record,
                           const std::vector<std::string>& variants) {
    for (const PlannedRun& planned : study.runs)
      if (planned.solver && std::ranges::count(variants, planned.variant) > 0 &&
          !planned.solver->delivers_record(record))
        root.fail(
            key, fmt::format("{} reads the {} of a run, which the study's solver does not deliver: add it to "
                             "solver.delivers, or remove this",
                             what, name(record)));
  };
  for (const CheckSpec& check : study.checks)
    for (const Record record : records_of(check))
      require("\"" + check.kind + (check.quantity.empty() ? "" : " of " + check.quantity) + "\"", "check",
              record, check.variants);
  for (const reports::FigureRecord& figure : study.figures)
    for (const PlannedRun& planned : study.runs) {
      const std::vector<std::string> drawn = reports::split_list(figure.runs);
      if (!drawn.empty() && std::ranges::count(drawn, planned.run) == 0) continue;
      require("a figure of kind \"" + figure.kind + "\"", "figure", record_of_figure(figure.kind),
              {planned.variant});
    }
}

}  // namespace verification

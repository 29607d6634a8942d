#include "verification/reading/solver_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <stdexcept>

#include "reports/process/child.hpp"
#include "verification/checks/check_reader.hpp"
#include "verification/reading/figure_reader.hpp"

namespace verification {
namespace {

std::vector<std::string> read_command(TomlTable& table) {
  std::vector<std::string> command;
  if (table.is_text("command")) {
    try {
      command = reports::split_command(table.text("command"));
    } catch (const std::invalid_argument& error) {
      table.fail("command", error.what());
    }
  } else {
    command = table.texts("command");
  }
  if (command.empty() || command.front().empty())
    table.fail("command",
               "is empty: name the program that runs a scene, or remove [solver] for the built-in one");
  static const std::regex braces(R"(\{[A-Za-z][A-Za-z0-9_-]*\})");
  for (const std::string& word : command)
    for (std::sregex_iterator found(word.begin(), word.end(), braces), end; found != end; ++found)
      if (std::ranges::count(ForeignSolver::placeholders(), found->str()) == 0)
        table.fail("command", fmt::format("'{}' is no placeholder; there are {}", found->str(),
                                          fmt::join(ForeignSolver::placeholders(), " ")));
  return command;
}

std::vector<Record> read_delivers(TomlTable& table) {
  std::vector<Record> records{Record::Profile};
  if (!table.has("delivers")) return records;
  records.clear();
  for (const std::string& word : table.texts("delivers")) {
    if (word != "profile" && word != "history")
      table.fail("delivers", "may hold \"profile\" and \"history\", not \"" + word + "\"");
    records.push_back(word == "profile" ? Record::Profile : Record::History);
  }
  if (std::ranges::count(records, Record::Profile) == 0)
    table.fail("delivers", "must hold \"profile\": there is nothing to judge without one");
  return records;
}

}  // namespace

ForeignSolver read_solver(TomlTable table, const std::filesystem::path& study_file) {
  ForeignSolver solver;
  solver.command = read_command(table);
  solver.name = table.text("name", std::filesystem::path(solver.command.front()).filename().string());
  if (solver.name.empty()) table.fail("name", "is empty: it stands in every table and legend");
  const std::filesystem::path folder = std::filesystem::absolute(study_file).parent_path();
  solver.directory = folder / table.text("working_directory", ".");
  if (!std::filesystem::is_directory(solver.directory))
    table.fail("working_directory", "'" + solver.directory.string() + "' is no directory");
  TomlTable environment = table.table("environment");
  for (const std::string& key : environment.keys()) solver.environment[key] = environment.text(key);
  solver.timeout = table.positive("timeout", solver.timeout);
  solver.delivers = read_delivers(table);
  for (const std::string& word :
       table.has("locations") ? table.texts("locations") : std::vector<std::string>{"grid", "particles"}) {
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

void require_delivered(const TomlTable& root, const Study& study) {
  if (!study.solver) return;
  const auto require = [&](const std::string& what, const std::string& key, Record record) {
    if (!study.solver->delivers_record(record))
      root.fail(key,
                fmt::format("{} reads the {} of a run, which the study's solver does not deliver: add it to "
                            "solver.delivers, or remove this",
                            what, name(record)));
  };
  for (const CheckSpec& check : study.checks)
    for (const Record record : records_of(check))
      require("\"" + check.kind + (check.quantity.empty() ? "" : " of " + check.quantity) + "\"", "check",
              record);
  for (const reports::FigureRecord& figure : study.figures)
    require("a figure of kind \"" + figure.kind + "\"", "figure", record_of_figure(figure.kind));
}

}  // namespace verification

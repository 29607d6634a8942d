#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "verification/flows/flow.hpp"

namespace verification {

/// What runs leave behind, and checks and figures read.
enum class Record { Profile, History, Shear, State };
std::string name(Record record);

/// Somebody else's solver, as a study names it: [solver].
struct ForeignSolver {
  /// What may stand in its command, and is replaced for every run.
  static const std::vector<std::string>& placeholders();

  std::string name;      ///< in tables and legends
  bool is_named = true;  ///< by its study; if not, its run.json may name it
  /// The program and its arguments, with placeholders; no shell reads it. Empty where `results` is not.
  std::vector<std::string> command;
  /// Directory of results that are there already, with {run} in it, instead of a command; "" for none.
  std::string results;
  std::vector<std::string> version_command;   ///< prints a version; empty where nothing does
  std::string options;                        ///< [solver.options] as TOML text, handed on; "" for none
  std::vector<std::filesystem::path> inputs;  ///< files that decide its results too
  /// Whether its runs may be kept: the study says what decides them, by `inputs` or `version`.
  bool remembered = false;
  int cores = 1;                    ///< that one run keeps busy
  std::filesystem::path directory;  ///< where it starts
  std::map<std::string, std::string> environment;
  double timeout = 3600;            ///< of a run [s]
  std::vector<Record> delivers;     ///< always a profile
  std::vector<Location> locations;  ///< of its profile; of those that it may hold where none is declared
  /// Whether the study, or results that are there, say which; else what the runs deliver decides.
  bool locations_known = true;
  int points_across = 0;      ///< fewest in a profile at each output; 0: as many as cells across
  std::string points_reason;  ///< why fewer than cells will do

  [[nodiscard]] bool delivers_record(Record record) const;
  /// Its results are there already: nothing is run.
  [[nodiscard]] bool is_there() const { return !results.empty(); }
};

}  // namespace verification

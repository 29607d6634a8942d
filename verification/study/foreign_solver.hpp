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

  std::string name;                  ///< in tables and legends
  std::vector<std::string> command;  ///< the program and its arguments, with placeholders; no shell reads it
  std::filesystem::path directory;   ///< where it starts
  std::map<std::string, std::string> environment;
  double timeout = 3600;            ///< of a run [s]
  std::vector<Record> delivers;     ///< always a profile
  std::vector<Location> locations;  ///< of its profile
  int points_across = 0;            ///< fewest in a profile at each output; 0: as many as cells across
  std::string points_reason;        ///< why fewer than cells will do

  [[nodiscard]] bool delivers_record(Record record) const;
};

}  // namespace verification

#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "verification/runs/run_data.hpp"

namespace verification {

/// Where deliveries of foreign runs are kept, by what decides them (what_decides.hpp); empty functions for
/// nowhere.
struct KeptDeliveries {
  std::function<std::optional<std::string>(const std::string& key)> load;
  std::function<void(const std::string& key, const std::string& bytes)> save;
  bool may_run = true;  ///< false: what is not kept is a failed run
};

/// Runs one planned simulation with somebody else's solver. Its command, placeholders replaced, is started
/// without a shell in a process group of its own; {out} is a directory that holds nothing before it starts,
/// into which it writes profile.csv and what else its study says (delivered_files.hpp). Results that are
/// there already are judged where they lie; a run that is kept is unpacked and judged, as if it had just
/// ended. A command that fails, or a delivery that is not whole, is a failed run: std::runtime_error says
/// what happened, and how the log ends. Throws Interrupted when a signal has come; nothing that it started is
/// left.
RunData run_foreign(const Study& study, const PlannedRun& plan, const std::filesystem::path& out,
                    const KeptDeliveries& kept = {});

}  // namespace verification

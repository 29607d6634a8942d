#pragma once

#include <filesystem>

#include "verification/runs/run_data.hpp"

namespace verification {

/// Runs one planned simulation with somebody else's solver: the study's command, with {scene} replaced by the
/// path of the scene's TOML and {out} by a directory of its own, must write {out}/profile.csv with the
/// columns t,location,x,y,u,v (SI; location "grid" or "particles") at every output time. We add the exact
/// solution, and judge. A command that fails, or leaves no such file, is a failed run (std::runtime_error
/// says why); output times that are missing from the file fail their checks.
RunData run_external(const Study& study, const PlannedRun& plan, const std::filesystem::path& out);

}  // namespace verification

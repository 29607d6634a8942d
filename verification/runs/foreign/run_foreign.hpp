#pragma once

#include <filesystem>

#include "verification/runs/run_data.hpp"

namespace verification {

/// Runs one planned simulation with somebody else's solver. Its command, placeholders replaced, is started
/// without a shell in a process group of its own; {out} is a directory that holds nothing before it starts,
/// into which it writes
///   profile.csv  t,location,x,y,u,v (SI; location "grid" or "particles"; v may be left out in a channel
///   along x,
///                then it is zero; lines that begin with # are skipped), every output time;
///   history.csv  where the study says so:
///   t,probe,mass,momentum_x,momentum_y,impulse_x,impulse_y,kinetic_energy.
/// We add the exact solution, and judge. A command that fails, or a profile that is not whole (delivery.hpp),
/// is a failed run: std::runtime_error says what happened, and how the log ends. Throws Interrupted when a
/// signal has come; nothing that it started is left.
RunData run_foreign(const Study& study, const PlannedRun& plan, const std::filesystem::path& out);

}  // namespace verification

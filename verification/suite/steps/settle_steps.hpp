#pragma once

#include <functional>
#include <string>
#include <vector>

#include "verification/suite/run_cache.hpp"

namespace verification {

/// Gives every run whose scene says dt = "auto" its step (runs/pilot/): a study holds numbers from then on,
/// and says which pilot runs they come from. Pilot runs are taken over from the cache, or made on `threads`
/// threads and kept there; the outcome depends on neither. `say` hears one line a variant, in the order of
/// the studies. Throws ConfigError where the cache must have them and has not, Interrupted, and
/// reports::IoError.
void settle_steps(std::vector<Study>& studies, RunCache& cache, int threads,
                  const std::function<void(const std::string& line)>& say);

/// A failed check for every variant for which no step could be chosen.
std::vector<reports::CheckRecord> unsettled_steps(const Study& study);

}  // namespace verification

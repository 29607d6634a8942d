#pragma once

#include "verification/runs/run_data.hpp"

namespace verification {

/// Where a study's solver does not say at which locations its profile is (solver.locations), its runs do,
/// once all have ended: what any of them delivers is asked of each, and of no other location is anything
/// asked. A run without rows where others have some has an error nobody measured, which fails.
void settle_locations(StudyData& data);

}  // namespace verification

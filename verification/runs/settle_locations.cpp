#include "verification/runs/settle_locations.hpp"

#include <algorithm>

namespace verification {

void settle_locations(StudyData& data) {
  const Study& study = *data.study;
  if (!study.solver || study.solver->locations_known) return;
  std::vector<Location> delivered;
  for (const Location location : study.solver->locations) {
    const auto has_rows = [&](const RunData& run) {
      return std::ranges::any_of(run.profile,
                                 [&](const auto& row) { return row.location == name(location); });
    };
    if (std::ranges::any_of(data.runs, has_rows)) delivered.push_back(location);
  }
  if (delivered.empty() || delivered == study.solver->locations) return;
  data.settled = std::make_shared<const Study>(study.at_locations(delivered));
  data.study = data.settled.get();
}

}  // namespace verification

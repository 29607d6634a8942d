#include <fmt/format.h>

#include "verification/commands/commands.hpp"
#include "verification/commands/output.hpp"
#include "verification/reading/scoreboard_reader.hpp"
#include "verification/reading/study_folder.hpp"
#include "verification/scene/scene_cost.hpp"

namespace verification {

int list_command(const ListOptions& options) {
  const Suite suite = suite_named(options.suite);
  if (options.names) {
    for (Study& study : read_studies(options.studies))
      if (restrict_to(study, suite)) say("{}\n", study.name);
    return 0;
  }
  say("{:<30} {:<6} {:>5} {:>16} {:>8}  {}\n", "study", "suite", "runs", "particle-steps", "about", "claim");
  double total = 0;
  long runs = 0;
  for (Study& study : read_studies(options.studies)) {
    if (!restrict_to(study, suite)) continue;
    const double cost = study.particle_steps();
    const std::size_t jobs = study.runs.size() + study.stability.cases.size();
    say("{:<30} {:<6} {:>5} {:>16.3g} {:>6.1f} s  {}\n", study.name, name(study.suite), jobs, cost,
        cost / particle_steps_per_second, study.claim);
    total += cost;
    runs += static_cast<long>(jobs);
  }
  say("{:<30} {:<6} {:>5} {:>16.3g} {:>6.1f} s  on one core at {:.0f} million particle-steps/s\n", "total",
      name(suite), runs, total, total / particle_steps_per_second, particle_steps_per_second / 1e6);
  return 0;
}

}  // namespace verification

#include "verification/study/study.hpp"

#include "verification/config/config_error.hpp"

namespace verification {

std::string name(Suite suite) {
  switch (suite) {
    case Suite::Quick:
      return "quick";
    case Suite::Full:
      return "full";
    case Suite::Deep:
      return "deep";
    default:
      return "peers";
  }
}

bool holds(Suite suite, Suite other) {
  return suite == Suite::Peers || other == Suite::Peers ? suite == other : other <= suite;
}

Suite suite_named(const std::string& text) {
  for (const Suite suite : {Suite::Quick, Suite::Full, Suite::Deep, Suite::Peers})
    if (name(suite) == text) return suite;
  throw ConfigError("suite '" + text + "' is not known; choose one of: quick, full, deep, peers");
}

std::string name(Axis axis) {
  switch (axis) {
    case Axis::Space:
      return "space";
    case Axis::Time:
      return "time";
    case Axis::Mach:
      return "mach";
    default:
      return "none";
  }
}

double Study::particle_steps() const {
  double sum = 0;
  for (const PlannedRun& run : runs) sum += run.scene.particle_steps();
  for (const StabilityCase& one : stability.cases) sum += stability.cost(one);
  return sum;
}

std::vector<const PlannedRun*> Study::runs_of(const std::string& variant) const {
  std::vector<const PlannedRun*> found;
  for (const PlannedRun& run : runs)
    if (run.variant == variant) found.push_back(&run);
  return found;
}

Study Study::at_locations(const std::vector<Location>& at) const {
  Study settled = *this;
  settled.solver->locations = at;
  settled.solver->locations_known = true;
  for (CheckSpec& spec : settled.checks)
    if (spec.locations_by_default)
      std::erase_if(spec.locations, [&](Location location) { return std::ranges::count(at, location) == 0; });
  return settled;
}

}  // namespace verification

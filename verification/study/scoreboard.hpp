#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

namespace verification {

/// What became of a scheme on a hard case, from good to bad.
enum class Fate { Survived, Degraded, Diverged };
std::string name(Fate fate);

/// What a study says will become of a scheme, and why.
struct Expectation {
  Fate fate;
  std::string reason;
};

/// A hard case of the stability scoreboard: every scheme of a study on one scene, each with the fate that the
/// study declares for it.
struct Scoreboard {
  /// An error (relative L2 norm) or a root mean square velocity (in units of the larger of the flow's
  /// velocity scale and the start's) above this means that the run has diverged, even if every number is
  /// still finite.
  static constexpr double blown_up = 10;

  std::string hard_case;     ///< short name, heads a column
  std::string location;      ///< of the error: "grid" or "particles"
  double degraded_above = 0; /**< relative L2 error at the last output */
  /// Band of the particles' kinetic energy over the exact solution's at the last output; outside: degraded.
  double energy_lower = 0, energy_upper = std::numeric_limits<double>::infinity();
  std::string reason;                           ///< of these thresholds
  std::map<std::string, Expectation> expected;  ///< by variant; every variant has one
  std::vector<std::string> in_full, in_quick;   ///< variants that run in the lesser suites
};

}  // namespace verification

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verification/study/study.hpp"
#include "verification/suite/run_cache.hpp"

namespace verification {

/// Negative controls are judged as what they are, or as studies like any other.
enum class Controls { Judged, Plain };

/// Studies named by the user (a name, or the path of a .toml file), or those of the suite ("": full, or all
/// that is named). Throws ConfigError, also when there is none.
std::vector<Study> chosen_studies(const std::filesystem::path& studies, const std::vector<std::string>& names,
                                  const std::string& suite, Controls controls = Controls::Judged);

/// How a suite is run and told of.
struct SuiteSession {
  std::filesystem::path out;
  std::filesystem::path cache;  ///< of figures and references; "" for none
  int jobs = 1;
  bool force = false, pdf = false, keep_profiles = false;
  std::string command_line;
};

/// Steps of scenes that say dt = "auto", chosen and said (suite/steps/settle_steps.hpp).
void settle_and_say(std::vector<Study>& studies, RunCache& cache, int jobs);

/// Settles the steps of the studies, runs them, says how it goes, and writes the report. Returns the exit
/// code: 0 all checks pass, 1 one failed, 3 a run could not be simulated, 128 + signal.
int run_session(std::vector<Study> studies, const SuiteSession& session, RunCache& cache);

}  // namespace verification

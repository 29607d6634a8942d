#pragma once

#include <string>
#include <vector>

#include "reports/records/records.hpp"

// What an error costs: runs of the studies that measure time (several repetitions, nothing beside them).
namespace reports {

/// One run as a point of a work-precision diagram.
struct CostPoint {
  const RunRecord* run;
  double wall = 0;            ///< [s]; NaN where no time is known
  double particle_steps = 0;  ///< particles times steps
  double error = 0;           ///< relative; NaN for a run that did not complete
  std::string clock = {};     ///< who measured the wall time (TimingRecord::clock)
};

/// Relative error norm of a run at time t; at t = NaN the largest of all output times. NaN if the run did not
/// complete or any of them is not finite.
double error_of(const RunRecord& run, const Results& results, const std::string& location,
                const std::string& norm, double t);

/// Points that no other is better than in both cost and error, from cheap to dear: the front of the best.
std::vector<CostPoint> best_front(std::vector<CostPoint> points, bool by_wall);

/// Particles times steps of a run; NaN where its solver did not say.
double particle_steps_of(const RunRecord& run);

/// "cubic, full-mass, leapfrog"
std::string scheme_of(const RunRecord& run);

/// For one flow and fluid, by our solver or by one other: the cheapest timed run whose largest L2 error on
/// the grid, of all output times, is at most each of the targets; null where none reaches it. Runs of other
/// solvers are timed once, and count where their study times ours (nothing else runs then).
struct Cheapest {
  std::string scene, fluid;
  std::string solver;           ///< somebody else's; "" for ours
  std::vector<CostPoint> runs;  ///< one a target; `run` is null where none reaches it
};
extern const std::vector<double> error_targets;  ///< 1e-2, ... 1e-6
std::vector<Cheapest> cheapest_runs(const Results& results);

/// The table as a section; "" when no run was timed.
std::string html_cheapest(const Results& results);
std::string markdown_cheapest(const Results& results);

}  // namespace reports

#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/records/records.hpp"
#include "verification/scene/scene_config.hpp"
#include "verification/stability/stability_plan.hpp"
#include "verification/study/control.hpp"
#include "verification/study/foreign_solver.hpp"
#include "verification/study/scoreboard.hpp"
#include "verification/study/validation.hpp"

namespace verification {

/// Suites nest: everything in Quick runs in Full, everything in Full in Deep. Peers stands apart: studies
/// that need somebody else's program.
enum class Suite { Quick, Full, Deep, Peers };
/// Whether a suite holds the studies of another.
bool holds(Suite suite, Suite other);
std::string name(Suite suite);
/// Throws ConfigError for an unknown name.
Suite suite_named(const std::string& text);

/// What a run is compared with: the differential equations' solution, or the scheme's own (Discrete: a
/// Newtonian channel at any time; SteadyNodes: any fluid, on the grid, once nothing changes any more), or
/// the steady flow of the ideal fluid in place of one whose yield stress is regularised; or a table, or the
/// finest level of its own ladder.
enum class Comparison { Exact, Discrete, SteadyNodes, Ideal, Table, Finest };

/// A table that a study brings with it.
class ComparisonTable : public ExactField {
 public:
  [[nodiscard]] virtual bool holds(double t) const = 0;
};

/// One simulation of a study.
struct PlannedRun {
  std::string run;      ///< unique name, safe as a file name
  std::string variant;  ///< "" where the study has none
  int level = 0;        ///< on the ladder, 0 the coarsest
  double step = 0;      ///< refined quantity: h [m], dt [s] or Mach number
  /// Order that theory gives its ladder, on the grid and on the particles.
  double theoretical = std::numeric_limits<double>::quiet_NaN(), theoretical_particles = theoretical;
  SceneConfig scene;
  std::shared_ptr<const ForeignSolver> solver;  ///< somebody else's; null: ours
  std::string handed;                           ///< the scene as it is given to that solver

  /// What is written to scenes/RUN.toml.
  [[nodiscard]] const std::string& scene_text() const { return solver ? handed : scene.toml; }
};

enum class Axis { None, Space, Time, Mach };
std::string name(Axis axis);

/// How the levels of a study differ.
struct Ladder {
  Axis axis = Axis::None;
  std::vector<int> cells;        ///< Space: across, coarse to fine
  bool along = false;            ///< Space: cells along grow with them; those of the scene are the coarsest's
  bool formal_exponent = false;  ///< Space: dt_exponent follows from each scheme's formal orders
  double dt_exponent = 2;        ///< Space: dt = time.dt (cells[0]/cells)^dt_exponent
  std::vector<double> dt;        ///< Time: coarse to fine [s]
  std::vector<double> mach;      ///< Mach: scene.amplitude over the speed of sound, falling
  double theoretical = std::numeric_limits<double>::quiet_NaN();            ///< order that theory gives
  double theoretical_particles = std::numeric_limits<double>::quiet_NaN();  ///< the same for the particles

  double floor = 0;  ///< relative error below which levels are round-off: dropped within 10x of it
};

/// One statement that must hold; which keys matter depends on the kind (checks/).
struct CheckSpec {
  std::string kind;
  std::vector<std::string> variants;  ///< that it speaks of
  std::vector<Location> locations;
  bool locations_by_default = false;  ///< all that are delivered, since it names none
  std::string norm;                   ///< "l1", "l2", "linf"
  /// What errors are judged against: "" for the flow's own scale, "steady", "present", or "value".
  std::string relative_to;
  double scale = 0;  ///< "value": [m/s]
  /// Of an order: its whole 95 % interval must lie in the band, not its point value alone.
  bool whole_interval = false;
  std::vector<double> times;   ///< [s]
  std::string level;           ///< "finest", "coarsest", "all", or the end of a run's name, e.g. "n20"
  std::string against;         ///< variant to compare with
  std::string quantity;        ///< conserved quantity, or one of checks/quantities/quantities.hpp
  double tolerance = 0;        ///< half width of a band about each variant's own theory
  double place = 0;            ///< fraction of the gap
  double stability_limit = 0;  ///< of nu dt/h^2, for chatter
  std::string claim;           ///< that this check is evidence for; "" for none
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  std::string reason;
};

/// A statement of the paper (or of anybody), judged by the checks that name it.
struct ClaimSpec {
  std::string id, source, statement, verdict, note;
};

/// A study: what to run, refine and measure, and what must hold. Read from TOML by read_study().
struct Study {
  std::string name, title, claim;
  std::string
      topic;  ///< chapter of the report: the folder that it lies in among the studies, or what it says
  std::optional<reports::ChapterRecord> scope;  ///< what its folder says is not verified
  /// How the report names the chapter and where it stands among the others, if its folder says so.
  std::optional<std::pair<reports::ChapterRecord, long>> chapter;
  std::vector<std::pair<reports::HeadlineRecord, long>>
      headlines;  ///< the same for the report's first screen
  Suite suite = Suite::Full;
  Comparison comparison = Comparison::Exact;
  std::shared_ptr<const ComparisonTable> table;  ///< of Comparison::Table
  std::string table_content;                     ///< its hash
  double table_uncertainty = 0;                  ///< relative to the velocity scale
  /// Somebody else's, of every run; none: ours, or variants name solvers of their own.
  std::optional<ForeignSolver> solver;
  Ladder ladder;
  bool matrix = false;  ///< its variants are a [matrix] of schemes
  /// Times that each run is simulated, at most (wants_repetition), to measure what it costs, warmed up and
  /// with nothing else running; 0: cost is not the point, and runs share the machine.
  int repetitions = 0;
  std::vector<std::string> variants;
  std::vector<PlannedRun> runs;  ///< variant by variant, coarse to fine
  StabilityPlan stability;       ///< in place of runs: limits to measure
  /// Steps of the runs whose scenes say dt = "auto", once they are chosen (runs/pilot/), and the runs that
  /// they were chosen by.
  std::vector<reports::TimeStepRecord> time_steps;
  std::vector<reports::PilotRecord> pilots;
  std::vector<reports::TimingRecord> pilot_timings;
  std::vector<CheckSpec> checks;
  /// How many checks the study says that it makes (expected_checks); none where it does not, or where a
  /// lesser suite runs a part of it.
  std::optional<std::size_t> declared_checks;
  std::vector<ClaimSpec> claims;
  std::vector<reports::FigureRecord> figures;
  std::optional<Scoreboard> scoreboard;      ///< of a hard case
  std::optional<ValidationSpec> validation;  ///< measurements that its runs are compared with
  std::optional<ControlSpec> control;        ///< a fault is planted in it: its checks must be red

  [[nodiscard]] double particle_steps() const;
  /// Runs of one variant, coarse to fine.
  [[nodiscard]] std::vector<const PlannedRun*> runs_of(const std::string& variant) const;
  /// The study, judged at `locations` alone: those of its solver, and of every check that names none itself.
  [[nodiscard]] Study at_locations(const std::vector<Location>& at) const;
};

}  // namespace verification

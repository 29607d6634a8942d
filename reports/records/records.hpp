#pragma once

#include <limits>
#include <string>
#include <vector>

#include "reports/records/time_steps.hpp"
#include "reports/records/validation.hpp"

// The rows of every result file. Whoever writes these (our driver or somebody else's) can have a report made
// of them: reports/ reads nothing else. SI units; a quantity that does not exist is NaN, a word that does not
// is "".
namespace reports {

/// studies.csv: what was asked.
struct StudyRecord {
  std::string study, title, claim, suite;
  std::string left_out = {};  ///< what its scenes did without, and the reader may want to know
  std::string topic = {};     ///< its chapter of the report; "" for none of its own
};

/// Topic of the chapter that is none: what a suite says it has not verified.
inline constexpr const char* scope_topic = "scope";

/// chapters.csv: the chapters of the report, in their order. A topic that it does not name has one all the
/// same.
struct ChapterRecord {
  std::string topic;      ///< of the studies that it holds
  std::string title;      ///< topics of one title share a chapter
  std::string paragraph;  ///< that it opens with; the first of its topics that has one gives it
  std::string figure;     ///< shown with it; "" for the first of its studies
};

/// headlines.csv: what the first screen of the report shows, in its order, as far as the studies are there.
struct HeadlineRecord {
  std::string title;   ///< what is measured
  std::string study;   ///< whose checks say it:
  std::string check;   ///< those whose names hold this text; "" for all of the study
  std::string figure;  ///< shown with it; "" for none
};

/// changes.csv: what is different from the results that lay in the directory before; only there when some
/// did.
struct ChangeRecord {
  std::string file,
      verdict;       ///< "errors.csv", "worse"; ("provenance.json", "before") is the earlier run itself
  std::string name;  ///< of the number
  double before = 0, after = 0;
  std::string unit, note;
};

/// Basis, transfer and stepping of a run whose solver is a program of its own: what it does is not known.
inline constexpr const char* foreign_scheme = "external";

/// runs.csv: one simulation.
struct RunRecord {
  std::string run, study, scene, fluid, basis, transfer, stepping;
  long cells = 0;      ///< background cells across the scene's characteristic length
  long particles = 0;  ///< material points in the whole scene
  double dt = 0;       ///< nominal time step [s]
  long steps = 0;      ///< steps taken
  std::string status;  ///< "completed" or "diverged at t = ... s: why"
  /// When particles are put back on their lattice: "never", "every 25 steps", ...
  std::string reset = "never";
  std::string method =
      "MPM";  ///< whose result it is: a method of the built-in solver, or a foreign solver's name
};

/// errors.csv: norms of (numerical - exact) velocity, relative to the velocity scale of the flow [-].
struct ErrorRecord {
  std::string run;
  double t = 0;          ///< [s]
  std::string location;  ///< "grid" or "particles"
  double l1 = 0, l2 = 0, linf = 0;
  double scale = std::numeric_limits<double>::quiet_NaN();  ///< that they are relative to [m/s]
  double exact_max =
      std::numeric_limits<double>::quiet_NaN();  ///< fastest exact velocity there and then [m/s]
};

/// levels.csv: one point of one refinement ladder, the data behind one row of orders.csv.
struct LevelRecord {
  std::string study, variant;
  std::string axis;  ///< "space", "time" or "mach"
  std::string location, norm;
  double t = 0;     ///< [s]
  double step = 0;  ///< refined quantity: cell size h [m], dt [s], or the Mach number [-]
  /// "space", "mach": relative error norm; "time": relative norm of the difference to the next finer dt
  double value = 0;
  bool used = true;  ///< false when dropped from the fit (at the round-off floor, or not finite)
};

/// orders.csv: the convergence order observed on one ladder.
struct OrderRecord {
  std::string study, variant, axis, location, norm;
  double t = 0;                       ///< [s]
  double theoretical = 0;             ///< order that theory gives; NaN where none is claimed
  double observed = 0;                ///< least-squares slope over the levels used
  double ci_lower = 0, ci_upper = 0;  ///< its 95 % confidence interval (Student t)
  long levels_used = 0, levels = 0;   ///< in the fit, in the ladder
  std::string classification;         ///< "monotone", "oscillatory", "divergent", "floor", "invalid"
  std::string pairwise;               ///< orders between neighbouring levels, coarse to fine, joined by ';'
  double gci = 0;                     ///< grid convergence index of the finest level, relative [-]
  double gci_safety_factor = 0;       ///< 1.25 or 3
  double uncertainty = 0;             ///< Eca-Hoekstra 95 % uncertainty of the finest level, relative [-]
  std::string quantity;               ///< the scalar that gci and uncertainty speak of
};

/// checks.csv: one statement that must hold. Passes when lower <= observed <= upper; NaN never passes.
struct CheckRecord {
  std::string study, check;
  double observed = 0, lower = 0, upper = 0;
  std::string unit;
  std::string verdict;  ///< "pass" or "fail"
  std::string reason;   ///< where the bounds come from
};

/// controls.csv: a fault that is planted on purpose, and what the program said of it. Only there when a suite
/// has some.
struct ControlRecord {
  std::string study;
  std::string planted;    ///< what is wrong
  std::string must_fail;  ///< the checks that must be red for it; "" where nothing may be
  std::string said;       ///< which checks were red, and what they observed
  long exit_code = 0;     ///< of the program that judged it alone
  std::string results;    ///< its own report and tables, relative to the directory
  bool seen = false;      ///< everything was said as it must be
};

/// timing.csv: the only file that may differ between two runs of the same build.
inline constexpr const char* timing_measured = "measured";  ///< in this run of the suite
inline constexpr const char* timing_from_cache =
    "cache";  ///< when the run was simulated, in an earlier suite
inline constexpr const char* clock_simulation = "simulation";  ///< ours, of the simulation alone
inline constexpr const char* clock_solver = "solver";          ///< a foreign solver's own (run.json)
inline constexpr const char* clock_process = "process";        ///< ours, of a foreign solver's whole process
struct TimingRecord {
  std::string run;
  double wall_s = 0;                ///< simulation alone, the fastest repetition [s]
  double particle_steps_per_s = 0;  ///< [1/s]
  long repetitions = 1;             ///< timed, after a warm-up where there is more than one
  /// (median - fastest)/fastest of the repetitions [-]; NaN for a single one, whose noise is not known
  double spread = std::numeric_limits<double>::quiet_NaN();
  std::string source = timing_measured;
  std::string clock = clock_simulation;  ///< who measured the time, of what
};

/// profiles/<run>.csv: velocity at points. location: "grid", "particles", or "exact" (a fine line for
/// figures, numerical columns NaN). u, v along x, y.
struct ProfileRow {
  double t = 0;  ///< [s]
  std::string location;
  double x = 0, y = 0;              ///< [m]
  double u = 0, v = 0;              ///< [m/s]
  double u_exact = 0, v_exact = 0;  ///< [m/s]
};

/// profiles/<run>.history.csv: scalars against time.
struct HistoryRow {
  double t = 0;                           ///< [s]
  double probe = 0, probe_exact = 0;      ///< streamwise velocity at the probe (mid-height) [m/s]
  double mass = 0;                        ///< total mass per unit depth [kg/m]
  double momentum_x = 0, momentum_y = 0;  ///< total momentum per unit depth [kg/s]
  double impulse_x = 0, impulse_y = 0;    ///< time integral of body and wall forces per unit depth [kg/s]
  double kinetic_energy = 0;              ///< of the particles per unit depth [J/m]
  double kinetic_energy_exact = std::numeric_limits<double>::quiet_NaN();  ///< of the exact field [J/m]
};

/// profiles/<run>.shear.csv: shear rate and viscosity across a channel. location: "cells" (grid field at cell
/// centres) or "exact" (a fine line).
struct ShearRow {
  double t = 0;  ///< [s]
  std::string location;
  double place = 0;            ///< distance from the resting plate [m]
  double shear_rate = 0;       ///< |du/dy| [1/s]
  double viscosity_ratio = 0;  ///< mu/mu_0 [-]
};

/// profiles/<run>.state.csv: density and pressure where the flow has an exact density. location: "particles"
/// or "exact" (a fine line, numerical columns NaN).
struct StateRow {
  double t = 0;  ///< [s]
  std::string location;
  double x = 0, y = 0;                      ///< [m]
  double density = 0, density_exact = 0;    ///< [kg/m3]
  double pressure = 0, pressure_exact = 0;  ///< [Pa], by the equation of state
};

/// claims.csv: somebody's statement, and what became of it here.
struct ClaimRecord {
  std::string claim, study;
  std::string source;     ///< where it is made: "Fig. 3", "conclusion 3"
  std::string statement;  ///< what is claimed
  std::string verdict;    ///< "confirmed", "refuted", "confirmed within bounds"
  std::string measured;   ///< the numbers that the verdict rests on
  std::string note;       ///< what to make of it
  bool stands = true;     ///< every check behind the verdict holds
};

/// matrix.csv: one cell of the order matrix, a scheme on a flow refined along an axis.
struct MatrixRecord {
  std::string basis, transfer, stepping, scene;
  std::string axis, location;
  double theoretical = 0;             ///< NaN where theory gives none
  double observed = 0;                ///< L2 order at the last output
  double ci_lower = 0, ci_upper = 0;  ///< its 95 % confidence interval
  double smallest_error = 0;          ///< reached on the ladder, relative [-]
  std::string verdict;                ///< "pass", "fail", or "grows as dt shrinks" (lossy: see reason)
  std::string reason;
};

/// Unit of checks that compare what became of a scheme with what was expected.
inline constexpr const char* outcome_unit = "(0 survived, 1 degraded, 2 diverged)";

/// scoreboard.csv: what became of a scheme on a hard case.
struct ScoreRecord {
  std::string study;
  std::string hard_case;  ///< short name, heads a column
  std::string scheme;     ///< the study's variant: basis_transfer_stepping, or a name of its own
  std::string basis, transfer, stepping;
  std::string outcome;      ///< "survived", "degraded", "diverged"; "failed" when it could not be simulated
  std::string expected;     ///< the outcome that the study declares
  std::string verdict;      ///< "pass" when they agree, else "fail"
  double t_diverged = 0;    ///< time from the start at which a diverged run went wrong [s]; NaN for others
  double error = 0;         ///< relative L2 error of velocity at the last output; NaN if not reached
  double energy_ratio = 0;  ///< kinetic energy of the particles at the last output over the exact solution's
  double degraded_above = 0;                  ///< error beyond which a run is degraded
  double energy_lower = 0, energy_upper = 0;  ///< energy ratios outside are degraded
  std::string location;                       ///< of the error: "grid" or "particles"
  std::string status;                         ///< of the run
  std::string reason;                         ///< of the expectation
  std::string thresholds;                     ///< reason of the thresholds
};

/// stability.csv: the largest stable time step of one scheme along one ray from the origin of the (r, CFL)
/// plane, r = nu dt/h^2 and CFL = c dt/h, on a periodic lattice of square cells.
struct StabilityRecord {
  std::string study, basis, transfer, stepping;
  std::string waves;    ///< "shear", "longitudinal" (both along one axis), "plane"
  std::string motion;   ///< "rest": particles in their seats; "offset", "streaming", "streaming-x": at the
                        ///< worst offset
  std::string lattice;  ///< particles a cell and how they are seated, e.g. "2 x 2 even"
  std::string kind;     ///< "measured", or "boundary": predicted only, a point of the line in a map
  double r_predicted = 0, cfl_predicted = 0;  ///< spectral radius one; NaN when nothing grows on the ray
  double r_measured = 0, cfl_measured = 0;    ///< by the solver; NaN when nothing grew
  double r_tested = 0, cfl_tested = 0;        ///< the largest step tried on the ray
  double theta_x = 0, theta_y = 0;            ///< wave that grows first [rad a cell]
  double offset_x = 0, offset_y = 0;          ///< of the particles from their seats then [cells]
  long steps = 0;                             ///< of one measuring run
  std::string crossing;  ///< streaming at 0.97 of the predicted limit through a whole period of offsets:
                         ///< "stable", "unstable"; "" where not tried
};

/// figures.csv: what to draw from the files above. Lists are joined by ';'.
struct FigureRecord {
  std::string figure;  ///< file stem, unique
  std::string study;
  /// "profiles", "history", "energy", "convergence", "work-precision", "shear-rate", "viscosity", "pressure",
  /// "occupancy", "stability-map", "regularisation", "yielded", "validation", "validation-parts",
  /// "computed-measured"
  std::string kind;
  std::string title;  ///< the claim that the figure shows
  /// Runs to draw (profiles, history, work-precision); "" = all of the study. stability-map: schemes, as
  /// basis_transfer_stepping. (`labels` of convergence: its variants; "" = all.)
  std::string runs;
  std::string labels;  ///< a legend entry for each run; "" = run names. regularisation: its m [s]
  std::string across;  ///< profiles: "x" or "y"; work-precision: "wall" or "particle-steps";
                       ///< stability-map: waves; regularisation: runs on the path
  /// Velocity component of profiles: "u" or "v"; yielded: of each run, the shear rate at which it yields
  /// [1/s]
  std::string component;
  std::string location;  ///< "grid", "particles", or "grid;particles"; stability-map: motions
  std::string norm;      ///< convergence, work-precision: "l1", "l2", "linf"
  double t = std::numeric_limits<double>::quiet_NaN();  ///< shear-rate, viscosity, pressure: the time [s]
};

/// The content of one result directory, profiles and histories excepted (they are read run by run).
struct Results {
  std::vector<StudyRecord> studies;
  std::vector<ChapterRecord> chapters;
  std::vector<HeadlineRecord> headlines;
  std::vector<RunRecord> runs;
  std::vector<ErrorRecord> errors;
  std::vector<LevelRecord> levels;
  std::vector<OrderRecord> orders;
  std::vector<CheckRecord> checks;
  std::vector<TimingRecord> timings;
  std::vector<FigureRecord> figures;
  std::vector<ClaimRecord> claims;
  std::vector<MatrixRecord> matrix;
  std::vector<ScoreRecord> scores;
  std::vector<StabilityRecord> stability;
  std::vector<ControlRecord> controls;
  std::vector<TimeStepRecord> time_steps;
  std::vector<PilotRecord> pilots;
  std::vector<ValidationRecord> validation;
  std::vector<JointValidationRecord> joint_validation;
  std::vector<ValidationBiasRecord> validation_bias;
};

}  // namespace reports

#include "verification/reading/study_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "reports/records/directory/result_files.hpp"
#include "verification/checks/check_reader.hpp"
#include "verification/checks/expected_checks.hpp"
#include "verification/config/config_error.hpp"
#include "verification/reading/comparison_reader.hpp"
#include "verification/reading/control_reader.hpp"
#include "verification/reading/figure_reader.hpp"
#include "verification/reading/scoreboard_reader.hpp"
#include "verification/reading/solver_reader.hpp"
#include "verification/reading/validation_reader.hpp"
#include "verification/runs/scheme_matrix.hpp"
#include "verification/runs/validate.hpp"
#include "verification/scene/matrix.hpp"

namespace verification {
namespace {

template <class Value>
void require_ladder(const TomlTable& table, const std::string& key, const std::vector<Value>& values,
                    bool rising) {
  if (values.size() < 2) table.fail(key, "needs at least two levels");
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] > 0)) table.fail(key, "must be positive");
    if (i > 0 && (rising ? values[i] <= values[i - 1] : values[i] >= values[i - 1]))
      table.fail(key, "must run from coarse to fine");
  }
}

Ladder read_ladder(TomlTable table, bool present, bool matrix) {
  Ladder ladder;
  if (!present) return ladder;
  const std::string axis = table.text("axis");
  if (axis == "space") {
    ladder.axis = Axis::Space;
    ladder.cells = table.integers("cells");
    require_ladder(table, "cells", ladder.cells, true);
    ladder.formal_exponent = table.flag("formal_dt_exponent", false);
    ladder.dt_exponent = table.number("dt_exponent", ladder.dt_exponent);
    ladder.along = table.flag("along", false);
  } else if (axis == "time") {
    ladder.axis = Axis::Time;
    ladder.dt = table.numbers("dt");
    require_ladder(table, "dt", ladder.dt, false);
    if (ladder.dt.size() < 3) table.fail("dt", "needs at least three levels: orders come from differences");
  } else if (axis == "mach") {
    ladder.axis = Axis::Mach;
    if (matrix)
      table.fail("axis", "\"mach\" is not for a [matrix], which judges schemes by their own orders");
    ladder.mach = table.numbers("mach");
    require_ladder(table, "mach", ladder.mach, false);
  } else {
    table.fail("axis", "must be \"space\", \"time\" or \"mach\"");
  }
  // A matrix of schemes knows each scheme's own order.
  if (!matrix || table.has("theoretical"))
    ladder.theoretical = ladder.theoretical_particles = table.positive("theoretical");
  ladder.floor = table.positive("floor", ladder.floor);
  table.refuse_unknown_keys();
  return ladder;
}

/// In the same ratio as the cells across.
int cells_along_at(TomlTable& scene, const Ladder& ladder, std::size_t level) {
  TomlTable discretisation = scene.table("discretisation");
  const long product = static_cast<long>(discretisation.integer("cells_along")) * ladder.cells[level];
  if (product % ladder.cells.front() != 0)
    discretisation.fail("cells_along", fmt::format("times {}/{} is no whole number: choose levels of the "
                                                   "ladder that keep it one",
                                                   ladder.cells[level], ladder.cells.front()));
  return static_cast<int>(product / ladder.cells.front());
}

/// Lays the values of one level over the scene. A space ladder scales a fixed dt; one from limits follows by
/// itself.
TomlTable at_level(const TomlTable& scene, const Ladder& ladder, int level, std::string& tag) {
  TomlTable result = scene.overlaid_with(TomlTable::from_text("", ""), "");
  const auto i = static_cast<std::size_t>(level);
  if (ladder.axis == Axis::Space) {
    result.set("discretisation.cells", ladder.cells[i]);
    if (ladder.along) result.set("discretisation.cells_along", cells_along_at(result, ladder, i));
    TomlTable time = result.table("time");
    if (time.has("dt") && !time.is_text("dt")) {
      const double ratio = static_cast<double>(ladder.cells.front()) / ladder.cells[i];
      result.set("time.dt", time.positive("dt") * std::pow(ratio, ladder.dt_exponent));
    }
    tag = "n" + std::to_string(ladder.cells[i]);
  } else if (ladder.axis == Axis::Time) {
    result.set("time.dt", ladder.dt[i]);
    tag = "level" + std::to_string(level);
  } else if (ladder.axis == Axis::Mach) {
    // c = sqrt(7 K/rho0) = U/Ma
    const double sound_speed = result.table("scene").positive("amplitude") / ladder.mach[i];
    const double density = result.table("fluid").positive("density", mpm::Fluid{}.density);
    result.set("fluid.bulk_modulus", density * sound_speed * sound_speed / 7);
    tag = fmt::format("ma{:g}", ladder.mach[i]);
  }
  return result;
}

/// What a matrix of schemes needs to know of one of them before its runs are planned.
Ladder ladder_for(const Study& study, const TomlTable& scene) {
  Ladder ladder = study.ladder;
  if (!study.matrix) return ladder;
  TomlTable copy = scene.overlaid_with(TomlTable::from_text("", ""), "");
  const SceneConfig config = read_scene_config(copy);
  if (config.incompressible) return ladder;  // a variant beside the matrix
  const mpm::FormalOrder formal = formal_order(config);
  // The error in time is held to a part of that in space: dt ~ h^(space/time).
  if (config.auto_step)
    ladder.dt_exponent = formal.space / formal.time;
  else if (ladder.formal_exponent)
    ladder.dt_exponent = formal_dt_exponent(formal);
  ladder.theoretical = expected_order(formal, ladder.axis, ladder.dt_exponent, Location::Grid);
  ladder.theoretical_particles = expected_order(formal, ladder.axis, ladder.dt_exponent, Location::Particles);
  return ladder;
}

using Solver = std::shared_ptr<const ForeignSolver>;

SceneConfig read_for(const Solver& solver, TomlTable scene) {
  return read_scene_config(std::move(scene), solver ? SceneFor::Theirs : SceneFor::Ours);
}

/// Runs that vary the inputs, on the coarsest level: a difference needs no fine grid.
void plan_input_runs(Study& study, const TomlTable& scene, const Ladder& ladder, const std::string& variant,
                     const Solver& solver) {
  const std::vector<std::string> names = input_variants(*study.validation, variant);
  const std::vector<TomlTable> scenes = input_scenes(*study.validation, scene);
  for (std::size_t i = 0; i < names.size(); ++i) {
    PlannedRun planned;
    std::string tag;
    planned.scene = read_for(solver, at_level(scenes[i], ladder, 0, tag));
    give_to(planned, solver, scenes[i]);
    planned.variant = names[i];
    planned.step = planned.scene.cell_size();
    planned.run = study.name + "." + names[i];
    study.runs.push_back(std::move(planned));
  }
}

void plan_runs(Study& study, const TomlTable& scene, const std::string& variant, const Solver& solver) {
  const Ladder ladder = ladder_for(study, scene);
  require_step_by_error(study, scene, ladder, solver != nullptr);
  const std::size_t levels = ladder.axis == Axis::Space  ? ladder.cells.size()
                             : ladder.axis == Axis::Time ? ladder.dt.size()
                             : ladder.axis == Axis::Mach ? ladder.mach.size()
                                                         : 1;
  for (std::size_t level = 0; level < levels; ++level) {
    PlannedRun planned;
    std::string tag;
    planned.scene = read_for(solver, at_level(scene, ladder, static_cast<int>(level), tag));
    give_to(planned, solver, scene);
    if (ladder.axis == Axis::Time)
      for (const mpm::Segment& segment : planned.scene.segments)
        if (std::abs(segment.length(segment.steps - 1) / ladder.dt[level] - 1) > 1e-6)
          scene.fail(
              "ladder.dt",
              fmt::format("holds {} s, which does not divide the time until t = {} s: its last step would "
                          "take {:.6g} s; choose steps that divide it",
                          ladder.dt[level], segment.end, segment.length(segment.steps - 1)));
    planned.variant = variant;
    planned.theoretical = ladder.theoretical;
    planned.theoretical_particles = ladder.theoretical_particles;
    planned.level = static_cast<int>(level);
    planned.step = ladder.axis == Axis::Time   ? ladder.dt[level]
                   : ladder.axis == Axis::Mach ? ladder.mach[level]
                                               : planned.scene.cell_size();
    planned.run = study.name + (variant.empty() ? "" : "." + variant) + (tag.empty() ? "" : "." + tag);
    study.runs.push_back(std::move(planned));
  }
  if (study.validation && study.validation->compares(variant))
    plan_input_runs(study, scene, ladder, variant, solver);
}

/// A study of limits has schemes, and boxes of its own instead of a scene.
void read_limits(Study& study, TomlTable& root) {
  if (!study.matrix) root.fail("stability", "needs the [matrix] of schemes whose limits it measures");
  for (const char* key : {"ladder", "solver", "variant", "compare_with"})
    if (root.has(key)) root.fail(key, "has no meaning beside [stability]");
  const std::vector<MatrixEntry> matrix = read_matrix(root.table("matrix"));
  for (const MatrixEntry& entry : matrix) study.variants.push_back(entry.variant);
  study.stability = read_stability(root.table("stability"), matrix);
  study.stability.toml = root.restricted_to({"matrix", "stability"}).print();
}

/// The study's [solver] with what a variant lays over it, read; null where neither names one.
Solver solver_of(const TomlTable& root, const TomlTable& variant, const std::string& name,
                 const std::filesystem::path& file) {
  TomlTable both = root.restricted_to({"solver"}).overlaid_with(variant.restricted_to({"solver"}), name);
  if (!both.has("solver")) return nullptr;
  return std::make_shared<const ForeignSolver>(read_solver(both.table("solver"), file));
}

void read_variants(Study& study, TomlTable& root, const TomlTable& base, const std::filesystem::path& file) {
  const Solver all = study.solver ? std::make_shared<const ForeignSolver>(*study.solver) : nullptr;
  if (study.matrix) {
    for (const MatrixEntry& entry : read_matrix(root.table("matrix"))) {
      const TomlTable scheme = TomlTable::from_text(entry.toml(), "matrix");
      study.variants.push_back(entry.variant);
      plan_runs(study, base.overlaid_with(scheme, "scheme " + entry.variant), entry.variant, all);
    }
  }
  std::vector<TomlTable> variants = root.tables("variant");

  if (variants.empty() && !study.matrix) {
    study.variants = {""};
    plan_runs(study, base, "", all);
    return;
  }
  for (TomlTable& variant : variants) {
    const std::string name = variant.text("name");
    if (!reports::is_plain_name(name)) variant.fail("name", "may hold letters, digits and . _ = - only");
    if (std::ranges::count(study.variants, name) > 0) variant.fail("name", "'" + name + "' stands twice");
    study.variants.push_back(name);
    const TomlTable overrides = variant.restricted_to(scene_tables());
    for (const std::string& key : scene_tables()) variant.accept(key);
    const bool own = variant.has("solver");
    TomlTable scene = base.overlaid_with(overrides, "variant " + name);
    if (variant.has("without"))
      for (const std::string& key : variant.texts("without"))
        if (!scene.erase(key)) variant.fail("without", "'" + key + "' is no key of the scene");
    variant.refuse_unknown_keys();
    plan_runs(study, scene, name, own ? solver_of(root, variant, "variant " + name, file) : all);
  }
}

ClaimSpec read_claim(TomlTable& table) {
  ClaimSpec claim{table.text("id"), table.text("source"), table.text("statement"), table.text("verdict"),
                  table.text("note", "")};
  if (claim.verdict != "confirmed" && claim.verdict != "refuted" &&
      claim.verdict != "confirmed within bounds")
    table.fail("verdict", "must be \"confirmed\", \"refuted\" or \"confirmed within bounds\"");
  table.refuse_unknown_keys();
  return claim;
}

/// Every claim rests on a check, and every check that names a claim names one that is there.
void require_evidence(const TomlTable& root, const Study& study) {
  for (const ClaimSpec& claim : study.claims)
    if (std::ranges::count(study.checks, claim.id, &CheckSpec::claim) == 0)
      root.fail("statement", "'" + claim.id + "' rests on no check; name it as evidence_for in a [[check]]");
  for (const CheckSpec& check : study.checks)
    if (!check.claim.empty() && std::ranges::count(study.claims, check.claim, &ClaimSpec::id) == 0)
      root.fail("check", "is evidence for '" + check.claim + "', which is not there");
}

/// expected_checks = N: a study that comes to make fewer checks is refused, whatever made them go.
void read_declared_checks(TomlTable& root, Study& study) {
  if (!root.has("expected_checks")) return;
  const int declared = root.integer("expected_checks");
  if (declared < 1) root.fail("expected_checks", "must be at least 1");
  study.declared_checks = static_cast<std::size_t>(declared);
  const auto computed = expected_checks(study);
  const auto is_declared = [&](std::optional<std::size_t> count) {
    return !count || *count == *study.declared_checks;
  };
  // Where the runs have a say, any of what they may deliver.
  if (study.solver && !study.solver->locations_known)
    for (const Location location : study.solver->locations)
      if (is_declared(expected_checks(study.at_locations({location})))) return;
  if (!is_declared(computed))
    root.fail("expected_checks",
              fmt::format("says {}, and the checks of this study come to {}: correct whichever is wrong",
                          declared, *computed));
}

}  // namespace

Study read_study(const std::filesystem::path& file, const std::string& topic) {
  TomlTable root = TomlTable::from_file(file.string());
  Study study;
  // The key of the study in every table: the file's name, unless it needs letters that a file had better not.
  study.name = root.text("name", file.stem().string());
  if (!reports::is_plain_name(study.name))
    throw ConfigError(file.string() +
                      ": a study is named after its file, or by name = \"...\": letters, digits and . _ = - "
                      "only, no dot or dash first");
  study.topic = root.text("topic", topic);
  study.title = root.text("title");
  study.claim = root.text("claim");
  try {
    study.suite = suite_named(root.text("suite", "full"));
  } catch (const ConfigError& error) {
    root.fail("suite", error.what());
  }
  read_comparison(root, file, study);
  study.ladder = read_ladder(root.table("ladder"), root.has("ladder"), root.has("matrix"));
  study.matrix = root.has("matrix");
  study.repetitions = root.integer("repetitions", 0);
  if (study.repetitions < 0 || study.repetitions > 1000) root.fail("repetitions", "must lie in [0, 1000]");
  if (root.has("solver")) {
    if (study.repetitions > 0)
      root.fail("repetitions",
                "has no meaning beside [solver]: a foreign solver is run once; remove one of them");
    study.solver = read_solver(root.table("solver"), file);
  }
  if (root.has("stability")) {
    read_limits(study, root);
  } else {
    for (const std::string& key : scene_tables()) root.accept(key);
    if (root.has("validation")) study.validation = read_validation(root.table("validation"), file, study);
    read_variants(study, root, root.restricted_to(scene_tables()), file);
    if (study.validation) require_places(study);
    require_comparable(root, study);
    read_scoreboard(root, study);
  }
  for (TomlTable& table : root.tables("check")) study.checks.push_back(read_check(table, study));
  if (study.checks.empty() && !study.validation)
    root.fail("check", "is missing: a study without a check proves nothing; add a [[check]]");
  read_declared_checks(root, study);
  require_decidable(root, study);
  for (TomlTable& table : root.tables("statement")) study.claims.push_back(read_claim(table));
  require_evidence(root, study);
  for (TomlTable& table : root.tables("figure")) study.figures.push_back(read_figure(table, study));
  if (study.validation) add_validation_figures(study, study.validation->rules);
  if (!study.figures.empty() && study.scoreboard &&
      !(study.scoreboard->in_full.empty() && study.scoreboard->in_quick.empty()))
    root.fail("figure",
              "cannot show a study of which a lesser suite runs a part; remove it, or in_full and in_quick");
  if (root.has("control")) study.control = read_control(root.table("control"), study, file);
  require_delivered(root, study);
  root.refuse_unknown_keys();
  return study;
}

void require_distinct_runs(const std::vector<Study>& studies) {
  std::map<std::string, std::string> owner;
  for (const Study& study : studies)
    for (const PlannedRun& run : study.runs) {
      const auto [found, added] = owner.emplace(run.run, study.name);
      if (!added)
        throw ConfigError(
            fmt::format("studies '{}' and '{}' both have a run named '{}': they would write the same "
                        "files; rename a study or a variant",
                        found->second, study.name, run.run));
    }
}

}  // namespace verification

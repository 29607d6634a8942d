#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "verification/checks/expected_checks.hpp"
#include "verification/commands/commands.hpp"
#include "verification/commands/output.hpp"
#include "verification/reading/study_folder.hpp"
#include "verification/reading/study_reader.hpp"
#include "verification/scene/scene_cost.hpp"

namespace verification {
namespace {

std::string compared_with(const Study& study) {
  switch (study.comparison) {
    case Comparison::Discrete:
      return "the exact solution of its own discrete scheme";
    case Comparison::SteadyNodes:
      return "the scheme's own steady nodes";
    case Comparison::Table:
      return study.table->description();
    case Comparison::Finest:
      return "its own finest level";
    default:
      return "the exact or reference solution of its flow";
  }
}

std::string bounds_of(const CheckSpec& check) {
  if (std::isfinite(check.lower) && std::isfinite(check.upper))
    return fmt::format("{:.6g} to {:.6g}", check.lower, check.upper);
  if (std::isfinite(check.upper)) return fmt::format("at most {:.6g}", check.upper);
  if (std::isfinite(check.lower)) return fmt::format("at least {:.6g}", check.lower);
  if (check.tolerance > 0) return fmt::format("theory +- {:.6g}", check.tolerance);
  return "as the study declares";
}

/// "usf, musl", or how many where a screen would not hold them.
std::string joined(const std::vector<std::string>& words) {
  if (words.size() > 8) return fmt::format("{} and {} more", words.front(), words.size() - 1);
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : ", ") + (word.empty() ? "the scene" : word);
  return text;
}

void print_scene(const Study& study) {
  const PlannedRun& run = study.runs.front();
  const SceneConfig& scene = run.scene;
  say("flow        {}, {}\n", scene.flow_name, scene.fluid.label);
  if (!run.solver)
    say("scheme      {}, {}, {}{}\n", mpm::name(scene.scheme.basis), mpm::name(scene.scheme.transfer),
        mpm::name(scene.scheme.stepping), study.variants.size() > 1 ? " (first variant)" : "");
  else
    say("solver      {}: {}\n", run.solver->name,
        run.solver->is_there() ? "results in " + run.solver->results
                               : fmt::format("{}", fmt::join(run.solver->command, " ")));
  if (scene.auto_step)
    say("dt          auto: pilot runs on {} cells choose it, error in time {:g} of that in space; costs "
        "below are "
        "at {:.3g} s there\n",
        scene.discretisation.cells, scene.auto_step->fraction, scene.segments.front().dt);
  say("until       {:.6g} s, {} output times\n", scene.outputs.back(), scene.outputs.size());
  say("against     {}\n", compared_with(study));
  if (study.ladder.axis != Axis::None) {
    std::string levels;
    for (const PlannedRun* level : study.runs_of(study.variants.front()))
      levels += fmt::format("{}{:.4g}", levels.empty() ? "" : ", ", level->step);
    say("refined     in {}: {}\n", name(study.ladder.axis), levels);
  }
}

}  // namespace

int explain_command(const ExplainOptions& options) {
  const Study study = options.study.ends_with(".toml") ? read_study(options.study)
                                                       : read_study_named(options.studies, options.study);
  say("{}: {}\n{}\n\n", study.name, study.title, study.claim);
  say("suite       {}{}\n", name(study.suite), study.topic.empty() ? "" : ", topic " + study.topic);
  if (!study.runs.empty()) print_scene(study);
  say("variants    {}\n", joined(study.variants));
  const std::size_t jobs = study.runs.size() + study.stability.cases.size();
  say("costs       {} runs{}, {:.3g} particle-steps, about {:.1f} s on one core\n", jobs,
      study.repetitions > 0 ? fmt::format(", each timed up to {} times after a warm-up", study.repetitions)
                            : "",
      study.particle_steps(), study.particle_steps() * (study.repetitions + 1) / particle_steps_per_second);
  say("\nchecks, and why those bounds:\n");
  for (const CheckSpec& check : study.checks) {
    std::string what = check.kind;
    if (!check.quantity.empty()) what += ", " + check.quantity;
    if (!check.norm.empty()) what += ", " + check.norm;
    if (!check.against.empty()) what += ", against " + check.against;
    say("- {}: {}  [{}]\n  {}\n", what, bounds_of(check), joined(check.variants), check.reason);
    if (!check.claim.empty()) say("  evidence for: {}\n", check.claim);
  }
  if (!study.runs.empty() && std::ranges::none_of(study.checks, [](const CheckSpec& c) {
        return c.kind == "divergence" || c.kind == "outcome";
      }))
    say("- runs that did not complete: 0\n  no run of this study is expected to diverge\n");
  if (const auto expected = study.declared_checks ? study.declared_checks : expected_checks(study))
    say("{} checks in all\n", *expected);
  if (study.control) {
    say("\nnegative control, planted: {}\n", study.control->planted);
    for (const ControlSpec::MustFail& must : study.control->must_fail)
      say("- must be red: {} ({}){}\n", must.check, must.count,
          must.because.empty() ? "" : ", because of \"" + must.because + "\"");
  }
  for (const ClaimSpec& claim : study.claims)
    say("\nclaim ({}): {}\n  declared: {}. {}\n", claim.source, claim.statement, claim.verdict, claim.note);
  if (!study.figures.empty()) say("\nfigures:\n");
  for (const auto& figure : study.figures) say("- {} ({})\n", figure.title, figure.kind);
  return 0;
}

}  // namespace verification

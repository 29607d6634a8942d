#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <string>

#include "build_info.hpp"
#include "reports/files/io_error.hpp"
#include "reports/process/child.hpp"
#include "solver/kernel/isa.hpp"
#include "solver/scene/scene.hpp"
#include "verification/commands/commands.hpp"
#include "verification/commands/elsewhere/shard_app.hpp"
#include "verification/commands/output.hpp"
#include "verification/config/config_error.hpp"
#include "verification/reading/study_folder.hpp"

namespace {

std::string joined(int argc, char** argv) {
  std::string line;
  for (int i = 0; i < argc; ++i) line += (i ? " " : "") + std::string(argv[i]);
  return line;
}

int dispatch(int argc, char** argv) {
  using namespace verification;
  CLI::App app(
      "Verification of particle solvers of viscous flow: refinement studies, exact solutions, a verdict.");
  app.set_version_flag("--version", std::string(build_info::version) + " (" + build_info::commit + ")");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 all checks pass, 1 a check failed, 2 usage or configuration, 3 internal or solver "
      "error.");

  std::string studies;
  const char* studies_help =
      "Directory of the studies (default: $MPM_STUDIES, else beside the program, else where it was built)";
  ListOptions list;
  auto* list_app = app.add_subcommand("list", "Studies, what each claims, and what it costs");
  list_app->add_option("--suite", list.suite, "quick, full, deep or peers (default: deep)");
  list_app->add_flag("--names", list.names, "Names alone, one a line");
  list_app->add_option("--studies", studies, studies_help);

  ExplainOptions explain;
  auto* explain_app =
      app.add_subcommand("explain", "What a study runs and checks, why those bounds, and what it costs");
  explain_app->add_option("STUDY", explain.study, "Name of a study or path of a study file")->required();
  explain_app->add_option("--studies", studies, studies_help);

  ShardApp elsewhere(app, studies, studies_help);

  SchemaOptions schema;
  auto* schema_app =
      app.add_subcommand("schema", "JSON Schema of study files, by which editors complete and check them");
  auto* scene_schema = schema_app->add_flag("--scene", schema.scene, "Of scene files");
  schema_app->add_flag("--markdown", schema.markdown, "The page of all keys instead")->excludes(scene_schema);

  RunOptions run;
  auto* run_app = app.add_subcommand("run", "Run studies and judge them");
  run_app->add_option("STUDY", run.names,
                      "Names of studies or paths of study files (default: the whole suite)");
  run_app->add_option("--suite", run.suite, "quick, full, deep or peers (default: full)");
  run_app->add_option("--out", run.out, "Directory of the results")->capture_default_str();
  run_app->add_option("--jobs", run.jobs, "Runs at the same time (default: one a core)")
      ->check(CLI::Range(1, 1024));
  run_app->add_option("--studies", studies, studies_help);
  auto* no_cache = run_app->add_flag("--no-cache", run.no_cache,
                                     "Run everything; neither use nor fill the cache of finished runs");
  run_app->add_flag("--force", run.force,
                    "Write into --out even if it holds files that are no results of ours");
  run_app->add_flag("--fresh", run.fresh, "Run everything, and replace what the cache of finished runs holds")
      ->excludes(no_cache);
  run_app->add_flag(
      "--plain", run.plain,
      "Judge a negative control, a study with [control], as if it were none: red, with exit code 1");
  run_app->add_flag("--resume", run.resume,
                    "Go on with a suite that was stopped or killed in --out: finished runs come from the "
                    "cache, the rest is "
                    "run, with the same bytes as without the stop. Plain `run` does so too; --resume refuses "
                    "a directory in "
                    "which none was begun");

  run_app->add_option("--shard", run.shard,
                      "K/N: only part K of N of the runs, kept in --out for `collect`; judges nothing");
  run_app->add_flag("--pdf", run.pdf, "Print report.pdf too, by a browser (chromium, or $MPM_BROWSER)");
  run_app->add_flag(
      "--keep-profiles", run.keep_profiles,
      "Keep the profiles of every run (without: of those that a figure draws, and of studies that "
      "fail)");

  ReportCommandOptions report;
  auto* report_app =
      app.add_subcommand("report", "Rebuild figures and reports from the CSV files of a directory");
  report_app->add_option("DIR", report.dir, "Directory of results")->required();
  report_app->add_flag("--pdf", report.pdf, "Print report.pdf too, by a browser (chromium, or $MPM_BROWSER)");

  CompareOptions compare;
  auto* compare_app = app.add_subcommand(
      "compare",
      "What changed from OLD to NEW, by how much, and whether beyond noise: checks, runs, errors, orders, "
      "times. "
      "Times are noisy to three times the spread of their repetitions and at least 5 %; a time measured once "
      "is "
      "shown, not judged. Errors below 1e-12 are round-off. Exit code 1 if something got worse: an error, a "
      "time, an order further from theory, a check that turned red");
  compare_app->add_option("OLD", compare.before, "Directory of results, or one CSV file of them")->required();
  compare_app->add_option("NEW", compare.after, "The same, later")->required();
  compare_app
      ->add_option("--tolerance", compare.tolerance, "Relative change of errors and orders that is round-off")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0));
  compare_app->add_flag("--all", compare.all, "List every change, not the first 20 of each file");

  ValidateOptions validate;
  auto* validate_app = app.add_subcommand("validate",
                                          "Compare a run with a table of measurements: E = S - D with the "
                                          "three parts of its uncertainty, verdicts, "
                                          "joint distance. Exit code 1 for a model error that is not borne, "
                                          "and for a comparison that noise leaves open");
  validate_app->add_option("DATA", validate.data, "Table of measurements (CSV)")->required();
  validate_app->add_option("--result", validate.result, "Directory of results, or one with a profile.csv")
      ->required();
  validate_app->add_option("--quantity", validate.quantity, "Quantity of the table (default: the only one)");
  validate_app->add_option("--run", validate.runs, "Runs of one ladder in that directory, coarse to fine");
  validate_app
      ->add_option("--largest-error", validate.largest_error,
                   "Model error that is borne, in the table's unit")
      ->required()
      ->check(CLI::PositiveNumber);
  validate_app->add_option("--coverage", validate.coverage, "Coverage factor k")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  validate_app->add_option("--order", validate.formal_order, "Formal order of the ladder")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  validate_app->add_option("--velocity", validate.velocity, "Velocity V of a scaled table [m/s]")
      ->check(CLI::PositiveNumber);
  validate_app->add_option("--length", validate.length, "Length L of a scaled table [m]")
      ->check(CLI::PositiveNumber);
  validate_app
      ->add_option("--u-num", validate.u_num,
                   "Standard numerical uncertainty relative to |S|, without a ladder")
      ->check(CLI::NonNegativeNumber);
  validate_app->add_option("--u-input", validate.u_input, "Standard uncertainty from inputs relative to |S|")
      ->check(CLI::NonNegativeNumber);
  validate_app->add_option("--out", validate.out,
                           "Directory for tables, figures and a report (default: none)");

  SceneOptions scene;
  auto* solve_app = app.add_subcommand("solve", "One simulation of a scene");
  auto* reference_app =
      app.add_subcommand("reference", "The exact or reference profiles of a scene, no solver");
  for (auto* sub : {solve_app, reference_app}) {
    sub->add_option("SCENE", scene.scene, "Scene file (TOML)")->required();
    sub->add_option("--out", scene.out, "Directory of the results")->required();
    sub->add_flag("--force", scene.force,
                  "Write into --out even if it holds files that are no results of ours");
  }

  solve_app->add_flag("--no-figures", scene.no_figures, "Draw nothing: for timing, and for many scenes");
  int threads = 1;
  std::string isa;
  for (auto* sub : {run_app, solve_app}) {
    sub->add_option("--threads", threads, "Threads of one simulation (results do not depend on it)")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    sub->add_option("--isa", isa, "Instruction set of the vector kernels (default: the machine's best)")
        ->check(CLI::IsMember(mpm::available_isas()));
  }

  CavityTablesOptions tables;
  auto* tables_app = app.add_subcommand(
      "cavity-tables", "Computes the tables of lid-driven cavities of other than Newtonian fluids anew");
  tables_app->add_option("FLUID", tables.fluids, "Names of fluids, as power-law-0.5 (default: all)");
  tables_app->add_option("--out", tables.out, "Directory of the tables")->required();
  tables_app->add_flag("--force", tables.force,
                       "Write into --out even if it holds files that are no results of ours");
  CavityProfileOptions profile;
  auto* profile_app = app.add_subcommand(
      "cavity-profile", "The steady cavity of a scene by the tables' own solvers, on a mesh of its cells");
  profile_app->add_option("SCENE", profile.scene, "Scene file (TOML)")->required();
  profile_app->add_option("--out", profile.out, "Directory, which is there, for profile.csv")->required();
  profile_app->add_flag("--volumes", profile.volumes, "By finite volumes (default: by splines)");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  mpm::use_threads(threads);
  mpm::use_isa(isa.empty() ? mpm::current_isa() : isa);  // a mistake in the environment shows now
  if (*list_app || *run_app || *explain_app || elsewhere.needs_studies()) {
    if (studies.empty()) studies = studies_directory(build_info::studies).string();
    list.studies = run.studies = explain.studies = studies;
  }
  run.command_line = scene.command_line = validate.command_line = joined(argc, argv);
  if (const auto code = elsewhere.run(studies, run.command_line)) return *code;
  if (*list_app) return list_command(list);
  if (*explain_app) return explain_command(explain);
  if (*schema_app) return schema_command(schema);
  if (*run_app) return run_command(run);
  if (*compare_app) return compare_command(compare);
  if (*validate_app) return validate_command(validate);
  if (*report_app) return report_command(report);
  if (*tables_app) {
    tables.command_line = joined(argc, argv);
    return cavity_tables_command(tables);
  }
  if (*profile_app) return cavity_profile_command(profile);
  if (*solve_app) return solve_command(scene);
  return reference_command(scene);
}

}  // namespace

int main(int argc, char** argv) {
  verification::hold_standard_streams();
  reports::end_children_on_signals();
  try {
    return verification::finish_output(dispatch(argc, argv));
  } catch (const verification::ConfigError& error) {
    verification::warn("mpm-verify: {}\n", error.what());
    return 2;
  } catch (const reports::IoError& error) {
    verification::warn("mpm-verify: {}\n", error.what());
    return 2;
  } catch (const mpm::SceneError& error) {
    verification::warn("mpm-verify: {}\n", error.what());
    return 2;
  } catch (const std::bad_alloc&) {
    verification::warn(
        "mpm-verify: out of memory: give fewer cells, particles or outputs, or fewer --jobs\n");
    return 2;
  } catch (const std::exception& error) {
    verification::warn("mpm-verify: internal error: {}\n", error.what());
    return 3;
  }
}

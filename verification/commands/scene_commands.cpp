#include <fmt/format.h>

#include "reports/files/atomic_file.hpp"
#include "reports/pages/report.hpp"
#include "reports/records/directory/result_directory.hpp"
#include "reports/records/directory/result_files.hpp"
#include "reports/records/directory/run_files.hpp"
#include "verification/commands/commands.hpp"
#include "verification/commands/output.hpp"
#include "verification/commands/provenance_of.hpp"
#include "verification/commands/suite_session.hpp"
#include "verification/config/config_error.hpp"
#include "verification/flows/reference_store.hpp"
#include "verification/runs/measures.hpp"
#include "verification/runs/pilot/fits.hpp"
#include "verification/runs/run_simulation.hpp"
#include "verification/scene/scene_cost.hpp"

namespace verification {
namespace {

/// One simulation is made again in a moment: waiting for the disk a dozen times would be most of its time.
constexpr auto unsynced = reports::Durability::Unsynced;

/// The single run of a scene file, as a study without checks.
Study study_of_scene(const SceneOptions& options) {
  Study study;
  study.name = options.scene.stem().string();
  if (!reports::is_plain_name(study.name))
    throw ConfigError(options.scene.string() +
                      ": the file's name becomes the run's: letters, digits and . _ = - only");
  study.variants = {""};
  PlannedRun planned;
  planned.scene = read_scene_config(TomlTable::from_file(options.scene.string()));
  planned.run = study.name;
  planned.step = planned.scene.cell_size();
  study.title = study.claim = planned.scene.flow_name + ", one simulation";
  study.runs.push_back(std::move(planned));
  return study;
}

/// Refuses dt = "auto" where it cannot be had, before anything is written.
void require_step(const Study& study, const std::filesystem::path& file) {
  const SceneConfig& scene = study.runs.front().scene;
  if (!scene.auto_step) return;
  if (const std::string why = why_no_step_by_error(study, study.ladder, scene, false); !why.empty())
    throw ConfigError(file.string() + ": key 'time.dt': " + why);
}

/// Runs the pilot of a scene with dt = "auto".
void choose_step(Study& study, const std::filesystem::path& file) {
  // A cache, even one that is off, reads the whole program: as long as a short simulation takes.
  if (!study.runs.front().scene.auto_step) return;
  std::vector<Study> one{study};
  RunCache none({}, CacheUse::Off);
  settle_and_say(one, none, 1);
  study = one.front();
  for (const reports::TimeStepRecord& step : study.time_steps)
    if (step.bound == reports::no_step) throw ConfigError(file.string() + ": key 'time.dt': " + step.remark);
}

reports::FigureRecord figure_of(const Study& study, const std::string& kind, const std::string& title) {
  const PlannedRun& plan = study.runs.front();
  reports::FigureRecord figure;
  figure.figure = study.name + "-" + kind;
  figure.study = study.name;
  figure.kind = kind;
  figure.title = title;
  figure.runs = plan.run;
  figure.across = plan.scene.flow->across() == 0 ? "x" : "y";
  figure.component = plan.scene.flow->probe().direction.x() != 0 ? "u" : "v";
  figure.location = "grid;particles";
  figure.norm = "l2";
  return figure;
}

/// The profile as an external solver would hand it in: the interchange file of `[solver]` studies.
void write_interchange(const std::filesystem::path& out, const RunData& data) {
  std::string text = "t,location,x,y,u,v\n";
  for (const reports::ProfileRow& row : data.profile)
    if (row.location != "exact")
      text += fmt::format("{},{},{},{},{},{}\n", row.t, row.location, row.x, row.y, row.u, row.v);
  reports::keep_file(out / "profile.csv", text);
}

}  // namespace

int solve_command(const SceneOptions& options) {
  Study study = study_of_scene(options);
  require_step(study, options.scene);
  const reports::ResultDirectory ours(options.out, options.force);
  reports::ensure_directory(options.out / "profiles");
  reports::write_provenance(options.out, provenance_of(options.command_line), unsynced);
  choose_step(study, options.scene);
  const SceneConfig& scene = study.runs.front().scene;
  say("{}: {}\n", study.name, described_cost(scene));
  std::fflush(stdout);
  if (const std::string warning = step_warning(scene); !warning.empty())
    warn("warning: {}: {}\n", study.name, warning);
  RunData data = run_simulation(study, study.runs.front());
  data.errors = measure_errors(data);
  reports::write_profile(options.out, data.record.run, data.profile);
  reports::write_history(options.out, data.record.run, data.history);
  if (!data.shear.empty()) reports::write_shear(options.out, data.record.run, data.shear);
  if (!data.state.empty()) reports::write_state(options.out, data.record.run, data.state);
  if (!data.surface.empty()) reports::write_surface(options.out, data.record.run, data.surface);
  write_interchange(options.out, data);

  reports::Results results;
  results.time_steps = study.time_steps;
  results.pilots = study.pilots;
  results.studies.push_back({study.name, study.title, study.claim, "", ""});
  results.runs.push_back(data.record);
  results.timings.push_back(data.timing);
  results.errors = data.errors;
  results.figures = {
      figure_of(study, "profiles", study.runs.front().scene.flow_name + ": velocity profiles"),
      figure_of(study, "history", study.runs.front().scene.flow_name + ": velocity at the probe")};
  reports::write_results(options.out, results, unsynced);
  if (!options.no_figures)
    for (const std::string& warning : reports::write_figures(options.out, {cache_directory(), job_count(0)}))
      warn("warning: {}\n", warning);

  say("{}: {}; {} particles, {} steps, {:.3g} s, {:.3g} particle-steps/s\n", data.record.run,
      data.record.status, data.record.particles, data.record.steps, data.timing.wall_s,
      data.timing.particle_steps_per_s);
  if (study.runs.front().scene.flow->has_exact()) {
    say("errors relative to {:.6g} m/s\n{:>12} {:<10} {:>12} {:>12} {:>12}\n",
        study.runs.front().scene.flow->velocity_scale(), "t [s]", "location", "L1", "L2", "Linf");
    for (const reports::ErrorRecord& e : data.errors)
      say("{:>12} {:<10} {:>12.4e} {:>12.4e} {:>12.4e}\n", e.t, e.location, e.l1, e.l2, e.linf);
  }
  return data.completed() ? 0 : 3;
}

int reference_command(const SceneOptions& options) {
  const Study study = study_of_scene(options);
  const SceneConfig& scene = study.runs.front().scene;
  const auto exact = scene.flow->exact(scene.reference_times());
  if (!exact)
    throw ConfigError(options.scene.string() + ": key 'scene.flow': no exact solution is known for '" +
                      scene.flow_name + "'");
  const reports::ResultDirectory ours(options.out, options.force);
  reports::ensure_directory(options.out / "profiles");
  reports::write_provenance(options.out, provenance_of(options.command_line));
  reports::write_profile(options.out, study.name, exact_lines(scene, *exact));
  if (const auto shear = exact_shear(scene, *exact); !shear.empty())
    reports::write_shear(options.out, study.name, shear);
  if (const auto state = exact_state(scene, *exact); !state.empty())
    reports::write_state(options.out, study.name, state);
  say("{}: {}\n", study.name, exact->description());
  say("profiles at {} times: {}\n", scene.outputs.size(),
      (options.out / "profiles" / (study.name + ".csv")).string());
  return 0;
}

}  // namespace verification

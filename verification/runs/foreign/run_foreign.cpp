#include "verification/runs/foreign/run_foreign.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "reports/files/atomic_file.hpp"
#include "reports/files/csv.hpp"
#include "reports/files/io_error.hpp"
#include "reports/process/child.hpp"
#include "solver/kernel/isa.hpp"
#include "verification/not_a_number.hpp"
#include "verification/runs/foreign/delivered_files.hpp"
#include "verification/runs/foreign/what_decides.hpp"
#include "verification/runs/interruption.hpp"

namespace verification {
namespace {

namespace fs = std::filesystem;
std::string replaced(std::string text, const std::string& mark, const std::string& value) {
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size()))
    text.replace(at, mark.size(), value);
  return text;
}

reports::ChildCommand command_of(const ForeignSolver& solver, const PlannedRun& plan, const fs::path& out,
                                 const fs::path& folder) {
  std::error_code ignored;
  const std::pair<const char*, std::string> values[] = {
      {"{scene}", fs::absolute(out / "scenes" / (plan.run + ".toml")).string()},
      {"{out}", fs::absolute(folder).string()},
      {"{run}", plan.run},
      {"{cells}", std::to_string(plan.scene.discretisation.cells)},
      {"{dt}", fmt::format("{}", plan.scene.segments.front().dt)},
      {"{cores}", std::to_string(solver.cores)},
      {"{threads}", std::to_string(mpm::default_threads())},
      {"{mpm-verify}", fs::read_symlink("/proc/self/exe", ignored).string()},
  };
  reports::ChildCommand command;
  for (std::string word : solver.command) {
    for (const auto& [mark, value] : values) word = replaced(word, mark, value);
    command.arguments.push_back(word);
  }
  command.directory = solver.directory;
  command.environment = solver.environment;
  command.log = folder / "log.txt";
  command.timeout = solver.timeout;
  command.stop = interruption_noted;
  return command;
}

/// An empty directory of the run's own: what an earlier run left there would be judged for this one's.
fs::path fresh_folder(const fs::path& out, const std::string& run) {
  const fs::path folder = out / "external" / run;
  if (fs::is_symlink(folder)) throw reports::IoError(folder.string() + ": is a link; remove it");
  std::error_code error;
  fs::remove_all(folder, error);
  reports::ensure_directory(folder);
  return folder;
}

/// Streamwise velocity at the probe of a channel at each output, between the two rows of the grid (or,
/// without one, the particles) that lie about it; NaN for other flows.
std::vector<double> probe_from_profile(const std::vector<reports::ProfileRow>& rows,
                                       const SceneConfig& scene) {
  const Probe probe = scene.flow->probe();
  const int across = scene.flow->across();
  std::vector<double> values;
  for (const double t : scene.outputs) {
    const reports::ProfileRow *below = nullptr, *above = nullptr;
    const auto place = [&](const reports::ProfileRow& row) { return across == 0 ? row.x : row.y; };
    const double wanted = probe.point[across];
    for (const char* location : {"particles", "grid"})  // the grid's last: it is preferred
      for (const reports::ProfileRow& row : rows) {
        if (row.t != t || row.location != location) continue;
        if (place(row) <= wanted && (!below || below->location != location || place(row) > place(*below)))
          below = &row;
        if (place(row) >= wanted && (!above || above->location != location || place(row) < place(*above)))
          above = &row;
      }
    if (!scene.flow->has_shear_profile() || !below || !above) {
      values.push_back(nan);
      continue;
    }
    const double gap = place(*above) - place(*below), f = gap > 0 ? (wanted - place(*below)) / gap : 0;
    values.push_back((1 - f) * Vec2(below->u, below->v).dot(probe.direction) +
                     f * Vec2(above->u, above->v).dot(probe.direction));
  }
  return values;
}

constexpr const char* packed_files[] = {"profile.csv", "history.csv", "shear.csv",
                                        "state.csv",   "run.json",    "log.txt"};

/// What a solver left, and how long it took, as bytes: what is kept is judged as if it had just been made.
std::string packed(const fs::path& folder, double seconds) {
  std::string bytes = fmt::format("{}\n", seconds);
  for (const char* name : packed_files) {
    if (!fs::is_regular_file(folder / name)) continue;
    const std::string content = reports::read_file(folder / name);
    bytes += fmt::format("{} {}\n", name, content.size()) + content;
  }
  return bytes;
}

/// The same the other way; the seconds. None for bytes that are not whole.
std::optional<double> unpacked(const std::string& bytes, const fs::path& folder) {
  std::istringstream in(bytes);
  double seconds = 0;
  if (!(in >> seconds) || in.get() != '\n') return std::nullopt;
  std::string name;
  std::size_t size = 0;
  while (in >> name >> size) {
    const auto at = static_cast<std::size_t>(in.tellg()) + 1;
    if (std::ranges::count(packed_files, name) == 0 || at + size > bytes.size()) return std::nullopt;
    reports::write_file(folder / name, std::string_view(bytes).substr(at, size),
                        reports::Durability::Unsynced);
    in.seekg(static_cast<std::streamoff>(at + size));
  }
  return seconds;
}

/// Where the results are, and what is known of how they were made.
struct Source {
  fs::path folder;
  double seconds = nan;
  bool kept = false;
  std::string key;  ///< under which they are to be kept once they are found whole; "" for none
};

Source make_results(const PlannedRun& plan, const fs::path& out, const fs::path& folder,
                    const std::string& version, const KeptDeliveries& kept) {
  const ForeignSolver& solver = *plan.solver;
  if (solver.is_there()) {
    const fs::path there = replaced(solver.results, "{run}", plan.run);
    if (!fs::is_directory(there))
      throw std::runtime_error(solver.name + ": no results in " + there.string() +
                               ": put profile.csv there, and judge again");
    return {there, nan, false, ""};
  }
  const std::string key = kept.load || kept.save ? what_decides(plan, version) : "";
  if (!key.empty() && kept.load)
    if (const auto bytes = kept.load(key))
      if (const auto seconds = unpacked(*bytes, folder)) return {folder, *seconds, true, ""};
  if (!kept.may_run) throw std::runtime_error("is not among the finished runs, and nothing may be run here");
  const reports::ChildCommand command = command_of(solver, plan, out, folder);
  const reports::ChildEnd end = reports::run_child(command);
  throw_if_interrupted();
  if (!end.well()) throw std::runtime_error(end.cause());
  return {folder, end.seconds, false, key};
}

}  // namespace

RunData run_foreign(const Study& study, const PlannedRun& plan, const fs::path& out,
                    const KeptDeliveries& kept) {
  const SceneConfig& scene = plan.scene;
  const ForeignSolver& solver = *plan.solver;
  const fs::path folder = fresh_folder(out, plan.run);
  RunData data;
  data.plan = &plan;
  data.foreign = true;
  data.record = describe_run(study, plan, reports::unknown_count, "completed");
  data.record.basis = data.record.transfer = data.record.stepping = data.record.reset =
      reports::foreign_scheme;
  data.record.method = solver.name;
  data.record.particles = reports::unknown_count;
  if (!scene.dt_given) data.record.dt = nan;
  data.timing.run = plan.run;
  try {
    const std::string version = version_of(solver);
    if (!version.empty()) data.record.method += " " + version;
    const Source source = make_results(plan, out, folder, version, kept);
    data.timing.wall_s = source.seconds;
    data.timing.clock = reports::clock_process;
    if (source.kept) data.timing.source = reports::timing_from_cache;
    read_delivery(study, plan, source.folder, folder, data);
    read_run_json(source.folder / "run.json", solver, data);
    if (!source.key.empty() && kept.save) kept.save(source.key, packed(folder, source.seconds));
  } catch (const reports::IoError&) {
    throw;
  } catch (const std::runtime_error& error) {
    const std::string tail = reports::last_lines(folder / "log.txt", 5), what = error.what();
    throw std::runtime_error((what.starts_with(solver.name + ": ") ? "" : solver.name + ": ") + what +
                             (tail.empty() ? "" : "; its log ends: " + tail));
  }
  data.probe = probe_from_profile(data.profile, scene);
  const bool counted =
      data.record.particles != reports::unknown_count && data.record.steps != reports::unknown_count;
  data.timing.particle_steps_per_s = counted ? static_cast<double>(data.record.particles) *
                                                   static_cast<double>(data.record.steps) / data.timing.wall_s
                                             : nan;
  return data;
}

}  // namespace verification

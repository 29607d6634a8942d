#include "verification/runs/foreign/run_foreign.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "reports/files/csv.hpp"
#include "reports/files/io_error.hpp"
#include "reports/process/child.hpp"
#include "solver/kernel/isa.hpp"
#include "verification/runs/foreign/delivery.hpp"
#include "verification/runs/interruption.hpp"
#include "verification/runs/run_simulation.hpp"

namespace verification {
namespace {

namespace fs = std::filesystem;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

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

/// A foreign file without its comments, and with a column of zeros for a v that it leaves out.
fs::path normalised(const fs::path& file, bool may_lack_v) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("it left no " + file.filename().string());
  std::string text, line;
  bool header = true, add_v = false;
  while (std::getline(in, line)) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    if (header) {
      const std::string columns = "," + line + ",";
      add_v = may_lack_v && columns.find(",v,") == std::string::npos;
    }
    text += line + (add_v ? (header ? ",v" : ",0") : "") + "\n";
    header = false;
  }
  const fs::path read = file.string() + ".read";
  reports::write_file(read, text);
  return read;
}

std::vector<reports::ProfileRow> read_profile(const fs::path& file, bool may_lack_v) {
  using Row = reports::ProfileRow;
  const auto columns =
      std::make_tuple(reports::column("t", &Row::t), reports::column("location", &Row::location),
                      reports::column("x", &Row::x), reports::column("y", &Row::y),
                      reports::column("u", &Row::u), reports::column("v", &Row::v));
  return reports::read_csv(normalised(file, may_lack_v), columns);
}

std::vector<reports::HistoryRow> read_history(const fs::path& file) {
  using Row = reports::HistoryRow;
  const auto columns = std::make_tuple(
      reports::column("t", &Row::t), reports::column("probe", &Row::probe),
      reports::column("mass", &Row::mass), reports::column("momentum_x", &Row::momentum_x),
      reports::column("momentum_y", &Row::momentum_y), reports::column("impulse_x", &Row::impulse_x),
      reports::column("impulse_y", &Row::impulse_y), reports::column("kinetic_energy", &Row::kinetic_energy));
  return reports::read_csv(normalised(file, false), columns);
}

void add_history(const ForeignSolver& solver, const fs::path& folder, const SceneConfig& scene,
                 const ExactField* exact, RunData& data) {
  if (!solver.delivers_record(Record::History)) return;
  data.history = read_history(folder / "history.csv");
  const Probe probe = scene.flow->probe();
  for (reports::HistoryRow& row : data.history) {
    row.probe_exact = exact ? exact->velocity(probe.point, row.t, Location::Grid).dot(probe.direction) : nan;
    row.kinetic_energy_exact = exact ? exact->kinetic_energy(row.t).value_or(nan) : nan;
  }
  if (data.history.size() < 2 || !(data.history.back().t >= scene.outputs.back() * (1 - 1e-6)))
    throw std::runtime_error(fmt::format("history.csv ends before t = {} s", scene.outputs.back()));
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

/// What the solver says of itself in run.json, where it leaves one. Throws where that is a failure.
void read_run_json(const fs::path& file, RunData& data) {
  std::ifstream in(file);
  if (!in) return;
  try {
    const nlohmann::json json = nlohmann::json::parse(in);
    const std::string status = json.value("status", "completed"), message = json.value("message", "");
    if (status != "completed")
      throw std::runtime_error("its run.json says '" + status + "'" +
                               (message.empty() ? "" : ": " + message));
    if (const std::string version = json.value("version", ""); !version.empty())
      data.record.method += " " + version;
    data.record.steps = json.value("steps", data.record.steps);
    data.record.particles = json.value("particles", data.record.particles);
    data.record.cells = json.value("cells", data.record.cells);
    data.record.dt = json.value("dt", data.record.dt);
    data.timing.wall_s = json.value("wall_s", data.timing.wall_s);
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(std::string("its run.json cannot be read: ") + error.what());
  }
}

}  // namespace

RunData run_foreign(const Study& study, const PlannedRun& plan, const fs::path& out) {
  const SceneConfig& scene = plan.scene;
  const ForeignSolver& solver = *study.solver;
  const fs::path folder = fresh_folder(out, plan.run);
  const reports::ChildCommand command = command_of(solver, plan, out, folder);
  const reports::ChildEnd end = reports::run_child(command);
  throw_if_interrupted();
  const auto fail = [&](const std::string& what) {
    const std::string tail = reports::last_lines(command.log, 5);
    throw std::runtime_error(solver.name + ": " + what + (tail.empty() ? "" : "; its log ends: " + tail));
  };
  if (!end.well()) fail(end.text());

  RunData data;
  data.plan = &plan;
  data.foreign = true;
  const auto exact = compared_with(study, scene);
  const bool channel_along_x = scene.flow->has_shear_profile() && scene.flow->across() == 1;
  try {
    data.profile = read_profile(folder / "profile.csv", channel_along_x);
    add_history(solver, folder, scene, exact.get(), data);
  } catch (const reports::IoError& error) {
    fail(error.what());  // the fault of the foreign solver, not of our result directory
  } catch (const std::runtime_error& error) {
    fail(error.what());
  }
  const std::vector<std::string> lacks = shortcomings(data.profile, plan, solver);
  if (!lacks.empty()) fail(fmt::format("its profile.csv is not whole: {}", fmt::join(lacks, "; ")));
  for (reports::ProfileRow& row : data.profile) {
    row.t = output_time(scene, row.t);
    const Location location = row.location == "grid" ? Location::Grid : Location::Particles;
    const Vec2 v = exact ? exact->velocity({row.x, row.y}, row.t, location) : Vec2(nan, nan);
    row.u_exact = v.x();
    row.v_exact = v.y();
  }
  if (exact && study.comparison == Comparison::Exact) {
    const auto rows = exact_lines(scene, *exact);
    data.profile.insert(data.profile.end(), rows.begin(), rows.end());
  }
  data.probe = probe_from_profile(data.profile, scene);
  data.record = describe_run(study, plan, scene.steps(), "completed");
  data.record.basis = data.record.transfer = data.record.stepping = data.record.reset =
      reports::foreign_scheme;
  data.record.method = solver.name;
  data.timing.run = plan.run;
  data.timing.wall_s = end.seconds;
  data.timing.particle_steps_per_s = nan;
  try {
    read_run_json(folder / "run.json", data);
  } catch (const std::runtime_error& error) {
    fail(error.what());
  }
  return data;
}

}  // namespace verification

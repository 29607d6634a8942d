#include "verification/runs/foreign/delivered_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "reports/files/atomic_file.hpp"
#include "reports/files/csv.hpp"
#include "reports/files/io_error.hpp"
#include "reports/files/json_text.hpp"
#include "verification/not_a_number.hpp"
#include "verification/runs/foreign/delivery.hpp"
#include "verification/runs/run_simulation.hpp"

namespace verification {
namespace {

namespace fs = std::filesystem;
using Absent = std::vector<std::pair<std::string, std::string>>;  // column, value where it is left out

/// A foreign file without its comments, and with the columns that it may leave out; as a file in `scratch`.
fs::path normalised(const fs::path& file, const fs::path& scratch, const Absent& may_be_absent) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("it left no " + file.filename().string());
  std::string text, line, added;
  bool header = true;
  while (std::getline(in, line)) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    if (header) {
      const std::string columns = "," + line + ",";
      for (const auto& [column, value] : may_be_absent)
        if (columns.find("," + column + ",") == std::string::npos) {
          line += "," + column;
          added += "," + value;
        }
      text += line + "\n";
    } else {
      text += line + added + "\n";
    }
    header = false;
  }
  const fs::path read = scratch / (file.filename().string() + ".read");
  reports::write_file(read, text, reports::Durability::Unsynced);
  return read;
}

std::vector<reports::ProfileRow> read_profile(const fs::path& file, const fs::path& scratch,
                                              bool may_lack_v) {
  using Row = reports::ProfileRow;
  const auto columns =
      std::make_tuple(reports::column("t", &Row::t), reports::column("location", &Row::location),
                      reports::column("x", &Row::x), reports::column("y", &Row::y),
                      reports::column("u", &Row::u), reports::column("v", &Row::v));
  return reports::read_csv(normalised(file, scratch, may_lack_v ? Absent{{"v", "0"}} : Absent{}), columns);
}

void add_profile(const PlannedRun& plan, const fs::path& folder, const fs::path& scratch,
                 const ExactField* exact, RunData& data) {
  const SceneConfig& scene = plan.scene;
  const bool channel_along_x = scene.flow->has_shear_profile() && scene.flow->across() == 1;
  data.profile = read_profile(folder / "profile.csv", scratch, channel_along_x);
  const std::vector<std::string> lacks = shortcomings(data.profile, plan, *plan.solver);
  if (!lacks.empty())
    throw std::runtime_error(fmt::format("its profile.csv is not whole: {}", fmt::join(lacks, "; ")));
  const mpm::VectorField points = scene.flow->tabulated_points();
  const double near = 1e-6 * scene.scene.smallest_cell_size();
  for (reports::ProfileRow& row : data.profile) {
    for (const Vec2& point : points)  // as they were meant: digits of a text may be fewer
      if (std::hypot(row.x - point.x(), row.y - point.y()) <= near) row.x = point.x(), row.y = point.y();
    row.t = output_time(scene, row.t);
    const Location location = row.location == "grid" ? Location::Grid : Location::Particles;
    const Vec2 v = exact ? exact->velocity({row.x, row.y}, row.t, location) : Vec2(nan, nan);
    row.u_exact = v.x();
    row.v_exact = v.y();
  }
}

void add_history(const fs::path& folder, const fs::path& scratch, const SceneConfig& scene,
                 const ExactField* exact, RunData& data) {
  using Row = reports::HistoryRow;
  const auto columns = std::make_tuple(
      reports::column("t", &Row::t), reports::column("probe", &Row::probe),
      reports::column("mass", &Row::mass), reports::column("momentum_x", &Row::momentum_x),
      reports::column("momentum_y", &Row::momentum_y), reports::column("impulse_x", &Row::impulse_x),
      reports::column("impulse_y", &Row::impulse_y), reports::column("kinetic_energy", &Row::kinetic_energy));
  data.history = reports::read_csv(normalised(folder / "history.csv", scratch, {}), columns);
  const Probe probe = scene.flow->probe();
  for (Row& row : data.history) {
    row.probe_exact = exact ? exact->velocity(probe.point, row.t, Location::Grid).dot(probe.direction) : nan;
    row.kinetic_energy_exact = exact ? exact->kinetic_energy(row.t).value_or(nan) : nan;
  }
  constexpr std::size_t fewest = 10;
  if (data.history.size() < fewest)
    throw std::runtime_error(
        fmt::format("history.csv has {} rows; expected at least {}", data.history.size(), fewest));
  if (!(data.history.back().t >= scene.outputs.back() * (1 - 1e-6)))
    throw std::runtime_error(fmt::format("history.csv ends before t = {} s", scene.outputs.back()));
}

/// Sets the times of rows to the outputs that they mean. Each output must have `fewest` rows at least, and no
/// row may be of another time.
template <class Row>
void require_outputs(std::vector<Row>& rows, const SceneConfig& scene, int fewest, const char* file) {
  std::map<double, int> found;
  for (Row& row : rows) {
    const double t = output_time(scene, row.t);
    if (std::isnan(t))
      throw std::runtime_error(
          fmt::format("{} has rows at t = {}; expected {}", file, row.t, fmt::join(scene.outputs, ", ")));
    row.t = t;
    ++found[t];
  }
  for (const double t : scene.outputs)
    if (found[t] < fewest)
      throw std::runtime_error(
          fmt::format("{} has {} rows at t = {}; expected at least {}", file, found[t], t, fewest));
}

void add_shear(const PlannedRun& plan, const fs::path& folder, const fs::path& scratch, int fewest,
               RunData& data) {
  using Row = reports::ShearRow;
  const auto columns =
      std::make_tuple(reports::column("t", &Row::t), reports::column("location", &Row::location),
                      reports::column("place", &Row::place), reports::column("shear_rate", &Row::shear_rate));
  data.shear = reports::read_csv(normalised(folder / "shear.csv", scratch, {{"location", "cells"}}), columns);
  const SceneConfig& scene = plan.scene;
  require_outputs(data.shear, scene, fewest, "shear.csv");
  const double width = scene.scene.size[scene.flow->across()];
  for (Row& row : data.shear) {
    if (row.location != "cells" || !(row.place >= -1e-6 * width && row.place <= width * (1 + 1e-6)) ||
        !(std::isfinite(row.shear_rate) && row.shear_rate >= 0))
      throw std::runtime_error(fmt::format(
          "shear.csv has '{}', place {}, shear rate {}; expected location cells, a place in the channel and "
          "a rate of 0 or more",
          row.location, row.place, row.shear_rate));
    row.viscosity_ratio = scene.fluid.viscosity_ratio(row.shear_rate);
  }
}

void add_state(const PlannedRun& plan, const fs::path& folder, const fs::path& scratch,
               const ExactField* exact, int fewest, RunData& data) {
  using Row = reports::StateRow;
  const auto columns =
      std::make_tuple(reports::column("t", &Row::t), reports::column("location", &Row::location),
                      reports::column("x", &Row::x), reports::column("y", &Row::y),
                      reports::column("density", &Row::density), reports::column("pressure", &Row::pressure));
  data.state =
      reports::read_csv(normalised(folder / "state.csv", scratch,
                                   {{"location", "particles"}, {"density", "nan"}, {"pressure", "nan"}}),
                        columns);
  require_outputs(data.state, plan.scene, fewest, "state.csv");
  for (Row& row : data.state) {
    const auto density = exact ? exact->density({row.x, row.y}, row.t) : std::nullopt;
    const Row known = exact_state_at(plan.scene, row.t, row.location, {row.x, row.y}, density.value_or(nan));
    row.density_exact = known.density_exact;
    row.pressure_exact = known.pressure_exact;
  }
}

}  // namespace

void read_delivery(const Study& study, const PlannedRun& plan, const fs::path& folder,
                   const fs::path& scratch, RunData& data) {
  const SceneConfig& scene = plan.scene;
  const ForeignSolver& solver = *plan.solver;
  const auto exact = compared_with(study, scene);
  const int fewest = solver.points_across > 0 ? solver.points_across : scene.discretisation.cells;
  try {
    add_profile(plan, folder, scratch, exact.get(), data);
    if (solver.delivers_record(Record::History)) add_history(folder, scratch, scene, exact.get(), data);
    if (solver.delivers_record(Record::Shear)) add_shear(plan, folder, scratch, fewest, data);
    if (solver.delivers_record(Record::State)) add_state(plan, folder, scratch, exact.get(), fewest, data);
  } catch (const reports::IoError& error) {
    throw std::runtime_error(error.what());  // the fault of the solver, not of our result directory
  }
  if (!exact || (study.comparison != Comparison::Exact && study.comparison != Comparison::Table)) return;
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(data.profile, exact_lines(scene, *exact));
  if (!data.shear.empty()) append(data.shear, exact_shear(scene, *exact));
  if (!data.state.empty()) append(data.state, exact_state(scene, *exact));
}

void read_run_json(const fs::path& file, const ForeignSolver& solver, RunData& data) {
  if (!std::ifstream(file)) return;
  try {
    const reports::Json json = reports::parse_json(reports::read_file(file));
    const std::string status = json.value("status", "completed"), message = json.value("message", "");
    if (status != "completed")
      throw std::runtime_error("its run.json says '" + status + "'" +
                               (message.empty() ? "" : ": " + message));
    std::string version = json.value("version", "");
    if (!solver.is_named) data.record.method = json.value("name", solver.name);
    if (!version.empty())
      data.record.method = (solver.is_named ? solver.name : data.record.method) + " " + version;
    data.record.steps = json.value("steps", data.record.steps);
    data.record.particles = json.value("particles", data.record.particles);
    data.record.cells = json.value("cells", data.record.cells);
    data.record.dt = json.value("dt", data.record.dt);
    if (json.contains("wall_s")) {
      data.timing.wall_s = json.at("wall_s");
      data.timing.clock = reports::clock_solver;
    }
  } catch (const reports::Json::exception& error) {
    throw std::runtime_error(std::string("its run.json cannot be read: ") + error.what());
  } catch (const reports::IoError& error) {
    throw std::runtime_error(std::string("its run.json cannot be read: ") + error.what());
  }
}

std::vector<Location> locations_in(const fs::path& profile) {
  std::ifstream in(profile);
  std::string line;
  bool grid = false, particles = false;
  while (std::getline(in, line)) {
    grid = grid || line.find(",grid,") != line.npos;
    particles = particles || line.find(",particles,") != line.npos;
  }
  std::vector<Location> found;
  if (grid) found.push_back(Location::Grid);
  if (particles) found.push_back(Location::Particles);
  return found;
}

}  // namespace verification

#include "verification/runs/run_external.hpp"

#include <sys/wait.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "reports/files/csv.hpp"
#include "reports/files/io_error.hpp"
#include "verification/runs/interruption.hpp"
#include "verification/runs/run_simulation.hpp"

namespace verification {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string quoted(const std::filesystem::path& path) {
  std::string text = "'";
  for (const char c : std::filesystem::absolute(path).string())
    text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

std::string replaced(std::string text, const std::string& mark, const std::string& value) {
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size()))
    text.replace(at, mark.size(), value);
  return text;
}

/// The output time that a foreign file means, within rounding of its text; NaN for a time nobody asked for.
double output_time(const SceneConfig& scene, double t) {
  for (const double output : scene.outputs)
    if (std::abs(t - output) <= 1e-9 * output) return output;
  return nan;
}

std::vector<reports::ProfileRow> read_foreign_profile(const std::filesystem::path& file) {
  using Row = reports::ProfileRow;
  const auto columns =
      std::make_tuple(reports::column("t", &Row::t), reports::column("location", &Row::location),
                      reports::column("x", &Row::x), reports::column("y", &Row::y),
                      reports::column("u", &Row::u), reports::column("v", &Row::v));
  try {
    return reports::read_csv(file, columns);
  } catch (const reports::IoError& error) {
    throw std::runtime_error(error.what());  // the fault of the foreign solver, not of our result directory
  }
}

}  // namespace

RunData run_external(const Study& study, const PlannedRun& plan, const std::filesystem::path& out) {
  const SceneConfig& scene = plan.scene;
  const std::filesystem::path folder = out / "external" / plan.run;
  reports::ensure_directory(folder);
  std::string command =
      replaced(study.solver_command, "{scene}", quoted(out / "scenes" / (plan.run + ".toml")));
  command = replaced(command, "{out}", quoted(folder)) + " > " + quoted(folder / "log.txt") + " 2>&1";

  const auto begin = std::chrono::steady_clock::now();
  const int status = std::system(command.c_str());
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (status != -1 && WIFSIGNALED(status) && (WTERMSIG(status) == SIGINT || WTERMSIG(status) == SIGTERM))
    note_interruption(WTERMSIG(status));  // std::system() keeps a SIGINT of the terminal from us
  throw_if_interrupted();
  if (status == -1 || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error("the external solver failed; its output is in " + (folder / "log.txt").string());

  RunData data;
  data.plan = &plan;
  const auto exact = compared_with(study, scene);
  for (reports::ProfileRow& row : read_foreign_profile(folder / "profile.csv")) {
    row.t = output_time(scene, row.t);
    if (std::isnan(row.t) || (row.location != "grid" && row.location != "particles")) continue;
    const Location location = row.location == "grid" ? Location::Grid : Location::Particles;
    const Vec2 v = exact ? exact->velocity({row.x, row.y}, row.t, location) : Vec2(nan, nan);
    row.u_exact = v.x();
    row.v_exact = v.y();
    data.profile.push_back(row);
  }
  if (exact && study.comparison == Comparison::Exact) {
    const auto rows = exact_lines(scene, *exact);
    data.profile.insert(data.profile.end(), rows.begin(), rows.end());
  }
  data.record = describe_run(study, plan, scene.steps(), "completed");
  data.record.basis = data.record.transfer = data.record.stepping = data.record.reset =
      reports::foreign_scheme;
  data.record.method = study.solver_name;
  data.timing.run = plan.run;
  data.timing.wall_s = wall;
  data.timing.particle_steps_per_s = nan;
  return data;
}

}  // namespace verification

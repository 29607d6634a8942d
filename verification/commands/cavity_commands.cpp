#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/files/atomic_file.hpp"
#include "reports/records/directory/result_directory.hpp"
#include "reports/records/directory/result_files.hpp"
#include "verification/benchmarks/cavity_files.hpp"
#include "verification/commands/commands.hpp"
#include "verification/commands/output.hpp"
#include "verification/commands/provenance_of.hpp"
#include "verification/config/config_error.hpp"
#include "verification/scene/scene_config.hpp"

namespace verification {
namespace {

using reference::CavityBenchmarkFluid;

std::vector<CavityBenchmarkFluid> chosen(const std::vector<std::string>& names) {
  const auto& all = reference::cavity_benchmark_fluids();
  if (names.empty()) return all;
  std::vector<CavityBenchmarkFluid> fluids;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(all, name, &CavityBenchmarkFluid::name);
    if (found == all.end()) {
      std::string known;
      for (const CavityBenchmarkFluid& fluid : all) known += (known.empty() ? "" : ", ") + fluid.name;
      throw ConfigError("fluid '" + name + "' is not known; choose some of: " + known);
    }
    fluids.push_back(*found);
  }
  return fluids;
}

/// Velocities of the steady flow on the lattice of the scene's cells and at the points of the tables.
template <class Flow>
std::string profile_of(const Flow& flow, const SceneConfig& scene) {
  const double side = scene.flow->length(), lid = scene.flow->velocity_scale();
  const int cells = scene.discretisation.cells;
  std::vector<std::pair<double, double>> places;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) places.emplace_back(double(i) / cells, double(j) / cells);
  for (const Vec2& point : scene.flow->tabulated_points())
    places.emplace_back(point.x() / side, point.y() / side);
  std::ranges::sort(places);
  const auto same = [](const auto& a, const auto& b) {
    return std::hypot(a.first - b.first, a.second - b.second) < 1e-9;
  };
  places.erase(std::unique(places.begin(), places.end(), same), places.end());
  std::string text = "t,location,x,y,u,v\n";
  for (const double t : scene.outputs)
    for (const auto& [x, y] : places) {
      const auto v = flow.velocity(x, y);
      text += fmt::format("{},grid,{},{},{},{}\n", t, side * x, side * y, lid * v[0], lid * v[1]);
    }
  return text;
}

}  // namespace

int cavity_tables_command(const CavityTablesOptions& options) {
  const std::vector<CavityBenchmarkFluid> fluids = chosen(options.fluids);
  const reports::ResultDirectory ours(options.out, options.force);
  reports::write_provenance(options.out, provenance_of(options.command_line));
  std::string extrema = extrema_csv_header();
  for (const CavityBenchmarkFluid& fluid : fluids) {
    const CavityMeshes meshes = published_meshes(fluid);
    const auto rows = cavity_benchmark(fluid, meshes);
    reports::write_file(options.out / centre_lines_file(fluid), centre_lines_csv(fluid, meshes, rows));
    extrema += extrema_csv(fluid, rows);
    double largest = 0, apart = 0;
    int outside = 0;  // the finest finite volumes, of both uncertainties together
    for (const CavityBenchmarkRow& row : rows) {
      outside += !(std::abs(row.volumes_finest) <= row.volumes_uncertainty + row.uncertainty);
      if (row.feature.quantity != "u" && row.feature.quantity != "v") continue;
      largest = std::max(largest, row.uncertainty);
      apart = std::max(apart, std::abs(row.volumes_difference));
    }
    say("{}: centre lines to {:.1e} of the lid's velocity, finite volumes {:.1e} apart; {} of {} values "
        "outside "
        "of both uncertainties\n",
        fluid.name, largest, apart, outside, rows.size());
    std::fflush(stdout);
  }
  reports::write_file(options.out / extrema_file, extrema);
  return 0;
}

int cavity_profile_command(const CavityProfileOptions& options) {
  const SceneConfig scene = read_scene_config(TomlTable::from_file(options.scene.string()), SceneFor::Theirs);
  const CavityBenchmarkFluid* fluid =
      scene.flow_name == "lid-driven-cavity"
          ? reference::find_cavity_benchmark(scene.fluid.curve, scene.flow->velocity_scale(),
                                             scene.flow->length())
          : nullptr;
  if (!fluid)
    throw ConfigError(
        options.scene.string() +
        ": key 'scene.flow': must be a lid-driven-cavity of one of the tables' fluids at Re = 100");
  const std::vector<int> mesh{scene.discretisation.cells};
  reports::write_file(options.out / "profile.csv", options.volumes
                                                       ? profile_of(by_volumes(*fluid, mesh).back(), scene)
                                                       : profile_of(by_splines(*fluid, mesh).back(), scene));
  return 0;
}

}  // namespace verification

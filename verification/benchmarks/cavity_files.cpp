#include "verification/benchmarks/cavity_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace verification {
namespace {

using reference::CavityBenchmarkFluid;

/// The format of tables wants a time: one late enough for a flow from rest [L/U].
constexpr int steady_by = 60;

bool on_a_line(const CavityBenchmarkRow& row) {
  return row.feature.quantity == "u" || row.feature.quantity == "v";
}

}  // namespace

std::string centre_lines_file(const CavityBenchmarkFluid& fluid) {
  return fmt::format("cavity-re100-{}.csv", fluid.name);
}

std::string centre_lines_csv(const CavityBenchmarkFluid& fluid, const CavityMeshes& meshes,
                             const std::vector<CavityBenchmarkRow>& rows) {
  const auto mesh = spline_mesh(fluid, meshes.spans.back());
  std::string text = fmt::format(
      "# source: this project, mpm-verify cavity-tables; steady lid-driven square cavity, {}; u(1/2, y) and "
      "v(x, 1/2)\n"
      "# obtained: numerical benchmark: stream function by Galerkin's method with splines of degree {} on {} "
      "spans a side; U95, twice the uncertainty here: that of Eca & Hoekstra 2014 from {} spans, plus the "
      "distance to finite volumes on {} cells extrapolated to h = 0, at least the median along the lines\n"
      "# licence: numbers are facts and belong to nobody\n"
      "# scales: velocity length\n"
      "quantity,t,x,y,value,uncertainty,unit,note\n",
      fluid.title, mesh.degree, mesh.spans, fmt::join(meshes.spans, "; "), fmt::join(meshes.cells, "; "));
  for (const CavityBenchmarkRow& row : rows)
    if (on_a_line(row))
      text += fmt::format("{},{},{},{},{:.7f},{:.3g},1,meshes {:.1e}; finite volumes {:+.1e}\n",
                          row.feature.quantity, steady_by, row.feature.x, row.feature.y, row.feature.value,
                          row.uncertainty / 2, row.mesh_uncertainty, row.volumes_difference);
  return text;
}

std::string extrema_csv_header() {
  return "# source: this project, mpm-verify cavity-tables; steady lid-driven square cavities, Re = 100: "
         "least u "
         "on x = 1/2, greatest and least v on y = 1/2, least stream function, and where they are\n"
         "# obtained: as the centre lines beside this file; uncertainty_95 is U95 itself\n"
         "# licence: numbers are facts and belong to nobody\n"
         "# scales: values over U, U L, L\n"
         "fluid,quantity,value,uncertainty_95,mesh_uncertainty,finite_volumes_minus_value\n";
}

std::string extrema_csv(const CavityBenchmarkFluid& fluid, const std::vector<CavityBenchmarkRow>& rows) {
  std::string text;
  for (const CavityBenchmarkRow& row : rows)
    if (!on_a_line(row))
      text += fmt::format("{},{},{:.7f},{:.2g},{:.1e},{:+.1e}\n", fluid.name, row.feature.quantity,
                          row.feature.value, row.uncertainty, row.mesh_uncertainty, row.volumes_difference);
  return text;
}

}  // namespace verification

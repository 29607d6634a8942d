#include "verification/benchmarks/cavity_benchmark.hpp"

#include <algorithm>
#include <cmath>

#include "verification/convergence/eca_hoekstra.hpp"
#include "verification/convergence/least_squares.hpp"

namespace verification {
namespace {

using reference::CavityBenchmarkFluid;
using reference::CavityFeature;
using reference::CavityGradedVolumes;
using reference::CavityStreamFunction;
using reference::CavityViscosity;

/// Meshes on which a fluid's path is walked: only the way to the next solution.
constexpr int path_spans = 24, path_cells = 32;

template <class Flow>
std::vector<CavityFeature> features_of(const Flow& flow) {
  return reference::cavity_features({[&](double x, double y) { return flow.velocity(x, y); },
                                     [&](double x, double y) { return flow.stream(x, y); }});
}

/// One value on every mesh, coarse to fine.
std::vector<double> along(const std::vector<std::vector<CavityFeature>>& meshes, std::size_t i) {
  std::vector<double> values;
  for (const auto& features : meshes) values.push_back(features[i].value);
  return values;
}

double uncertainty_of(const std::vector<int>& counts, const std::vector<double>& values, double order) {
  std::vector<double> steps;
  for (const int count : counts) steps.push_back(1.0 / count);
  return eca_hoekstra(steps, values, order).uncertainty;
}

/// What no value of the tables is said to be better than, whatever its meshes say.
constexpr double least_uncertainty = 5e-7;

/// Up to two digits.
double rounded_up(double uncertainty) {
  const double unit = std::pow(10.0, std::floor(std::log10(uncertainty)) - 1);
  return std::ceil(uncertainty / unit - 1e-9) * unit;
}

/// Errors change their sign along a line, and next to it neither meshes nor methods seem to differ:
/// velocities are said to be no better than half of those on their lines.
double median_of_velocities(const std::vector<CavityBenchmarkRow>& rows) {
  std::vector<double> all;
  for (const CavityBenchmarkRow& row : rows)
    if (row.feature.quantity == "u" || row.feature.quantity == "v") all.push_back(row.uncertainty);
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

}  // namespace

CavityMeshes published_meshes(const CavityBenchmarkFluid& fluid) {
  if (fluid.thickens) return {{64, 96, 128, 192}, {96, 128, 192, 256}};
  return {{48, 64, 96, 128}, {96, 128, 192, 256}};
}

CavityStreamFunction::Mesh spline_mesh(const CavityBenchmarkFluid& fluid, int spans) {
  if (fluid.thickens) return {spans, 3, 1.5};
  return {spans, 4, 2.0};
}

std::vector<CavityStreamFunction> by_splines(const CavityBenchmarkFluid& fluid,
                                             const std::vector<int>& spans) {
  std::vector<CavityStreamFunction> flows;
  for (const reference::FlowCurve& curve : fluid.path) {
    CavityStreamFunction next(CavityViscosity(curve), spline_mesh(fluid, path_spans),
                              flows.empty() ? nullptr : &flows.back());
    flows.assign(1, std::move(next));
  }
  for (const int count : spans)
    flows.emplace_back(CavityViscosity(fluid.curve), spline_mesh(fluid, count), &flows.back());
  flows.erase(flows.begin());
  return flows;
}

std::vector<CavityGradedVolumes> by_volumes(const CavityBenchmarkFluid& fluid,
                                            const std::vector<int>& cells) {
  std::vector<CavityGradedVolumes> flows;
  for (const reference::FlowCurve& curve : fluid.path) {
    CavityGradedVolumes next(CavityViscosity(curve), path_cells, flows.empty() ? nullptr : &flows.back());
    flows.assign(1, std::move(next));
  }
  for (const int count : cells) flows.emplace_back(CavityViscosity(fluid.curve), count, &flows.back());
  flows.erase(flows.begin());
  return flows;
}

double extrapolated(const std::vector<int>& cells, const std::vector<double>& values) {
  Eigen::MatrixXd powers(3, 3);
  Eigen::VectorXd right(3);
  for (int k = 0; k < 3; ++k) {
    const std::size_t i = values.size() - 3 + static_cast<std::size_t>(k);
    const double h = double(cells.back()) / cells[i];
    powers.row(k) << 1, h * h, h * h * h;
    right[k] = values[i];
  }
  return least_squares(powers, right)[0];
}

std::vector<CavityBenchmarkRow> cavity_benchmark(const CavityBenchmarkFluid& fluid,
                                                 const CavityMeshes& meshes) {
  std::vector<std::vector<CavityFeature>> splines, volumes;
  for (const CavityStreamFunction& flow : by_splines(fluid, meshes.spans))
    splines.push_back(features_of(flow));
  for (const CavityGradedVolumes& flow : by_volumes(fluid, meshes.cells))
    volumes.push_back(features_of(flow));
  // Velocities are slopes of the stream function, one order below its degree + 1.
  const double order = spline_mesh(fluid, meshes.spans.back()).degree;
  std::vector<CavityBenchmarkRow> rows;
  for (std::size_t i = 0; i < splines.back().size(); ++i) {
    CavityBenchmarkRow row{splines.back()[i], 0, 0, 0, 0, 0};
    const std::vector<double> ours = along(splines, i), theirs = along(volumes, i);
    row.mesh_uncertainty = uncertainty_of(meshes.spans, ours, order);
    row.volumes_difference = extrapolated(meshes.cells, theirs) - ours.back();
    row.volumes_uncertainty = uncertainty_of(meshes.cells, theirs, 2);
    row.volumes_finest = theirs.back() - ours.back();
    row.uncertainty = row.mesh_uncertainty + std::abs(row.volumes_difference);
    rows.push_back(row);
  }
  const double median = median_of_velocities(rows);
  for (CavityBenchmarkRow& row : rows) {
    const bool place = row.feature.quantity.ends_with("_x") || row.feature.quantity.ends_with("_y");
    row.uncertainty = rounded_up(std::max({row.uncertainty, least_uncertainty, place ? 0.0 : median}));
  }
  return rows;
}

}  // namespace verification

#pragma once

#include <string>
#include <vector>

#include "reference/cavity/benchmark_fluids.hpp"
#include "reference/cavity/cavity_features.hpp"
#include "reference/cavity/graded_volumes.hpp"
#include "reference/cavity/stream_function.hpp"

namespace verification {

/// Meshes of the two discretisations, coarse to fine.
struct CavityMeshes {
  std::vector<int> spans;  ///< of splines; the degree and the clustering are the fluid's
  std::vector<int> cells;  ///< of finite volumes, at least three
};

/// Those of the published tables: four each.
CavityMeshes published_meshes(const reference::CavityBenchmarkFluid& fluid);

/// A number of the table with what is known of its error, in its own unit.
struct CavityBenchmarkRow {
  reference::CavityFeature feature;  ///< by splines, finest mesh
  double mesh_uncertainty;           ///< of that by Eca & Hoekstra 2014 from all meshes of splines, 95 %
  double volumes_difference;         ///< finite volumes extrapolated to h = 0, less splines
  double
      volumes_uncertainty;  ///< of the finest mesh of finite volumes, Eca & Hoekstra; it covers both (95 %)
  double volumes_finest;    ///< finest mesh of finite volumes, less splines
  double uncertainty;  ///< U95: mesh_uncertainty + |volumes_difference|, for velocities and psi at least the
                       ///< median of those on the lines, for all at least 5e-7; up to two digits
};

/// Splines of a fluid's cavity: degree 4 and spans that cluster strongly, for the corners' sake, in a fluid
/// that thins; degree 3 and more even spans in one that thickens, where shear rates vanish along lines across
/// which they change fast.
reference::CavityStreamFunction::Mesh spline_mesh(const reference::CavityBenchmarkFluid& fluid, int spans);

/// The flow by either discretisation on ascending meshes, each started from the one before, the first from
/// the fluid's path. Throws std::runtime_error where Newton's method does not converge.
std::vector<reference::CavityStreamFunction> by_splines(const reference::CavityBenchmarkFluid& fluid,
                                                        const std::vector<int>& spans);
std::vector<reference::CavityGradedVolumes> by_volumes(const reference::CavityBenchmarkFluid& fluid,
                                                       const std::vector<int>& cells);

/// Limit of phi + a h^2 + b h^3 through three meshes of finite volumes, coarse to fine: second order, and the
/// corners' and walls' next term.
double extrapolated(const std::vector<int>& cells, const std::vector<double>& values);

/// Every number of the table of one fluid.
std::vector<CavityBenchmarkRow> cavity_benchmark(const reference::CavityBenchmarkFluid& fluid,
                                                 const CavityMeshes& meshes);

}  // namespace verification

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verification/benchmarks/cavity_benchmark.hpp"

namespace verification {

/// The centre lines of a fluid as a table of measurements (verification/validation/measurements.hpp): scaled,
/// standard uncertainties U95/2, at the time by which a flow from rest has become steady.
std::string centre_lines_csv(const reference::CavityBenchmarkFluid& fluid, const CavityMeshes& meshes,
                             const std::vector<CavityBenchmarkRow>& rows);

/// Extrema and vortex of a fluid, lines of fluid, quantity, value, U95 and its parts; the header for the
/// first.
std::string extrema_csv_header();
std::string extrema_csv(const reference::CavityBenchmarkFluid& fluid,
                        const std::vector<CavityBenchmarkRow>& rows);

/// Names of the files: of a fluid's lines, and of all extrema.
std::string centre_lines_file(const reference::CavityBenchmarkFluid& fluid);
inline constexpr const char* extrema_file = "cavity-re100-extrema.csv";

}  // namespace verification

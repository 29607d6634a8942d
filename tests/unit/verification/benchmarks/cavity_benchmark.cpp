#include "verification/benchmarks/cavity_benchmark.hpp"

#include <algorithm>
#include <cmath>

#include "tests/catch.hpp"
#include "verification/benchmarks/cavity_files.hpp"
#include "verification/flows/vortices/cavity_tables.hpp"

using namespace verification;

TEST_CASE("three meshes of a quadratic and a cubic error are extrapolated to their limit", "[cavity]") {
  const auto value = [](double h) { return 3 + 2 * h * h - 5 * h * h * h; };
  CHECK(extrapolated({7, 10, 20, 25}, {99, value(0.1), value(0.05), value(0.04)}) == Approx(3));
}

TEST_CASE("few spans and cells give the published table within what they say themselves", "[cavity]") {
  for (const std::string name : {"power-law-0.75", "power-law-1.25"}) {
    const auto& fluids = reference::cavity_benchmark_fluids();
    const auto& fluid = *std::ranges::find(fluids, name, &reference::CavityBenchmarkFluid::name);
    const auto rows = cavity_benchmark(fluid, {{12, 16, 20, 24}, {16, 20, 24, 32}});
    const CavityTable* table = cavity_table(name);
    REQUIRE(table);
    REQUIRE(table->points.size() == 56);
    CHECK(table->largest_uncertainty < 2e-5);
    std::size_t outside = 0;
    for (std::size_t i = 0; i < table->points.size(); ++i) {
      const auto& point = table->points[i];
      CHECK(rows[i].feature.x == point.x);
      CHECK(rows[i].feature.y == point.y);
      outside += std::abs(rows[i].feature.value - point.value) > rows[i].uncertainty;
      // The finest finite volumes, by their own uncertainty.
      CHECK(std::abs(rows[i].volumes_finest + rows[i].feature.value - point.value) <
            1.5 * rows[i].volumes_uncertainty + rows[i].uncertainty);
    }
    CHECK(outside <= 2);  // of 56 at 95 %
  }
}

TEST_CASE("a table of a cavity says its fluid, meshes and uncertainties", "[cavity]") {
  const auto& fluid = reference::cavity_benchmark_fluids()[1];
  const std::vector<CavityBenchmarkRow> rows{{{"u", 0.5, 0.25, -0.1}, 1e-6, -2e-7, 3e-6, 0, 1.2e-6},
                                             {{"u_min", 0.5, 0.3, -0.2}, 1e-6, 2e-7, 3e-6, 0, 1.2e-6}};
  const std::string lines = centre_lines_csv(fluid, {{10, 20}, {8, 16, 32}}, rows);
  CHECK(lines.find("n = 0.5") != std::string::npos);
  CHECK(lines.find("u,60,0.5,0.25,-0.1000000,6e-07,1,") != std::string::npos);
  CHECK(lines.find("u_min") == std::string::npos);
  CHECK(extrema_csv(fluid, rows) == "power-law-0.5,u_min,-0.2000000,1.2e-06,1.0e-06,+2.0e-07\n");
  CHECK(centre_lines_file(fluid) == "cavity-re100-power-law-0.5.csv");
}

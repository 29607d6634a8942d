#include "reference/cavity/benchmark_fluids.hpp"

#include <fmt/format.h>

#include <cmath>

namespace reference {
namespace {

constexpr double reynolds = 100;

CavityBenchmarkFluid power_law(double n) {
  CavityBenchmarkFluid fluid{
      fmt::format("power-law-{}", n),
      fmt::format("power law, n = {}, tau = K gdot^n, Re = rho U^(2-n) L^n/K = {}", n, reynolds),
      PowerLawCurve{1 / reynolds, n},
      n > 1,
      {}};
  const int steps = static_cast<int>(std::lround(std::abs(n - 1) / 0.125));
  fluid.path.emplace_back(NewtonianCurve{1 / reynolds});
  for (int k = 1; k <= steps; ++k)
    fluid.path.emplace_back(PowerLawCurve{1 / reynolds, 1 + (n - 1) * k / steps});
  return fluid;
}

CavityBenchmarkFluid cross(double a) {
  CavityBenchmarkFluid fluid{
      fmt::format("cross-{}", a),
      fmt::format("Cross, nu = nu_0 [a + (1 - a)/(1 + K gdot)], a = {}, K U/L = 1, Re = U L/nu_0 = {}", a,
                  reynolds),
      CrossCurve{1 / reynolds, a / reynolds, 1, 1},
      a > 1,
      {}};
  constexpr int steps = 4;
  fluid.path.emplace_back(NewtonianCurve{1 / reynolds});
  for (int k = 1; k <= steps; ++k)
    fluid.path.emplace_back(CrossCurve{1 / reynolds, std::pow(a, double(k) / steps) / reynolds, 1, 1});
  return fluid;
}

}  // namespace

const std::vector<CavityBenchmarkFluid>& cavity_benchmark_fluids() {
  static const std::vector<CavityBenchmarkFluid> fluids{{"newtonian",
                                                         fmt::format("Newtonian, Re = U L/nu = {}", reynolds),
                                                         NewtonianCurve{1 / reynolds},
                                                         false,
                                                         {NewtonianCurve{1 / reynolds}}},
                                                        power_law(0.5),
                                                        power_law(0.75),
                                                        power_law(1.25),
                                                        power_law(1.5),
                                                        cross(0.1),
                                                        cross(10)};
  return fluids;
}

const CavityBenchmarkFluid* find_cavity_benchmark(const FlowCurve& curve, double lid_velocity, double side) {
  const double rate = lid_velocity / side, diffusivity = lid_velocity * side;
  for (const CavityBenchmarkFluid& fluid : cavity_benchmark_fluids()) {
    bool same = true;
    for (const double w : {0.1, 0.5, 1.0, 3.0, 30.0}) {
      const double nu = fluid.curve.viscosity(w);
      same = same && std::abs(curve.viscosity(w * rate) / diffusivity - nu) <= 1e-9 * nu;
    }
    if (same) return &fluid;
  }
  return nullptr;
}

}  // namespace reference

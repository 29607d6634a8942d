#pragma once

#include <string>
#include <vector>

#include "reference/fluids/flow_curve.hpp"

namespace reference {

/// A fluid of the published cavities, in units of the lid's velocity U and the side L.
struct CavityBenchmarkFluid {
  std::string name;   ///< as files call it
  std::string title;  ///< what it is, with the definition of its Reynolds number
  FlowCurve curve;    ///< viscosity in U L against the shear rate in U/L
  bool thickens;      ///< viscosity grows with the shear rate
  /// Fluids that lead to it from a Newtonian one, in steps small enough for Newton's method; itself last.
  std::vector<FlowCurve> path;
};

/// Reynolds number 100 all: Newtonian (the control: tables of others exist), power law n = 0.5,
/// 0.75, 1.25, 1.5 with Re = rho U^(2-n) L^n/K, Cross a = nu_inf/nu_0 = 0.1, 10 with K U/L = 1, M = 1 and Re
/// = U L/nu_0, nu_0 the viscosity at rest.
const std::vector<CavityBenchmarkFluid>& cavity_benchmark_fluids();

/// A flow curve [m2/s against 1/s] in units of U [m/s] and L [m]: the benchmark fluid that it is, to 1e-9;
/// null if it is none.
const CavityBenchmarkFluid* find_cavity_benchmark(const FlowCurve& curve, double lid_velocity, double side);

}  // namespace reference

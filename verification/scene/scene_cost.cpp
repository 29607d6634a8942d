#include "verification/scene/scene_cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/step/stable_step.hpp"
#include "verification/config/machine.hpp"

namespace verification {
namespace {

// Bytes, rounded up from sizeof the records: a particle with its copies in kernel and stencil table, a node
// with its fields, a row of a profile as record and as text.
constexpr double bytes_a_particle = 400, bytes_a_stencil_entry = 28, bytes_a_node = 200, bytes_a_row = 300,
                 bytes_a_matrix_entry = 16;
// A particle-step of the incompressible method, with its fit and its solve, over one of the vector kernels.
constexpr double a_fit_over_a_step = 9;
constexpr double a_year = 3.2e7;  // [s]
// Backward Euler errs by about dt/(2 t) of a change that takes the time t: a quarter of a per cent.
constexpr double implicit_steps_to_first_output = 200;
// A strip in which particles keep their rows bears up to 2.4 times the step that is stable for every wave and
// every place of the particles (r = 3/2 against 0.6366 for linear FLIP and USF).
constexpr double margin_of_a_strip = 2.4;

bool is_implicit(const mpm::Scheme& scheme) {
  return scheme.stepping == mpm::Scheme::Stepping::ImplicitEuler ||
         scheme.stepping == mpm::Scheme::Stepping::ImplicitSdirk2;
}

bool is_strip(const SceneConfig& scene) {
  return (scene.scene.cells[0] == 1 && scene.scene.periodic(0)) ||
         (scene.scene.cells[1] == 1 && scene.scene.periodic(1));
}

/// Kinematic viscosity at the shear rate that the flow has on the whole [m2/s]: what the floor of a power law
/// gives says nothing of its stability.
double typical_viscosity(const SceneConfig& scene) {
  const double rate = scene.flow->velocity_scale() / scene.flow->length();
  return scene.fluid.kinematic_viscosity * scene.fluid.viscosity_ratio(rate);
}

}  // namespace

SceneCost cost_of(const SceneConfig& scene) {
  SceneCost cost;
  const mpm::Scene& s = scene.scene;
  const double degree = 1 + static_cast<double>(scene.scheme.basis);
  const double cells = static_cast<double>(s.cells[0]) * s.cells[1];
  cost.particles = cells * s.particles_per_cell[0] * s.particles_per_cell[1];
  cost.nodes = (s.cells[0] + degree) * (s.cells[1] + degree);
  for (const mpm::Segment& segment : scene.segments) cost.steps += static_cast<double>(segment.steps);
  cost.seconds = cost.particles * cost.steps / particle_steps_per_second;
  if (scene.incompressible) {
    const double k = scene.incompressible->degree;
    cost.seconds *= a_fit_over_a_step;
    // The diagonals of two mass matrices, and factors of the solenoidal part with their fill.
    cost.bytes +=
        cost.nodes * (2 * (2 * k + 1) * (2 * k - 1) + 8 * (2 * k + 1) * (2 * k + 1)) * bytes_a_matrix_entry;
  }
  cost.bytes = cost.particles * bytes_a_particle + cost.nodes * bytes_a_node;
  const double pairs = (2 * degree + 1) * (2 * degree + 1), stencil = (degree + 1) * (degree + 1);
  const bool implicit = is_implicit(scene.scheme);
  if (implicit || scene.scheme.transfer == mpm::Scheme::Transfer::FullMass)
    cost.bytes +=
        cost.particles * stencil * bytes_a_stencil_entry + cost.nodes * pairs * bytes_a_matrix_entry;
  if (implicit)
    cost.bytes +=
        3 * 4 * cost.nodes * pairs * bytes_a_matrix_entry;  // two components, factors with their fill
  const double rows = cost.particles * (s.fluid.pressure ? 2 : 1) + cost.nodes;
  cost.bytes += (static_cast<double>(scene.outputs.size()) * rows + scene.history_samples) * bytes_a_row;
  return cost;
}

std::string described_cost(const SceneConfig& scene) {
  const SceneCost cost = cost_of(scene);
  double longest = 0;
  for (const mpm::Segment& segment : scene.segments) longest = std::max(longest, segment.dt);
  return fmt::format("{:.0f} particles, {:.0f} steps of at most {:.4g} s, about {:.2g} s on one core",
                     cost.particles, cost.steps, longest, cost.seconds);
}

void require_memory(const TomlTable& root, const SceneConfig& scene) {
  const SceneCost cost = cost_of(scene);
  const double there = available_memory(), gibibyte = 1024.0 * 1024 * 1024;
  if (cost.bytes <= there && cost.particles < 2e9 && cost.nodes < 2e9) return;
  root.fail("discretisation.cells", fmt::format("{:.3g} particles on {:.3g} nodes and {} outputs would need "
                                                "about {:.3g} GiB of memory, and there are "
                                                "{:.3g}: take fewer cells, particles or outputs",
                                                cost.particles, cost.nodes, scene.outputs.size(),
                                                cost.bytes / gibibyte, there / gibibyte));
}

void require_steps(const TomlTable& root, const SceneConfig& scene) {
  const SceneCost cost = cost_of(scene);
  if (cost.seconds <= a_year) return;
  root.fail("time",
            fmt::format("{:.3g} particles times {:.3g} steps would take about {:.3g} years at {:.0f} million "
                        "particle-steps/s: "
                        "give a longer dt, an earlier end or fewer cells",
                        cost.particles, cost.steps, cost.seconds / a_year, particle_steps_per_second / 1e6));
}

std::string step_warning(const SceneConfig& scene) {
  if (scene.incompressible) return "";  // implicit, and without sound
  double dt = 0;
  for (const mpm::Segment& segment : scene.segments) dt = std::max(dt, segment.dt);
  const double h = scene.scene.smallest_cell_size(), margin = is_strip(scene) ? margin_of_a_strip : 1;
  const mpm::StableStep limit = mpm::stable_step(scene.scheme, mpm::fewest_particles_per_cell(scene.scene));
  const double r = typical_viscosity(scene) * dt / (h * h), cfl = scene.scene.fluid.sound_speed() * dt / h;
  if (r > margin * limit.viscous)
    return fmt::format(
        "dt = {:.4g} s is nu dt/h^2 = {:.3g}, and the scheme is known to be stable up to {:.3g}", dt, r,
        margin * limit.viscous);
  if (cfl > margin * limit.acoustic)
    return fmt::format("dt = {:.4g} s is c dt/h = {:.3g}, and the scheme is known to be stable up to {:.3g}",
                       dt, cfl, margin * limit.acoustic);
  return "";
}

double accurate_implicit_step(const SceneConfig& scene) {
  return (scene.outputs.front() - scene.start) / implicit_steps_to_first_output;
}

}  // namespace verification

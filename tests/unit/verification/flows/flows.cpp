#include <cmath>
#include <string>

#include "tests/catch.hpp"
#include "verification/checks/quantities/quantities.hpp"
#include "verification/config/config_error.hpp"
#include "verification/runs/run_simulation.hpp"
#include "verification/scene/scene_config.hpp"

using namespace verification;

namespace {

std::string scene(const std::string& flow, const std::string& fluid, const std::string& rest) {
  return "[scene]\n" + flow + "\n[fluid]\nkinematic_viscosity = 1e-6\n" + fluid + "\n[discretisation]\n" +
         rest;
}

SceneConfig read(const std::string& text) {
  return read_scene_config(TomlTable::from_text(text, "test"));
}

PlannedRun planned(const std::string& text) {
  PlannedRun plan;
  plan.run = "run";
  plan.scene = read(text);
  return plan;
}

RunData run(const PlannedRun& plan) {
  Study study;
  study.name = "study";
  return run_simulation(study, plan);
}

const std::string pressure = "bulk_modulus = 143.0", none = "pressure = false";
const std::string translation = scene("flow = \"translation\"\nlength = 1e-3\nvelocity = [30e-3, 20e-3]",
                                      pressure, "cells = 4\ncells_along = 4\n[time]\ndt = 5e-5\nend = 10e-3");

}  // namespace

TEST_CASE("wrong keys of the flows are refused by name") {
  const std::string grid = "cells = 4\n[time]\ndt = 1e-5\nend = 1e-2";
  const auto refuses = [&](const std::string& flow, const std::string& fluid, const std::string& part) {
    CAPTURE(flow);
    CHECK_THROWS_WITH(read(scene(flow, fluid, grid)), contains(part));
  };
  refuses("flow = \"translation\"\nlength = 1e-3\nvelocity = [0, 0]", pressure, "must not be zero");
  refuses("flow = \"translation\"\nlength = 1e-3\nvelocity = [1, 0]\ndensity_ratio = -1", pressure,
          "density_ratio");
  refuses("flow = \"tait-column\"\nheight = 1e-3\ndensity_contrast = 0", pressure, "density_contrast");
  refuses("flow = \"tait-column\"\nheight = 1e-3\ndensity_contrast = 0.1", none, "pressure = true");
  refuses("flow = \"uniform-dilatation\"\nlength = 1e-3\nrate = 10", pressure, "must be negative");
  refuses("flow = \"uniform-dilatation\"\nlength = 1e-3\nrate = -101", pressure, "time.end");
  refuses("flow = \"oblique-shear-wave\"\nlength = 1e-3\namplitude = 1e-3\nwaves = [0, 0]", pressure,
          "waves");
  refuses("flow = \"oblique-shear-wave\"\nlength = 1e-3\namplitude = 1e-3\nwaves = [1]", pressure, "waves");
  refuses("flow = \"womersley\"\nheight = 1e-3\nbody_acceleration = 1\nfrequency = 0", none, "frequency");
  refuses("flow = \"womersley\"\nheight = 1e-3\nplate_velocity = 1\nfrequency = 1", none,
          "body_acceleration");
  refuses("flow = \"oscillating-plate\"\nheight = 1e-3\nplate_velocity = 0\nfrequency = 1", none,
          "must not be zero");
  CHECK_THROWS_WITH(
      read(scene("flow = \"oblique-shear-wave\"\nlength = 1e-3\namplitude = 1e-3\nwaves = [1, 1]", pressure,
                 "cells = 4\ncells_along = 4\n[time]\ndt = 1e-5\nend = 1e-2")),
      contains("square"));
}

TEST_CASE("keys of cavities and vortices are refused by name") {
  const std::string grid = "cells = 4\n[time]\ndt = 1e-3\nend = 1e-2",
                    still = "pressure = \"incompressible\"";
  const std::string cavity = "flow = \"lid-driven-cavity\"\nside = 1e-3\nlid_velocity = 1e-3\n";
  CHECK_THROWS_WITH(read(scene(cavity + "lid = \"smooth\"", still, grid)), contains("regularised"));
  CHECK_THROWS_WITH(read(scene(cavity + "lid = \"regularised\"", pressure, grid)),
                    contains("incompressible"));
  CHECK(read(scene(cavity + "lid = \"regularised\"", still, grid)).flow->has_exact());
  const std::string vortex = "flow = \"walled-vortex\"\nside = 1e-3\namplitude = 1e-3\n";
  CHECK_THROWS_WITH(read(scene(vortex, none, grid)), contains("balances its advection"));
  CHECK_THROWS_WITH(read(scene(vortex + "decay_rate = -1", still, grid)), contains("decay_rate"));
  CHECK_FALSE(read(scene("flow = \"double-shear-layer\"\nperiod = 1e-3\namplitude = 1e-3\nthickness = 1e-4",
                         still, grid))
                  .flow->has_exact());
}

TEST_CASE("cells of an incompressible run say how many particles they hold, and the pressure") {
  const PlannedRun plan =
      planned(scene("flow = \"taylor-green\"\nperiod = 1e-3\namplitude = 1e-1",
                    "pressure = \"incompressible\"", "cells = 8\n[time]\ndt = 2e-4\nend = 2e-3"));
  const RunData done = run(plan);
  REQUIRE(done.state.size() == 64);
  double mass = 0;
  for (const reports::StateRow& row : done.state) {
    CHECK(row.location == "cells");
    mass += row.density * 1e-6 / 64;
  }
  CHECK(mass == Approx(1e-6 * 1000));
  CHECK(evaluate({"pressure-error", 2e-3}, done) < 0.05);  // of rho U^2/2, on 8 cells
}

TEST_CASE("the path error is the distance to the exact place, around the periodic box") {
  const PlannedRun plan = planned(translation);
  const RunData data = run(plan);
  CHECK(evaluate({"path-error", 10e-3}, data) < 1e-12);     // 200 roundings of a place of 4 cells
  CHECK(evaluate({"density-error", 10e-3}, data) < 1e-15);  // kept as a volume: two roundings
  CHECK(std::isnan(evaluate({"period-error"}, data)));
  CHECK(std::isnan(evaluate({"phase-error"}, data)));

  // Against another translation the error is what the two differ by: 1 mm/s for 10 ms are 0.04 cells.
  std::string other = translation;
  other.replace(other.find("20e-3"), 5, "21e-3");
  const PlannedRun wrong = planned(other);
  RunData judged = data;
  judged.plan = &wrong;
  CHECK(evaluate({"path-error", 10e-3}, judged) == Approx(0.04).epsilon(1e-9));
}

TEST_CASE("pressure, noise and its growth are measured on a column that is pushed") {
  const std::string text = scene("flow = \"tait-column\"\nheight = 1e-3\ndensity_contrast = 0.08", pressure,
                                 "cells = 10\nparticles_along = 1\n[time]\ndt = 2e-5\nend = 4e-3");
  const PlannedRun plan = planned(text);
  const RunData still = run(plan);
  CHECK(evaluate({"pressure-error", 4e-3}, still) < 1e-5);
  CHECK(evaluate({"largest-speed"}, still) < 1e-6);
  CHECK(evaluate({"speed-growth"}, still) < 1.1);

  RunData pushed = still;  // pressure off by a hundredth of that at the bottom, twice the speed at the end
  for (reports::StateRow& row : pushed.state) row.pressure += 0.01 * plan.scene.flow->pressure_scale();
  CHECK(evaluate({"pressure-error", 4e-3}, pushed) == Approx(0.01).epsilon(1e-3));
  for (reports::HistoryRow& row : pushed.history)
    row.kinetic_energy = 0.5 * row.mass * (row.t > 2.5e-3 ? 4e-6 : 1e-6);
  CHECK(evaluate({"speed-growth"}, pushed) == Approx(2));
  CHECK(evaluate({"largest-speed"}, pushed) == Approx(2e-3 / plan.scene.fluid.solver.sound_speed()));
}

TEST_CASE("phase and amplitude errors are those of the probe against the exact history") {
  const PlannedRun plan =
      planned(scene("flow = \"womersley\"\nheight = 1e-3\nbody_acceleration = 8e-3\nfrequency = 16", none,
                    "cells = 8\nparticles_along = 1\n[time]\ndt = 2.5e-4\nend = 0.125"));
  RunData data = run(plan);
  const double omega = 2 * 3.14159265358979323846 * 16;
  for (reports::HistoryRow& row : data.history) {
    row.probe_exact = std::cos(omega * row.t);
    row.probe = 1.1 * std::cos(omega * row.t - 0.2);
  }
  CHECK(evaluate({"amplitude-error"}, data) == Approx(0.1).epsilon(1e-9));
  CHECK(evaluate({"phase-error"}, data) == Approx(-0.2).epsilon(1e-9));  // late
  CHECK(std::isnan(evaluate({"period-error"}, data)));                   // driven, not free
}

#include "verification/runs/run_data.hpp"

#include <fmt/format.h>

namespace verification {

reports::RunRecord describe_run(const Study& study, const PlannedRun& plan, long steps,
                                const std::string& status) {
  const SceneConfig& scene = plan.scene;
  const bool is_cell = scene.scheme.dilatation == mpm::Scheme::Dilatation::Cell;
  reports::RunRecord record = {plan.run,
                               study.name,
                               scene.flow_name,
                               scene.fluid.label,
                               mpm::name(scene.scheme.basis),
                               mpm::name(scene.scheme.transfer) + (is_cell ? ", cell dilatation" : ""),
                               mpm::name(scene.scheme.stepping),
                               scene.discretisation.cells,
                               scene.particles(),
                               scene.segments.front().dt,
                               steps,
                               status,
                               mpm::reset_name(scene.scheme)};
  if (scene.sph) {
    const mpm::SphScheme& sph = *scene.sph;
    record.method = "SPH";
    record.basis = mpm::name(sph.kernel);
    record.transfer = mpm::name(sph.wall) + "-" + mpm::name(sph.density);
    record.stepping = "verlet";
  }
  if (scene.incompressible) {
    const mpm::IncompressibleScheme& scheme = *scene.incompressible;
    record.method = "incompressible MPM";
    record.basis = fmt::format("divergence-conforming k={}", scheme.degree);
    record.transfer = "consistent fit";
    record.stepping = mpm::name(scheme.stepping);
    record.reset = scheme.remap_every > 0 ? fmt::format("every {} steps", scheme.remap_every) : "never";
  }
  return record;
}

RunData failed_run(const Study& study, const PlannedRun& plan, const std::string& why) {
  RunData data;
  data.plan = &plan;
  data.record = describe_run(study, plan, 0, "failed: " + why);
  data.timing.run = plan.run;
  return data;
}

}  // namespace verification

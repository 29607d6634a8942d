#include "verification/suite/schedule.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <variant>

#include "reports/threads/for_each_index.hpp"
#include "verification/runs/run_simulation.hpp"

namespace verification {
namespace {

/// How many times longer a particle-step takes than on the vector kernels, as `timing.csv` of the suites has
/// it. A factor of two matters little to the order; a run of 8 s that is taken for the shortest keeps all
/// other cores waiting at the end.
double slowness(const SceneConfig& scene) {
  using Scheme = mpm::Scheme;
  if (scene.sph) return 40;
  if (scene.incompressible)
    return std::holds_alternative<mpm::HerschelBulkley>(scene.fluid.solver.rheology) ? 2000 : 50;
  const Scheme& scheme = scene.scheme;
  if (scheme.stepping == Scheme::Stepping::ImplicitEuler ||
      scheme.stepping == Scheme::Stepping::ImplicitSdirk2)
    return 100;
  const bool on_kernels =
      (scheme.transfer == Scheme::Transfer::Flip || scheme.transfer == Scheme::Transfer::FlipBlend) &&
      scheme.stepping != Scheme::Stepping::Leapfrog;
  return on_kernels ? 1 : 20;
}

/// A particle-step of a stability case, as StabilityPlan::cost() counts it.
constexpr double slowness_of_limits = 40;

}  // namespace

Schedule schedule(const std::vector<Study>& studies) {
  Schedule schedule;
  struct Longest {
    double end;
    Job job;
  };
  std::map<std::string, Longest> references;
  for (std::size_t s = 0; s < studies.size(); ++s)
    for (std::size_t r = 0; r < studies[s].runs.size(); ++r) {
      const SceneConfig& scene = studies[s].runs[r].scene;
      (studies[s].repetitions > 0 ? schedule.alone : schedule.shared)
          .push_back({s, r, slowness(scene) * scene.particle_steps()});
      const auto reference = costly_reference(studies[s], scene);
      if (!reference) continue;
      Longest& longest =
          references.try_emplace(reference->name, Longest{-std::numeric_limits<double>::infinity(), {}})
              .first->second;
      if (reference->end > longest.end)
        longest = {reference->end, {s, r, std::numeric_limits<double>::infinity(), Job::Kind::Reference}};
    }
  for (const auto& [name, longest] : references) schedule.shared.push_back(longest.job);
  for (std::size_t s = 0; s < studies.size(); ++s)
    for (std::size_t c = 0; c < studies[s].stability.cases.size(); ++c)
      schedule.shared.push_back(
          {s, c, slowness_of_limits * studies[s].stability.cost(studies[s].stability.cases[c]),
           Job::Kind::Limit});
  for (std::size_t s = 0; s < studies.size(); ++s)
    if (studies[s].control) schedule.shared.push_back({s, 0, 0, Job::Kind::Control});
  std::ranges::stable_sort(schedule.shared, std::ranges::greater{}, &Job::cost);
  return schedule;
}

std::exception_ptr perform_all(const std::vector<Job>& jobs, int threads,
                               const std::function<void(const Job&)>& perform) {
  try {
    reports::for_each_index(jobs.size(), threads, [&](std::size_t i) { perform(jobs[i]); });
  } catch (...) {
    return std::current_exception();
  }
  return nullptr;
}

}  // namespace verification

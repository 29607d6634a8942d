#include "verification/runs/pilot/fits.hpp"

#include <cmath>

#include "verification/runs/scheme_matrix.hpp"

namespace verification {

mpm::FormalOrder orders_of_method(const SceneConfig& scene) {
  if (!scene.incompressible) return formal_order(scene);
  const double degree = scene.incompressible->degree;
  return {degree, degree, 2, 0};
}

std::string why_no_step_by_error(const Study& study, const Ladder& ladder, const SceneConfig& scene,
                                 bool foreign) {
  if (foreign)
    return "\"auto\" is found by runs of the built-in solver, and this scene is for another one: give the "
           "step in s, or leave dt out";
  if (ladder.axis == Axis::Time || ladder.axis == Axis::Mach)
    return "\"auto\" has no meaning beside [ladder] axis = \"" + name(ladder.axis) + "\", which " +
           (ladder.axis == Axis::Time ? "refines dt itself" : "refines no mesh") +
           ": give the step in s, or refine in space";
  if (study.validation)
    return "\"auto\" cannot stand beside [validation], whose inputs are varied at one step: give the step in "
           "s";
  if (study.comparison == Comparison::Discrete || study.comparison == Comparison::SteadyNodes)
    return "\"auto\" needs an error in space, and compare_with = \"discrete\" and \"steady-nodes\" hold a "
           "scheme against its own discrete solution, which has none: give the step in s";
  const mpm::FormalOrder order = orders_of_method(scene);
  if (order.remap_space > 0)
    return "\"auto\" needs an order in time, and this scheme loses ~ h^r/dt: its error grows as dt shrinks; "
           "give the step in s";
  if (study.comparison == Comparison::Finest) {
    if (ladder.axis != Axis::Space || !(ladder.theoretical > 0))
      return "\"auto\" measures the error in space by the next finer level where compare_with = \"finest\": "
             "add a [ladder] with axis = \"space\" and its theoretical order, or give the step in s";
    return "";
  }
  if (study.comparison == Comparison::Exact && !scene.flow->has_exact())
    return "\"auto\" needs a solution to measure the error in space by, and none is known of flow = \"" +
           scene.flow_name + "\": give the step in s, or compare_with = \"finest\" and a [ladder] in space";
  return "";
}

}  // namespace verification

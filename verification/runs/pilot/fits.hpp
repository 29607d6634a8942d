#pragma once

#include <string>

#include "solver/scene/scheme.hpp"
#include "verification/study/study.hpp"

namespace verification {

/// Formal orders of whatever method simulates a scene, the incompressible one included.
mpm::FormalOrder orders_of_method(const SceneConfig& scene);

/// Why no step can be chosen by its error for a scene with dt = "auto" in this study (with this ladder), with
/// a remedy; "" if one can. `foreign`: somebody else's solver runs it.
std::string why_no_step_by_error(const Study& study, const Ladder& ladder, const SceneConfig& scene,
                                 bool foreign);

}  // namespace verification

#include "solver/incompressible/incompressible_scheme.hpp"

#include "solver/scene/scene.hpp"

namespace mpm {

void IncompressibleScheme::validate() const {
  if (degree < 2 || degree > 4) throw SceneError("degree must be 2, 3 or 4");
  if (remap_every < 0) throw SceneError("remap_every must not be negative: steps between remaps, 0 for none");
  if (!(regularisation > 0 && regularisation <= 1)) throw SceneError("regularisation must lie in (0, 1]");
}

std::string name(IncompressibleScheme::Stepping stepping) {
  return stepping == IncompressibleScheme::Stepping::Midpoint ? "midpoint" : "sdirk2";
}

IncompressibleScheme::Stepping incompressible_stepping_named(const std::string& text) {
  for (const auto stepping :
       {IncompressibleScheme::Stepping::Midpoint, IncompressibleScheme::Stepping::Sdirk2})
    if (name(stepping) == text) return stepping;
  throw SceneError("'" + text + "' is not known; choose one of: midpoint, sdirk2");
}

}  // namespace mpm

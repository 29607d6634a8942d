#include "solver/sph/sph_scheme.hpp"

#include <array>
#include <cmath>

#include "solver/scene/scene.hpp"

namespace mpm {
namespace {

template <class Enum>
Enum named(const std::array<Enum, 2>& choices, const std::string& text) {
  for (const Enum choice : choices)
    if (name(choice) == text) return choice;
  throw SceneError("'" + text + "' is not known; choose one of: " + name(choices[0]) + ", " +
                   name(choices[1]));
}

}  // namespace

void SphScheme::validate() const {
  const double ratio = smoothing_ratio();
  if (!(ratio >= 0.7 && ratio <= 5)) throw SceneError("smoothing must lie in [0.7, 5] spacings");
  if (!(wall_limit >= 1 && std::isfinite(wall_limit)))
    throw SceneError("wall_limit must be finite and at least 1");
}

FormalOrder formal_order(const SphScheme& scheme) {
  const double space = scheme.wall == SphScheme::Wall::Mirror ? 2 : 1;
  return {space, space, 2, 0};
}

std::string name(SphScheme::Kernel kernel) {
  return kernel == SphScheme::Kernel::Quintic ? "quintic" : "cubic";
}
std::string name(SphScheme::Density density) {
  return density == SphScheme::Density::Continuity ? "continuity" : "summation";
}
std::string name(SphScheme::Wall wall) {
  return wall == SphScheme::Wall::Mirror ? "mirror" : "morris";
}
SphScheme::Kernel sph_kernel_named(const std::string& text) {
  return named(std::array{SphScheme::Kernel::Quintic, SphScheme::Kernel::Cubic}, text);
}
SphScheme::Density sph_density_named(const std::string& text) {
  return named(std::array{SphScheme::Density::Continuity, SphScheme::Density::Summation}, text);
}
SphScheme::Wall sph_wall_named(const std::string& text) {
  return named(std::array{SphScheme::Wall::Mirror, SphScheme::Wall::Morris}, text);
}

}  // namespace mpm

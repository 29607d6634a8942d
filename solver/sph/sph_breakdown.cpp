#include "solver/sph/sph_breakdown.hpp"

#include <cmath>

namespace mpm::sph {

std::optional<std::string> breakdown_of(const Scene& scene, const VectorField& position,
                                        const VectorField& velocity, const ScalarField& density,
                                        double longest_move) {
  double energy = 0;
  bool inside = true, dense = true;
  for (std::size_t p = 0; p < position.size(); ++p) {
    energy += velocity[p].squaredNorm();
    dense &= density[p] > 0;
    for (const int axis : {0, 1})
      inside &= scene.periodic(axis) || (position[p][axis] >= 0 && position[p][axis] <= scene.size[axis]);
  }
  if (!std::isfinite(energy)) return "velocity is not finite";
  if (longest_move > scene.size.minCoeff()) return "a particle crossed the domain in one step";
  if (!inside) return "a particle left the domain";
  if (!dense) return "density is not positive";
  return std::nullopt;
}

}  // namespace mpm::sph

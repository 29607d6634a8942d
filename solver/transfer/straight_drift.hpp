#pragma once

#include "solver/grid/stencil.hpp"
#include "solver/particles.hpp"
#include "solver/scene/scene.hpp"

namespace mpm {

// The advection of velocity with itself, dv/dt = 0 along dx/dt = v, moves every particle along a straight
// line. Particles whose velocity and gradient are those of the grid's field at their place follow it exactly,
// with no projection on the way: the gradient L turns into L (I + dt L)^-1, volumes grow by det(I + dt L).

/// Whether particles have to know the gradient of their motion: for their density.
inline bool needs_gradients(const Scene& scene) {
  return scene.fluid.pressure;
}

/// Gives every particle the gradient of the grid's velocity.
template <class Basis>
void take_gradients(const Grid& grid, Particles& particles) {
  particles.affine.resize(particles.size());
  for (std::size_t p = 0; p < particles.size(); ++p)
    particles.affine[p] = gradient<Basis>(grid, grid.velocity, particles.position[p]);
}

/// What motion along straight lines for dt [s] makes of gradients and densities.
inline void strain_straight(Particles& particles, double dt) {
  for (std::size_t p = 0; p < particles.size(); ++p) {
    Mat2& l = particles.affine[p];
    const Mat2 stretch = Mat2::Identity() + dt * l;
    const double volume_ratio = stretch(0, 0) * stretch(1, 1) - stretch(0, 1) * stretch(1, 0);
    const double determinant = l(0, 0) * l(1, 1) - l(0, 1) * l(1, 0);
    l = (l + dt * determinant * Mat2::Identity()).eval() / volume_ratio;  // L (I + dt L)^-1 in the plane
    particles.density[p] /= volume_ratio;
  }
}

}  // namespace mpm

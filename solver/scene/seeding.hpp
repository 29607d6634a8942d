#pragma once

#include <vector>

#include "solver/particles.hpp"
#include "solver/scene/scene.hpp"

namespace mpm {

/// Points of a quadrature rule in a cell [0, 1] and their weights, which sum to one.
struct CellPoints {
  std::vector<double> position, weight;
};

/// n points of a seeding rule, n >= 1. Gauss-Legendre points by Newton's method on the Legendre polynomial
/// (Abramowitz and Stegun 25.4.30).
CellPoints cell_points(Seeding::Rule rule, int n);

/// Particles in every cell by the scene's seeding, with the scene's initial density and velocity. Row by row
/// from the bottom, left to right: the order fixes every sum.
Particles seed_particles(const Scene& scene);

/// Gradient of the initial velocity at every particle [1/s], by central differences over 1e-4 of a cell: what
/// particles that carry an affine field start with. Without it the first map to the grid loses O(h^2).
std::vector<Mat2> initial_gradients(const Scene& scene, const Particles& particles);

}  // namespace mpm

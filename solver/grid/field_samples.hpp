#pragma once

#include <vector>

#include "solver/grid/stencil.hpp"

namespace mpm {

/// A nodal velocity interpolated at points [m/s].
template <class Basis>
VectorField field_at(const Grid& grid, const VectorField& nodal, const VectorField& points) {
  VectorField velocities;
  velocities.reserve(points.size());
  for (const Vec2& point : points) velocities.push_back(interpolate<Basis>(grid, nodal, point));
  return velocities;
}

/// Its gradient there, L_ab = d v_a/d x_b [1/s].
template <class Basis>
std::vector<Mat2> gradient_at(const Grid& grid, const VectorField& nodal, const VectorField& points) {
  std::vector<Mat2> gradients;
  gradients.reserve(points.size());
  for (const Vec2& point : points) gradients.push_back(gradient<Basis>(grid, nodal, point));
  return gradients;
}

}  // namespace mpm

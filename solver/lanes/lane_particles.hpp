#pragma once

#include <vector>

#include "solver/kernel/kernel.hpp"
#include "solver/lanes/lane_layout.hpp"
#include "solver/particles.hpp"

namespace mpm {

// Between a scene's particles and axes and the plain data of a kernel.

inline std::vector<PointState> points_of(const Particles& particles, const LaneLayout& layout) {
  std::vector<PointState> points(particles.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    points[p].mass = particles.mass[p];
    points[p].density = particles.density[p];
    for (int c : {0, 1}) {
      points[p].position[c] = particles.position[p][layout.axis_of(c)];
      points[p].velocity[c] = particles.velocity[p][layout.axis_of(c)];
      if (particles.affine.empty()) continue;
      for (int a : {0, 1}) points[p].affine[c][a] = particles.affine[p](layout.axis_of(c), layout.axis_of(a));
    }
  }
  return points;
}

inline void take_points(const std::vector<PointState>& points, const LaneLayout& layout,
                        Particles& particles) {
  for (std::size_t p = 0; p < points.size(); ++p) {
    particles.mass[p] = points[p].mass;
    for (int c : {0, 1}) {
      particles.position[p][layout.axis_of(c)] = points[p].position[c];
      particles.velocity[p][layout.axis_of(c)] = points[p].velocity[c];
      particles.stress[p](layout.axis_of(c), layout.axis_of(c)) = points[p].stress[c];
      if (particles.affine.empty()) continue;
      for (int a : {0, 1}) particles.affine[p](layout.axis_of(c), layout.axis_of(a)) = points[p].affine[c][a];
    }
    particles.density[p] = points[p].density;
    particles.stress[p](0, 1) = particles.stress[p](1, 0) = points[p].stress[2];
  }
}

/// `functions` holds what the line points to.
inline LineOfCells line_of_cells(const Axis& axis, std::vector<double>& functions) {
  const int size = (axis.degree + 1) * (axis.degree + 1);
  functions.clear();
  for (int cell = 0; cell < axis.cells; ++cell) {
    functions.insert(functions.end(), axis.polynomials(cell), axis.polynomials(cell) + size);
    for (int k = 0; k <= axis.degree; ++k) functions.push_back(axis.control_place(cell, k));
  }
  return {axis.cells, axis.periodic, axis.length, axis.inverse_h, functions.data()};
}

}  // namespace mpm

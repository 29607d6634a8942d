#include "solver/incompressible/viscosity/wall_sites.hpp"

#include <cmath>

#include "solver/scene/seeding.hpp"

namespace mpm::incompressible {
namespace {

/// The functions of an axis at a place: values, first and second derivatives.
struct Line {
  int cell;
  VectorXd value, slope, curvature;
  double weight, place;  // [m]
};

Line line(const SplineAxis& axis, int cell, double xi, double weight) {
  return {cell,   axis.values(0, cell, xi),      axis.slopes(0, cell, xi), axis.curvatures(cell, xi),
          weight, (cell + xi) * axis.cell_size()};
}

std::vector<Line> gauss_lines(const SplineAxis& axis) {
  const CellPoints gauss = cell_points(Seeding::Rule::Gauss, axis.degree() + 1);
  std::vector<Line> lines;
  for (int cell = 0; cell < axis.cells(); ++cell)
    for (std::size_t g = 0; g < gauss.position.size(); ++g)
      lines.push_back(line(axis, cell, gauss.position[g], gauss.weight[g] * axis.cell_size()));
  return lines;
}

}  // namespace

std::vector<WallSite> wall_sites(const Scene& scene, const VelocitySpace& space, const WallShares& shares) {
  std::vector<WallSite> sites;
  for (const int across : {0, 1}) {
    const SplineAxis& axis = space.axis(across);
    if (axis.periodic()) continue;
    const std::vector<Line> lines = gauss_lines(space.axis(1 - across));
    for (const int end : {0, 1}) {
      const auto edge = static_cast<std::size_t>(2 * across + end);
      const Side& side = scene.sides[edge];
      if (std::isinf(side.slip_length)) continue;
      const Line wall = line(axis, end == 0 ? 0 : axis.cells() - 1, end, 1);
      const double holds =
          side.slip_length > 0 ? 1 / side.slip_length : wall_penalty * axis.degree() / axis.cell_size();
      for (const Line& on : lines) {
        const Line &x = across == 0 ? wall : on, &y = across == 0 ? on : wall;
        const WallSite::Block along = across == 0 ? WallSite::Block(-x.slope * y.value.transpose())
                                                  : WallSite::Block(x.value * y.slope.transpose());
        sites.push_back({x.cell, y.cell, x.slope * y.slope.transpose(),
                         x.value * y.curvature.transpose() - x.curvature * y.value.transpose(), along,
                         on.weight, &side, across, end == 0 ? -1.0 : 1.0, holds,
                         shares[edge] ? shares[edge](on.place) : 1.0});
      }
    }
  }
  return sites;
}

SiteSetup site_setup(const VelocitySpace& space) {
  SiteSetup setup{space.degree(), {space.axis(0).cells(), space.axis(1).cells()}, {}, {}};
  for (const std::size_t a : {0, 1})
    for (const Line& line : gauss_lines(space.axis(static_cast<int>(a)))) {
      setup.weights[a].push_back(line.weight);
      const std::array<const VectorXd*, 3> derivatives{&line.value, &line.slope, &line.curvature};
      for (std::size_t d = 0; d < 3; ++d)
        setup.functions[a][d].insert(setup.functions[a][d].end(), derivatives[d]->begin(),
                                     derivatives[d]->end());
    }
  return setup;
}

}  // namespace mpm::incompressible

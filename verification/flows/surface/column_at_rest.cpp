#include "verification/flows/surface/column_at_rest.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <vector>

namespace verification {
namespace {

/// What a cell's rows below the surface amount to, in parts of the cell.
struct Filling {
  double volume = 0;
  double to_upper = 0, to_lower = 0;  ///< of the cell's volume, what the hats give to the nodes beside it
};

Filling filling_of(const ColumnAtRest& column, std::size_t cell) {
  Filling filling;
  for (int row = 0; row < column.rows_per_cell; ++row) {
    const double place = (row + 0.5) / column.rows_per_cell;
    if (!((static_cast<double>(cell) + place) * column.cell_size < column.surface)) continue;
    filling.volume += 1.0 / column.rows_per_cell;
    filling.to_upper += place / column.rows_per_cell;
    filling.to_lower += (1 - place) / column.rows_per_cell;
  }
  return filling;
}

/// Of the cells from the bottom up [kg/m3].
std::vector<double> densities_of_cells(const ColumnAtRest& column, const mpm::Fluid& fluid) {
  const double h = column.cell_size, rho_0 = fluid.density, k = fluid.bulk_modulus;
  const auto cells = static_cast<std::size_t>(std::ceil(column.surface / h));
  std::vector<double> density(cells, rho_0);
  double above = 0;  // what the cell above presses on its lower node with, weight included [Pa]
  for (std::size_t c = cells; c-- > 0;) {
    const Filling filling = filling_of(column, c);
    if (!(filling.volume > 0)) continue;
    // K (r^7 - 1) volume = above + g h rho_0 r to_upper, for r = rho/rho_0 by Newton's method.
    const double weight = column.gravity * h * rho_0;
    double r = 1;
    for (int i = 0; i < 50; ++i) {
      const double residual =
          k * (std::pow(r, 7) - 1) * filling.volume - above - weight * r * filling.to_upper;
      const double change = residual / (7 * k * std::pow(r, 6) * filling.volume - weight * filling.to_upper);
      r -= change;
      if (std::abs(change) < 1e-16) break;
    }
    density[c] = rho_0 * r;
    above = k * (std::pow(r, 7) - 1) * filling.volume + weight * r * filling.to_lower;
  }
  return density;
}

}  // namespace

std::function<double(const Vec2&)> density_at_rest(const ColumnAtRest& column, const mpm::Fluid& fluid) {
  // Found when the first particle asks: a scene is read, and refused if it is too large, before it is seeded.
  struct Densities {
    std::once_flag found;
    std::vector<double> of_cells;
  };
  return [column, fluid, densities = std::make_shared<Densities>()](const Vec2& x) {
    std::call_once(densities->found, [&] { densities->of_cells = densities_of_cells(column, fluid); });
    const auto cell = static_cast<std::size_t>(std::max(0.0, std::floor(x.y() / column.cell_size)));
    return densities->of_cells[std::min(cell, densities->of_cells.size() - 1)];
  };
}

}  // namespace verification

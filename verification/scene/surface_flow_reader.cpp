#include "verification/scene/surface_flow_reader.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "verification/flows/box_flow.hpp"
#include "verification/flows/surface/gravity_current_flow.hpp"
#include "verification/flows/surface/standing_wave_flow.hpp"

namespace verification {
namespace {

mpm::Side read_side(TomlTable& table, const std::string& key) {
  if (!table.has(key)) return mpm::Side::joined();
  return mpm::Side::wall(read_vector(table, key));
}

/// Rectangles, polygons and half-planes, together.
std::function<bool(const Vec2&)> read_regions(TomlTable& scene) {
  std::vector<std::function<bool(const Vec2&)>> regions;
  for (TomlTable& table : scene.tables("fluid_region")) {
    if (table.has("rectangle")) {
      const std::vector<double> r = table.numbers("rectangle");
      if (r.size() != 4 || !(r[0] < r[2] && r[1] < r[3]))
        table.fail("rectangle", "must be [left, bottom, right, top] of some extent [m]");
      regions.push_back(
          [r](const Vec2& x) { return x.x() > r[0] && x.y() > r[1] && x.x() < r[2] && x.y() < r[3]; });
    } else if (table.has("polygon")) {
      const std::vector<double> c = table.numbers("polygon");
      if (c.size() < 6 || c.size() % 2 != 0)
        table.fail("polygon", "must be the corners [x1, y1, x2, y2, x3, y3, ...], three at least [m]");
      regions.push_back([c](const Vec2& x) {  // a ray along x crosses the outline an odd number of times
        bool inside = false;
        for (std::size_t i = 0, j = c.size() - 2; i < c.size(); j = i, i += 2)
          if ((c[i + 1] > x.y()) != (c[j + 1] > x.y()) &&
              x.x() < c[i] + (c[j] - c[i]) * (x.y() - c[i + 1]) / (c[j + 1] - c[i + 1]))
            inside = !inside;
        return inside;
      });
    } else if (table.has("below")) {
      const std::vector<double> r = table.numbers("below");
      if (r.size() != 4 || (r[2] == 0 && r[3] == 0))
        table.fail("below", "must be a half-plane [x, y, nx, ny]: a point of its edge, the normal out of it");
      regions.push_back([r](const Vec2& x) { return (x.x() - r[0]) * r[2] + (x.y() - r[1]) * r[3] < 0; });
    } else {
      table.fail("rectangle", "is missing; a [[scene.fluid_region]] is a rectangle, a polygon or below");
    }
    table.refuse_unknown_keys();
  }
  if (regions.empty()) return nullptr;
  return [regions](const Vec2& x) {
    return std::any_of(regions.begin(), regions.end(), [&](const auto& is_inside) { return is_inside(x); });
  };
}

/// Slip length of a wall [m]: none when absent, free above any length.
void read_slip(TomlTable& table, const std::string& key, mpm::Side& side) {
  if (!table.has(key)) return;
  if (side.periodic) table.fail(key, "needs a wall on that side");
  side.slip_length = table.positive(key);
}

void require_pressure(const TomlTable& table, const FluidConfig& fluid) {
  if (!fluid.solver.pressure)
    table.fail("flow", "a fluid with a free surface needs fluid.pressure = true and a bulk_modulus");
}

}  // namespace

FlowPointer read_box(TomlTable& table, const FluidConfig& fluid) {
  BoxParameters p;
  p.size = {table.positive("width"), table.positive("height")};
  TomlTable walls = table.table("walls");
  p.sides = {read_side(walls, "left"), read_side(walls, "right"), read_side(walls, "bottom"),
             read_side(walls, "top")};
  walls.refuse_unknown_keys();
  const std::pair<const char*, mpm::Edge> edges[] = {{"left", mpm::Edge::Left},
                                                     {"right", mpm::Edge::Right},
                                                     {"bottom", mpm::Edge::Bottom},
                                                     {"top", mpm::Edge::Top}};
  std::vector<std::string> free;
  if (table.has("slip")) free = table.texts("slip");
  TomlTable lengths = table.table("slip_length");
  for (const auto& [name, edge] : edges) {
    mpm::Side& side = p.sides[static_cast<std::size_t>(edge)];
    read_slip(lengths, name, side);
    if (std::erase(free, name) == 0) continue;
    if (side.periodic || side.slip_length > 0)
      table.fail("slip", std::string(name) + " must be a wall, and have no slip_length beside");
    side.slip_length = std::numeric_limits<double>::infinity();
  }
  if (!free.empty()) table.fail("slip", "may name left, right, bottom and top, each once: not " + free[0]);
  lengths.refuse_unknown_keys();
  if (table.has("body_acceleration")) p.body_acceleration = read_vector(table, "body_acceleration");
  if (table.has("initial_velocity")) p.initial_velocity = read_vector(table, "initial_velocity");
  p.velocity_scale = table.positive("velocity_scale");
  p.is_fluid = read_regions(table);
  if (table.has("hydrostatic_surface")) {
    p.surface = table.positive("hydrostatic_surface");
    if (!p.is_fluid || !fluid.solver.pressure || !(p.body_acceleration.y() < 0))
      table.fail("hydrostatic_surface",
                 "needs a [[scene.fluid_region]], fluid.pressure = true and a downward body_acceleration");
    if (p.surface > p.size.y())
      table.fail("hydrostatic_surface", "must lie in the box: scene.height at most");
  }
  p.fluid = fluid.solver;
  return std::make_shared<BoxFlow>(p);
}

FlowPointer read_gravity_current(TomlTable& table, const FluidConfig& fluid) {
  require_pressure(table, fluid);
  GravityCurrentFlowParameters p;
  p.front = table.positive("front");
  p.aspect_ratio = table.positive("aspect_ratio");
  p.age = table.positive("age");
  p.room = table.positive("room", p.room);
  if (!(p.room > 1)) table.fail("room", "must exceed 1: the box's width over the front at the start");
  p.fluid = fluid;
  try {
    return std::make_shared<GravityCurrentFlow>(p);
  } catch (const std::invalid_argument& error) {
    table.fail("flow", error.what());
  }
}

FlowPointer read_standing_wave(TomlTable& table, const FluidConfig& fluid) {
  require_pressure(table, fluid);
  StandingWaveFlowParameters p;
  p.wavelength = table.positive("wavelength");
  p.depth = table.positive("depth");
  p.height = table.positive("height");
  if (!(p.height > p.depth)) table.fail("height", "must exceed the depth of the fluid");
  p.gravity = table.positive("gravity");
  p.amplitude = table.positive("amplitude");
  p.kinematic_viscosity = newtonian_viscosity(table, fluid);
  p.fluid = fluid.solver;
  try {
    return std::make_shared<StandingWaveFlow>(p);
  } catch (const std::invalid_argument& error) {
    table.fail("wavelength", error.what());
  }
}

}  // namespace verification

#include "solver/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace mpm {
namespace {

void require(bool holds, const std::string& message) {
  if (!holds) throw SceneError(message);
}

bool positive(double value) {
  return std::isfinite(value) && value > 0;
}

}  // namespace

std::string name(Seeding::Rule rule) {
  return rule == Seeding::Rule::Even ? "even" : "gauss";
}

Seeding::Rule seeding_named(const std::string& text) {
  for (const Seeding::Rule rule : {Seeding::Rule::Even, Seeding::Rule::Gauss})
    if (name(rule) == text) return rule;
  throw SceneError("'" + text + "' is not known; choose one of: even, gauss");
}

Side Side::wall(const Vec2& v, double slip_length) {
  return {false, [v](double) { return v; }, [](double) -> Vec2 { return Vec2::Zero(); }, slip_length};
}

Side Side::pulled(double traction) {
  Side side = wall(Vec2::Zero(), std::numeric_limits<double>::infinity());
  side.traction = traction;
  return side;
}

double Fluid::sound_speed() const {
  return pressure ? std::sqrt(7 * bulk_modulus / density) : 0;
}

double Fluid::largest_kinematic_viscosity() const {
  return std::visit([](const auto& law) { return law.largest_viscosity(); }, rheology) / density;
}

double Scene::smallest_cell_size() const {
  return std::min(cell_size(0), cell_size(1));
}

void Scene::validate() const {
  for (int axis : {0, 1}) {
    const auto a = static_cast<std::size_t>(axis);
    const std::string along = axis == 0 ? "x" : "y";
    require(positive(size[axis]), "the domain's size along " + along + " must be positive and finite");
    require(cells[a] >= 1, "the number of cells along " + along + " must be at least 1");
    require(particles_per_cell[a] >= 1, "particles per cell along " + along + " must be at least 1");
    require(sides[2 * a].periodic == sides[2 * a + 1].periodic,
            "sides that face each other along " + along + " must both be periodic or both be walls");
    require(std::isfinite(seeding.shift[a]) && (seeding.shift[a] == 0 || periodic(axis)),
            "the shift of the particles along " + along + " must be finite, and 0 between walls");
  }
  require(seeding.displacement >= 0 && seeding.displacement <= 0.5, "the displacement must lie in [0, 0.5]");
  for (const Side& s : sides)
    require(s.periodic || (s.velocity && s.acceleration), "a wall needs a velocity and an acceleration");
  for (const Side& s : sides) {
    require(s.slip_length >= 0, "a wall's slip length must not be negative");
    require(s.slip_length == 0 || !std::isfinite(s.slip_length) ||
                std::holds_alternative<Newtonian>(fluid.rheology),
            "a wall with a finite slip length needs a Newtonian fluid; let others stick or slip freely");
    require(s.traction == 0 || (std::isfinite(s.traction) && std::isinf(s.slip_length)),
            "a traction must be finite, and pulls at a side on which the fluid slips freely");
  }
  require(!free_surface || free_surface->is_fluid, "a free surface needs the region that the fluid fills");
  require(!free_surface || fluid.pressure, "a fluid with a free surface needs its pressure");
  require(positive(fluid.density), "the density must be positive and finite");
  require(!fluid.pressure || positive(fluid.bulk_modulus), "the bulk modulus must be positive and finite");
  const double nu = fluid.largest_kinematic_viscosity();
  require(std::isfinite(nu) && nu >= 0, "the viscosity must be finite and not negative");
}

void check_together(const Scene& scene, const Scheme& scheme) {
  using Stepping = Scheme::Stepping;
  const bool is_cell = scheme.dilatation == Scheme::Dilatation::Cell;
  require(!is_cell || scene.fluid.pressure,
          "dilatation 'cell' is for fluids with pressure: without it no density changes");
  require(!scene.free_surface || is_cell, "a free surface needs the scheme's dilatation = 'cell'");
  const bool is_simple = scheme.transfer != Scheme::Transfer::FullMass && !scheme.resets() &&
                         (scheme.stepping == Stepping::Usf || scheme.stepping == Stepping::Usl ||
                          scheme.stepping == Stepping::Musl);
  require(!scene.free_surface || is_simple,
          "a free surface needs a transfer with lumped mass, stepping usf, usl or musl, and no reset of "
          "particles");
  for (const Side& s : scene.sides)
    require(
        s.slip_length == 0 || is_simple,
        "a wall that lets the fluid slip needs a transfer with lumped mass, stepping usf, usl or musl, and "
        "no reset of particles");
}

}  // namespace mpm

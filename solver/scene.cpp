#include "solver/scene.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace mpm {
namespace {

void require(bool holds, const std::string& message) {
  if (!holds) throw SceneError(message);
}

bool positive(double value) {
  return std::isfinite(value) && value > 0;
}

// One table a part of the scheme, read in both directions.
template <class Enum>
using Names = std::span<const std::pair<Enum, const char*>>;

constexpr std::pair<Scheme::Basis, const char*> basis_names[] = {{Scheme::Basis::Linear, "linear"}};
constexpr std::pair<Scheme::Transfer, const char*> transfer_names[] = {{Scheme::Transfer::Flip, "flip"}};
constexpr std::pair<Scheme::Stepping, const char*> stepping_names[] = {
    {Scheme::Stepping::Usf, "usf"}, {Scheme::Stepping::Usl, "usl"}, {Scheme::Stepping::Musl, "musl"}};

template <class Enum>
std::string name_in(Names<Enum> names, Enum value) {
  for (const auto& [key, text] : names)
    if (key == value) return text;
  throw SceneError("a scheme's part has no name");
}

template <class Enum>
Enum value_in(Names<Enum> names, const std::string& text) {
  std::string known;
  for (const auto& [key, known_text] : names) {
    if (text == known_text) return key;
    known += (known.empty() ? "" : ", ") + std::string(known_text);
  }
  throw SceneError("'" + text + "' is not known; choose one of: " + known);
}

}  // namespace

std::string name(Scheme::Basis basis) {
  return name_in(Names<Scheme::Basis>(basis_names), basis);
}
std::string name(Scheme::Transfer transfer) {
  return name_in(Names<Scheme::Transfer>(transfer_names), transfer);
}
std::string name(Scheme::Stepping stepping) {
  return name_in(Names<Scheme::Stepping>(stepping_names), stepping);
}
Scheme::Basis basis_named(const std::string& text) {
  return value_in(Names<Scheme::Basis>(basis_names), text);
}
Scheme::Transfer transfer_named(const std::string& text) {
  return value_in(Names<Scheme::Transfer>(transfer_names), text);
}
Scheme::Stepping stepping_named(const std::string& text) {
  return value_in(Names<Scheme::Stepping>(stepping_names), text);
}

Side Side::wall(const Vec2& v) {
  return {false, [v](double) { return v; }, [](double) -> Vec2 { return Vec2::Zero(); }};
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
  }
  for (const Side& s : sides)
    require(s.periodic || (s.velocity && s.acceleration), "a wall needs a velocity and an acceleration");
  require(positive(fluid.density), "the density must be positive and finite");
  require(!fluid.pressure || positive(fluid.bulk_modulus), "the bulk modulus must be positive and finite");
  const double nu = fluid.largest_kinematic_viscosity();
  require(std::isfinite(nu) && nu >= 0, "the viscosity must be finite and not negative");
}

}  // namespace mpm

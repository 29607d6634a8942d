#include "solver/scene/scheme.hpp"

#include <cmath>
#include <sstream>

#include "solver/scene/scene.hpp"

namespace mpm {
namespace {

template <class Enum>
std::string name_in(const std::vector<SchemePart>& parts, Enum value) {
  return parts.at(static_cast<std::size_t>(value)).name;
}

template <class Enum>
Enum value_in(const std::vector<SchemePart>& parts, const std::string& text) {
  std::string known;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].name == text) return static_cast<Enum>(i);
    known += (known.empty() ? "" : ", ") + parts[i].name;
  }
  throw SceneError("'" + text + "' is not known; choose one of: " + known);
}

}  // namespace

void Scheme::validate() const {
  if (!(flip_fraction >= 0 && flip_fraction <= 1)) throw SceneError("flip_fraction must lie in [0, 1]");
  if (reset_every < 0) throw SceneError("reset_every must not be negative");
  if (!(reset_strain >= 0 && std::isfinite(reset_strain)))
    throw SceneError("reset_strain must be finite and not negative");
  if (method != Method::Sph) return;
  const double ratio = sph.smoothing_ratio();
  if (!(ratio >= 0.7 && ratio <= 5)) throw SceneError("smoothing must lie in [0.7, 5] spacings");
  if (!(sph.wall_limit >= 1 && std::isfinite(sph.wall_limit)))
    throw SceneError("wall_limit must be finite and at least 1");
}

const std::vector<SchemePart>& method_parts() {
  static const std::vector<SchemePart> parts = {
      {"mpm", "material point method"},
      {"sph", "smoothed particle hydrodynamics"},
  };
  return parts;
}

const std::vector<SchemePart>& sph_kernel_parts() {
  static const std::vector<SchemePart> parts = {
      {"quintic", "quintic spline, support of three smoothing lengths"},
      {"cubic", "cubic spline, support of two smoothing lengths"},
  };
  return parts;
}

const std::vector<SchemePart>& sph_density_parts() {
  static const std::vector<SchemePart> parts = {
      {"continuity", "density follows the divergence of the velocity"},
      {"summation", "density is the sum of the neighbours' masses under the kernel"},
  };
  return parts;
}

const std::vector<SchemePart>& sph_wall_parts() {
  static const std::vector<SchemePart> parts = {
      {"mirror", "images of the fluid, the velocity reflected in the wall's"},
      {"morris", "fixed particles, velocity extrapolated through the wall and limited"},
  };
  return parts;
}

std::string name(Scheme::Method method) {
  return name_in(method_parts(), method);
}
std::string name(SphScheme::Kernel kernel) {
  return name_in(sph_kernel_parts(), kernel);
}
std::string name(SphScheme::Density density) {
  return name_in(sph_density_parts(), density);
}
std::string name(SphScheme::Wall wall) {
  return name_in(sph_wall_parts(), wall);
}

const std::vector<SchemePart>& basis_parts() {
  static const std::vector<SchemePart> parts = {
      {"linear", "hat functions, the paper's 4-node element"},
      {"quadratic", "quadratic B-splines, clamped at walls"},
      {"cubic", "cubic B-splines, clamped at walls"},
  };
  return parts;
}

const std::vector<SchemePart>& transfer_parts() {
  static const std::vector<SchemePart> parts = {
      {"flip", "lumped mass; particles take the grid's increment, as in the paper"},
      {"pic", "lumped mass; particles take the grid's velocity and lose what the grid cannot hold"},
      {"flip-blend", "lumped mass; FLIP and PIC mixed by flip_fraction"},
      {"apic", "lumped mass; particles carry an affine field, loss-free with the linear basis"},
      {"full-mass",
       "consistent mass, walls imposed in the projection: from grid to particles and back nothing is lost"},
  };
  return parts;
}

const std::vector<SchemePart>& stepping_parts() {
  static const std::vector<SchemePart> parts = {
      {"usf", "explicit, stress updated first"},
      {"usl", "explicit, stress updated last"},
      {"musl", "explicit, stress updated last from velocities mapped back"},
      {"leapfrog", "explicit, second order: half a drift, a kick by the midpoint rule, half a drift"},
      {"implicit-euler", "viscosity by backward Euler, pressure explicit"},
      {"implicit-sdirk2", "viscosity by an L-stable two-stage rule of second order, pressure by leapfrog"},
  };
  return parts;
}

std::string name(Scheme::Basis basis) {
  return name_in(basis_parts(), basis);
}
std::string name(Scheme::Transfer transfer) {
  return name_in(transfer_parts(), transfer);
}
std::string name(Scheme::Stepping stepping) {
  return name_in(stepping_parts(), stepping);
}
std::string reset_name(const Scheme& scheme) {
  if (!scheme.resets()) return "never";
  std::string text;
  if (scheme.reset_every > 0)
    text = "every " + std::to_string(scheme.reset_every) + (scheme.reset_every == 1 ? " step" : " steps");
  if (scheme.reset_strain > 0) {
    std::ostringstream strain;
    strain << scheme.reset_strain;
    text += (text.empty() ? "every strain of " : " or strain of ") + strain.str();
  }
  return text;
}
Scheme::Method method_named(const std::string& text) {
  return value_in<Scheme::Method>(method_parts(), text);
}
SphScheme::Kernel sph_kernel_named(const std::string& text) {
  return value_in<SphScheme::Kernel>(sph_kernel_parts(), text);
}
SphScheme::Density sph_density_named(const std::string& text) {
  return value_in<SphScheme::Density>(sph_density_parts(), text);
}
SphScheme::Wall sph_wall_named(const std::string& text) {
  return value_in<SphScheme::Wall>(sph_wall_parts(), text);
}
Scheme::Basis basis_named(const std::string& text) {
  return value_in<Scheme::Basis>(basis_parts(), text);
}
Scheme::Transfer transfer_named(const std::string& text) {
  return value_in<Scheme::Transfer>(transfer_parts(), text);
}
Scheme::Stepping stepping_named(const std::string& text) {
  return value_in<Scheme::Stepping>(stepping_parts(), text);
}

FormalOrder formal_order(const Scheme& scheme) {
  if (scheme.method == Scheme::Method::Sph) {
    const double order = scheme.sph.wall == SphScheme::Wall::Mirror ? 2 : 1;
    return {order, order, 2, 0};
  }
  const int degree = 1 + static_cast<int>(scheme.basis);
  FormalOrder order{2, 2, 1, 0};
  using Transfer = Scheme::Transfer;
  if (scheme.transfer == Transfer::FullMass) order.space = order.space_particles = degree + 1;
  // FLIP with lumped mass and clamped splines: what lumping moves where the first functions overlap the
  // wall's is O(h) of the wall's gradient. The grid's own velocity does not feel it, the particles keep it,
  // in a layer O(h) wide: Linf of order 1, L2 of order 3/2.
  if (scheme.transfer == Transfer::Flip && degree > 1) order.space_particles = 1.5;
  if (scheme.transfer == Transfer::Pic ||
      (scheme.transfer == Transfer::FlipBlend && scheme.flip_fraction < 1))
    order.remap_space = 2;
  if (scheme.transfer == Transfer::Apic && degree > 1) order.remap_space = 4;
  using Stepping = Scheme::Stepping;
  // What particles keep of their own velocity the grid sees smoothed. The leapfrog's stage maps back and sees
  // it too; the implicit stages do not, which costs O(h^2 dt).
  const bool keeps = scheme.transfer == Transfer::Flip || scheme.transfer == Transfer::FlipBlend;
  if (scheme.stepping == Stepping::Leapfrog || (scheme.stepping == Stepping::ImplicitSdirk2 && !keeps))
    order.time = 2;
  return order;
}

}  // namespace mpm

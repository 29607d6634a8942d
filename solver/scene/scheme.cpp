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
  if (dilatation == Dilatation::Cell && transfer == Transfer::FullMass &&
      (stepping == Stepping::Leapfrog || stepping == Stepping::ImplicitSdirk2))
    throw SceneError("dilatation 'cell' does not go with full-mass and " + name(stepping) +
                     ", whose particles carry their own gradient; use 'particle', or another transfer or "
                     "stepping");
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

const std::vector<SchemePart>& dilatation_parts() {
  static const std::vector<SchemePart> parts = {
      {"particle", "density follows the dilatation at each particle, as in the paper"},
      {"cell", "one dilatation and one density a cell: densities cannot drift away from where particles are"},
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
std::string name(Scheme::Dilatation dilatation) {
  return name_in(dilatation_parts(), dilatation);
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
Scheme::Basis basis_named(const std::string& text) {
  return value_in<Scheme::Basis>(basis_parts(), text);
}
Scheme::Transfer transfer_named(const std::string& text) {
  return value_in<Scheme::Transfer>(transfer_parts(), text);
}
Scheme::Stepping stepping_named(const std::string& text) {
  return value_in<Scheme::Stepping>(stepping_parts(), text);
}
Scheme::Dilatation dilatation_named(const std::string& text) {
  return value_in<Scheme::Dilatation>(dilatation_parts(), text);
}

FormalOrder formal_order(const Scheme& scheme) {
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

#include "solver/sph/neighbourhood.hpp"

#include <algorithm>
#include <cmath>

#include "solver/sph/stable_sph_step.hpp"

namespace mpm::sph {

Neighbourhood::Neighbourhood(const Scene& scene, const SphScheme& scheme, int lanes)
    : kernel_(kernel_of(scheme, scene)),
      row_height_(particle_spacing(scene, 1)),
      most_skin_(skin_share * kernel_.radius),
      skin_(most_skin_),
      wall_limit_(scheme.wall_limit),
      lanes_(lanes),
      surroundings_(scene, scheme.wall, kernel_.radius + most_skin_) {}

/// A skin s of the support adds 2 s of the pairs to every step, and spreads the price of a list, that of some
/// three steps, over s support/(2 move) steps: s^2 = 3 move/support is the cheapest.
void Neighbourhood::find(const VectorField& position, const ScalarField& mass, double viscosity,
                         double move) {
  constexpr double steps_a_list = 3;
  skin_ = std::clamp(std::sqrt(steps_a_list * move * kernel_.radius), 0.1 * most_skin_, most_skin_);
  moved_ = 0;
  surroundings_.rebuild(position);
  const VectorField all = surroundings_.positions(position);
  rows_.rebuild(all, surroundings_.wall_begin(), row_height_);
  windows_.rebuild(rows_, all, position.size(), kernel_.radius + skin_, lanes_);

  entries_.clear(rows_.slot_count());
  std::fill(entries_.viscosity.begin(), entries_.viscosity.end(), viscosity);
  for (std::size_t p = 0; p < mass.size(); ++p) entries_.mass[rows_.slots()[p]] = mass[p];
  surroundings_.settle(entries_, rows_.slots());

  slope_.resize(windows_.pairs());
  sums_.density.resize(windows_.places());
  for (auto* sums : {&sums_.acceleration, &sums_.wall_acceleration})
    for (ScalarField& sum : *sums) sum.resize(windows_.places());
  for (ScalarField& sum : sums_.velocity_gradient) sum.resize(windows_.places());
}

void Neighbourhood::place(const VectorField& position) {
  for (std::size_t p = 0; p < position.size(); ++p) {
    entries_.position[0][rows_.slots()[p]] = position[p].x();
    entries_.position[1][rows_.slots()[p]] = position[p].y();
  }
  surroundings_.place(entries_, rows_.slots());
}

void Neighbourhood::carry(Entries& entries, const VectorField& velocity, double t) const {
  for (std::size_t p = 0; p < velocity.size(); ++p) {
    entries.velocity[0][rows_.slots()[p]] = velocity[p].x();
    entries.velocity[1][rows_.slots()[p]] = velocity[p].y();
  }
  surroundings_.carry(entries, rows_.slots(), t);
}

void Neighbourhood::strain(const ScalarField& viscosity) {
  for (std::size_t p = 0; p < windows_.particles(); ++p) {
    const std::size_t slot = rows_.slots()[p], place = windows_.place(p);
    entries_.viscosity[slot] = viscosity[place];
    for (const std::size_t k : {0, 1, 2, 3})
      entries_.stress[k][slot] = viscosity[place] * sums_.velocity_gradient[k][place];
  }
  surroundings_.strain(entries_, rows_.slots());
}

PairWork Neighbourhood::work(const Vec2& gravity) {
  auto& [density, l, a, of_walls] = sums_;
  return {entries_.fields(),
          windows_.groups().data(),
          windows_.windows().data(),
          kernel_.weight.points(),
          kernel_.gradient.points(),
          slope_.data(),
          density.data(),
          {l[0].data(), l[1].data(), l[2].data(), l[3].data()},
          {a[0].data(), a[1].data()},
          {of_walls[0].data(), of_walls[1].data()},
          surroundings_.has_fixed(),
          wall_limit_,
          {gravity.x(), gravity.y()}};
}

std::vector<LocalFit> Neighbourhood::fits(const VectorField& points, const VectorField& velocity,
                                          double t) const {
  Entries entries = entries_;
  carry(entries, velocity, t);
  std::vector<LocalFit> found;
  found.reserve(points.size());
  for (const Vec2& point : points)
    found.push_back(
        fit_at(point, entries, rows_, kernel_.radius + skin_, !surroundings_.has_fixed(), kernel_));
  return found;
}

}  // namespace mpm::sph

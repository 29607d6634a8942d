#include "solver/sph/surroundings.hpp"

#include <cmath>

namespace mpm::sph {

Surroundings::Surroundings(const Scene& scene, SphScheme::Wall walls, double band)
    : scene_(scene), walls_(walls), band_(band) {
  if (walls_ == SphScheme::Wall::Morris) fixed_ = fixed_particles();
}

double Surroundings::distance(const Vec2& x, Edge edge) const {
  switch (edge) {
    case Edge::Left:
      return x.x();
    case Edge::Right:
      return scene_.size.x() - x.x();
    case Edge::Bottom:
      return x.y();
    case Edge::Top:
      return scene_.size.y() - x.y();
  }
  return 0;
}

/// Copies or images of one entry along an axis, wherever they lie within the band.
void Surroundings::add_images(std::vector<Image>& to, const Image& of, const VectorField& fluid,
                              int axis) const {
  const auto a = static_cast<std::size_t>(axis);
  const double length = scene_.size[axis];
  const double x = (of.mirror[a] ? -1 : 1) * fluid[of.source][axis] + of.shift[axis];
  if (scene_.periodic(axis)) {
    for (const int direction : {-1, 1})
      for (int times = 1;; ++times) {
        const double moved = direction * times * length;
        if (x + moved < -band_ || x + moved > length + band_) break;
        to.push_back(of);
        to.back().shift[axis] += moved;
      }
    return;
  }
  if (walls_ == SphScheme::Wall::Morris) return;
  for (const std::uint8_t mirror : {1, 2}) {
    const double wall = mirror == 1 ? 0 : length;
    if (std::abs(x - wall) > band_) continue;
    to.push_back(of);
    to.back().mirror[a] = mirror;
    to.back().shift[axis] = 2 * wall - of.shift[axis];
  }
}

void Surroundings::rebuild(const VectorField& fluid) {
  fluid_ = fluid.size();
  std::vector<Image> along_x, all;
  for (std::size_t p = 0; p < fluid.size(); ++p)
    add_images(along_x, {static_cast<std::uint32_t>(p), {0, 0}, Vec2::Zero()}, fluid, 0);
  all = along_x;
  for (std::size_t p = 0; p < fluid.size(); ++p)
    add_images(all, {static_cast<std::uint32_t>(p), {0, 0}, Vec2::Zero()}, fluid, 1);
  for (const Image& image : along_x) add_images(all, image, fluid, 1);
  images_.clear();
  const auto behind_wall = [](const Image& image) { return image.mirror[0] || image.mirror[1]; };
  for (const Image& image : all)
    if (!behind_wall(image)) images_.push_back(image);
  wall_begin_ = fluid_ + images_.size();
  for (const Image& image : all)
    if (behind_wall(image)) images_.push_back(image);
}

VectorField Surroundings::positions(const VectorField& fluid) const {
  VectorField all = fluid;
  all.reserve(size());
  for (const Image& image : images_) {
    const Vec2& x = fluid[image.source];
    all.emplace_back(image.shift.x() + (image.mirror[0] ? -x.x() : x.x()),
                     image.shift.y() + (image.mirror[1] ? -x.y() : x.y()));
  }
  for (const Fixed& fixed : fixed_) all.push_back(fixed.position);
  return all;
}

void Surroundings::settle(Entries& entries, std::span<const std::uint32_t> slots) const {
  for (std::size_t k = 0; k < images_.size(); ++k)
    entries.mass[slots[fluid_ + k]] = entries.mass[slots[images_[k].source]];
  const Vec2 spacing(scene_.cell_size(0) / scene_.particles_per_cell[0],
                     scene_.cell_size(1) / scene_.particles_per_cell[1]);
  for (std::size_t k = 0; k < fixed_.size(); ++k) {
    const Fixed& fixed = fixed_[k];
    const std::size_t slot = slots[fluid_ + images_.size() + k];
    const auto edge = static_cast<int>(fixed.edge);
    const int axis = edge / 2;
    const double inwards = edge % 2 == 0 ? 1 : -1;
    for (const std::size_t a : {0, 1}) entries.position[a][slot] = fixed.position[static_cast<int>(a)];
    entries.mass[slot] = scene_.fluid.density * spacing.x() * spacing.y();
    entries.inverse_density[slot] = 1 / scene_.fluid.density;
    entries.wall_normal[axis][slot] = inwards;
    entries.wall_offset[slot] = inwards < 0 ? scene_.size[axis] : 0;
    entries.wall_depth[slot] = fixed.depth;
  }
}

void Surroundings::place(Entries& entries, std::span<const std::uint32_t> slots) const {
  for (std::size_t k = 0; k < images_.size(); ++k) {
    const Image& image = images_[k];
    const std::size_t from = slots[image.source], to = slots[fluid_ + k];
    for (const std::size_t a : {0, 1}) {
      const double x = entries.position[a][from];
      entries.position[a][to] = image.shift[static_cast<int>(a)] + (image.mirror[a] ? -x : x);
    }
  }
}

void Surroundings::carry(Entries& entries, std::span<const std::uint32_t> slots, double t) const {
  std::array<Vec2, 4> wall_velocity;
  for (std::size_t e = 0; e < 4; ++e)
    wall_velocity[e] = scene_.sides[e].periodic ? Vec2(Vec2::Zero()) : scene_.sides[e].velocity(t);
  std::array<std::array<Vec2, 3>, 3> added;  // by the mirrors along x and y
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      Vec2 v = i == 0 ? Vec2(Vec2::Zero()) : Vec2(2 * wall_velocity[i - 1]);
      added[i][j] = j == 0 ? v : Vec2(2 * wall_velocity[1 + j] - v);
    }
  for (std::size_t k = 0; k < images_.size(); ++k) {
    const auto [i, j] = images_[k].mirror;
    const std::size_t from = slots[images_[k].source], to = slots[fluid_ + k];
    const double turn = (i == 0) == (j == 0) ? 1 : -1;
    for (const std::size_t a : {0, 1})
      entries.velocity[a][to] = turn * entries.velocity[a][from] + added[i][j][static_cast<int>(a)];
  }
  for (std::size_t k = 0; k < fixed_.size(); ++k) {
    const Vec2& v = wall_velocity[static_cast<std::size_t>(fixed_[k].edge)];
    for (const std::size_t a : {0, 1})
      entries.velocity[a][slots[fluid_ + images_.size() + k]] = v[static_cast<int>(a)];
  }
}

void Surroundings::press(Entries& entries, std::span<const std::uint32_t> slots, double t,
                         const Vec2& gravity) const {
  // dP/dn = rho (g - dV/dt)_n on the wall, so that fluid at rest under gravity stays there
  std::array<std::array<double, 3>, 2> rise{};
  for (const int axis : {0, 1})
    for (std::size_t mirror = 1; mirror < 3; ++mirror) {
      const auto a = static_cast<std::size_t>(axis);
      const Side& side = scene_.sides[2 * a + mirror - 1];
      if (!side.periodic) rise[a][mirror] = (gravity - side.acceleration(t))[axis];
    }
  for (std::size_t k = 0; k < images_.size(); ++k) {
    const auto& mirror = images_[k].mirror;
    const std::size_t from = slots[images_[k].source], to = slots[fluid_ + k];
    double work = 0;
    for (const std::size_t a : {0, 1})
      work += rise[a][mirror[a]] * (entries.position[a][to] - entries.position[a][from]);
    entries.inverse_density[to] = entries.inverse_density[from];
    entries.pressure_term[to] = entries.pressure_term[from] + entries.inverse_density[from] * work;
  }
}

void Surroundings::strain(Entries& entries, std::span<const std::uint32_t> slots) const {
  for (std::size_t k = 0; k < images_.size(); ++k) {
    const Image& image = images_[k];
    const std::size_t from = slots[image.source], to = slots[fluid_ + k];
    entries.viscosity[to] = entries.viscosity[from];
    for (const std::size_t component : {0, 1, 2, 3}) {  // v' = -v, d/dx' = -d/dx
      const bool turns = image.mirror[1 - component % 2] != 0;
      const double stress = entries.stress[component][from];
      entries.stress[component][to] = turns ? -stress : stress;
    }
  }
}

/// The fluid's lattice continued behind the walls, and along periodic directions as far as anything is
/// needed.
std::vector<Surroundings::Fixed> Surroundings::fixed_particles() const {
  std::array<int, 2> inside{}, beyond{};
  Vec2 spacing;
  for (const int axis : {0, 1}) {
    const auto a = static_cast<std::size_t>(axis);
    inside[a] = scene_.cells[a] * scene_.particles_per_cell[a];
    spacing[axis] = scene_.size[axis] / inside[a];
    beyond[a] = static_cast<int>(std::ceil(band_ / spacing[axis]));
  }
  std::vector<Fixed> fixed;
  for (int j = -beyond[1]; j < inside[1] + beyond[1]; ++j)
    for (int i = -beyond[0]; i < inside[0] + beyond[0]; ++i) {
      Fixed one{Vec2((i + 0.5) * spacing.x(), (j + 0.5) * spacing.y()), Edge::Left, 0};
      for (const Edge edge : {Edge::Left, Edge::Right, Edge::Bottom, Edge::Top}) {
        const double depth = -distance(one.position, edge);
        if (scene_.side(edge).periodic || depth <= one.depth) continue;
        one.depth = depth;
        one.edge = edge;
      }
      if (one.depth > 0) fixed.push_back(one);
    }
  return fixed;
}

}  // namespace mpm::sph

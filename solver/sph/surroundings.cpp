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
  const double x = of.sign[a] * fluid[of.source][axis] + of.shift[axis];
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
  for (const double wall : {0.0, length}) {
    if (std::abs(x - wall) > band_) continue;
    to.push_back(of);
    to.back().sign[a] = static_cast<std::int8_t>(-of.sign[a]);
    to.back().shift[axis] = 2 * wall - of.shift[axis];
  }
}

void Surroundings::rebuild(const VectorField& fluid) {
  fluid_ = fluid.size();
  std::vector<Image> along_x, all;
  for (std::size_t p = 0; p < fluid.size(); ++p)
    add_images(along_x, {static_cast<std::uint32_t>(p), {1, 1}, Vec2::Zero()}, fluid, 0);
  all = along_x;
  for (std::size_t p = 0; p < fluid.size(); ++p)
    add_images(all, {static_cast<std::uint32_t>(p), {1, 1}, Vec2::Zero()}, fluid, 1);
  for (const Image& image : along_x) add_images(all, image, fluid, 1);
  images_.clear();
  const auto behind_wall = [](const Image& image) { return image.sign[0] < 0 || image.sign[1] < 0; };
  for (const Image& image : all)
    if (!behind_wall(image)) images_.push_back(image);
  wall_begin_ = fluid_ + images_.size();
  for (const Image& image : all)
    if (behind_wall(image)) images_.push_back(image);
}

void Surroundings::fill(std::vector<Neighbour>& entries, double t, const Vec2& gravity) const {
  std::array<Vec2, 4> wall_velocity, rise;
  for (std::size_t e = 0; e < 4; ++e) {
    const Side& side = scene_.sides[e];
    wall_velocity[e] = side.periodic ? Vec2(Vec2::Zero()) : side.velocity(t);
    rise[e] = side.periodic ? gravity : Vec2(gravity - side.acceleration(t));
  }
  for (std::size_t k = 0; k < images_.size(); ++k) {
    const Image& image = images_[k];
    const Neighbour& source = entries[image.source];
    Neighbour copy = source;
    for (const int axis : {0, 1}) {
      const auto a = static_cast<std::size_t>(axis);
      copy.position[axis] = image.sign[a] * source.position[axis] + image.shift[axis];
      if (image.sign[a] > 0) continue;
      const std::size_t edge = 2 * a + (copy.position[axis] > 0 ? 1 : 0);
      copy.velocity = 2 * wall_velocity[edge] - copy.velocity;
      // dP/dn = rho (g - dV/dt)_n on the wall, so that fluid at rest under gravity stays there
      copy.pressure_term +=
          source.inverse_density * rise[edge][axis] * (copy.position[axis] - source.position[axis]);
    }
    entries[fluid_ + k] = copy;
  }
  for (std::size_t k = 0; k < fixed_.size(); ++k) {
    Neighbour& entry = entries[fluid_ + images_.size() + k];
    const Vec2 spacing(scene_.cell_size(0) / scene_.particles_per_cell[0],
                       scene_.cell_size(1) / scene_.particles_per_cell[1]);
    const double mass = scene_.fluid.density * spacing.x() * spacing.y();
    entry = {fixed_[k].position,
             wall_velocity[static_cast<std::size_t>(fixed_[k].edge)],
             mass,
             0,
             1 / scene_.fluid.density,
             0};
  }
}

void Surroundings::fill(std::vector<Mat2>& stress) const {
  for (std::size_t k = 0; k < images_.size(); ++k) {
    const Image& image = images_[k];
    Mat2 copy = stress[image.source];
    for (const int axis : {0, 1})
      if (image.sign[static_cast<std::size_t>(axis)] < 0) copy.col(1 - axis) *= -1;  // v' = -v, d/dx' = -d/dx
    stress[fluid_ + k] = copy;
  }
  for (std::size_t k = 0; k < fixed_.size(); ++k) stress[fluid_ + images_.size() + k].setZero();
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

#pragma once

#include "solver/grid/stencil.hpp"
#include "solver/particles.hpp"
#include "solver/transfer/consistent_mass.hpp"
#include "solver/transfer/lumped_mass.hpp"

namespace mpm {

// Transfer policies: what a particle hands to the grid and takes from it. Each names
//   Mass             how nodal momentum becomes nodal velocity (lumped or consistent);
//   add_momentum     P2G: the share of particle p in the nodal momenta;
//   take             G2P: the new velocities of the particles from the grid's velocity and acceleration;
//   take_jump        the share of particle p in a jump of nodal velocities (impulsive start);
//   grid_fraction    the part of a particle's velocity that take() replaces by the grid's;
//   is_grid_field    whether P2G after G2P is the identity, so that particles stand for the grid's own field.

/// P2G of transfers whose particles carry a velocity only: sum_p N_ip m_p v_p (paper Eq. 15).
struct VelocityToGrid {
  template <class Basis, class Around>
  void add_momentum(const Around& stencil, const Particles& particles, std::size_t p, ScalarField& mass,
                    VectorField& momentum) const {
    const double m_p = particles.mass[p];
    const Vec2 v_p = particles.velocity[p];
    stencil.values([&](std::size_t i, double n) {
      mass[i] += n * m_p;
      momentum[i] += n * m_p * v_p;
    });
  }

  template <class Basis>
  void take_jump(const Grid& grid, const VectorField& jump, Particles& particles, std::size_t p) const {
    particles.velocity[p] += interpolate<Basis>(grid, jump, particles.position[p]);
  }
};

/// FLIP: the particle keeps its velocity and takes the grid's increment (paper Eqs. 18-19). PIC: it takes the
/// grid's velocity (Harlow 1964). And means of both (Zhu and Bridson 2005).
struct FlipPic : VelocityToGrid {
  using Mass = LumpedMass;
  static constexpr bool is_grid_field = false;
  double flip_fraction;  ///< 1 is FLIP, 0 is PIC

  explicit FlipPic(double fraction) : flip_fraction(fraction) {}
  [[nodiscard]] double grid_fraction() const { return 1 - flip_fraction; }

  template <class Basis>
  void take(const Grid& grid, double dt, Particles& particles) const {
    const auto at = [&](const VectorField& field, std::size_t p) {
      return interpolate<Basis>(grid, field, particles.position[p]);
    };
    VectorField& v = particles.velocity;
    if (flip_fraction == 1)
      for (std::size_t p = 0; p < v.size(); ++p) v[p] += dt * at(grid.acceleration, p);
    else if (flip_fraction == 0)
      for (std::size_t p = 0; p < v.size(); ++p) v[p] = at(grid.velocity, p);
    else
      for (std::size_t p = 0; p < v.size(); ++p) take_both<Basis>(grid, dt, particles.position[p], v[p]);
  }

 private:
  template <class Basis>
  void take_both(const Grid& grid, double dt, const Vec2& x_p, Vec2& v_p) const {
    Vec2 v = Vec2::Zero(), a = Vec2::Zero();
    Stencil<Basis>(grid, x_p).values([&](std::size_t i, double n) {
      v += n * grid.velocity[i];
      a += n * grid.acceleration[i];
    });
    v_p = flip_fraction * (v_p + dt * a) + (1 - flip_fraction) * v;
  }
};

/// APIC: the particle carries an affine field v_p + C_p (x - x_p) (Jiang et al. 2015). C_p = B_p D_p^-1 with
/// B_p = sum N v_i (x_i - x_p)^T and D_p = sum N (x_i - x_p)(x_i - x_p)^T; x_i are control points, so that
/// the first moments vanish and D_p is diagonal at walls too. For the linear basis C_p is the field's
/// gradient (Jiang et al. 2017), which needs no inverse on cell edges.
struct Apic {
  using Mass = LumpedMass;
  static constexpr bool is_grid_field = false;
  [[nodiscard]] static double grid_fraction() { return 1; }

  template <class Basis>
  void add_momentum(const Stencil<Basis>& stencil, const Particles& particles, std::size_t p,
                    ScalarField& mass, VectorField& momentum) const {
    const double m_p = particles.mass[p];
    const Vec2 v_p = particles.velocity[p];
    const Mat2 c_p = particles.affine[p];
    stencil.offsets([&](std::size_t i, double n, const Vec2& offset) {
      mass[i] += n * m_p;
      momentum[i] += n * m_p * (v_p + c_p * offset);
    });
  }

  template <class Basis>
  void take(const Grid& grid, double, Particles& particles) const {
    for (std::size_t p = 0; p < particles.size(); ++p) {
      particles.velocity[p] = interpolate<Basis>(grid, grid.velocity, particles.position[p]);
      particles.affine[p] = affine_field<Basis>(grid, grid.velocity, particles.position[p]);
    }
  }

  template <class Basis>
  void take_jump(const Grid& grid, const VectorField& jump, Particles& particles, std::size_t p) const {
    particles.velocity[p] += interpolate<Basis>(grid, jump, particles.position[p]);
    particles.affine[p] += affine_field<Basis>(grid, jump, particles.position[p]);
  }

  template <class Basis>
  static Mat2 affine_field(const Grid& grid, const VectorField& field, const Vec2& point) {
    Mat2 c = gradient<Basis>(grid, field, point);
    if constexpr (Basis::degree > 1) {
      Mat2 b = Mat2::Zero();
      Vec2 d = Vec2::Zero();
      Stencil<Basis>(grid, point).offsets([&](std::size_t i, double n, const Vec2& offset) {
        b += n * field[i] * offset.transpose();
        d += n * offset.cwiseAbs2();
      });
      // On a wall one function is one and the others vanish: B and D with them, and the gradient remains.
      const Vec2 h(grid.x.h, grid.y.h);
      for (int axis : {0, 1})
        if (d[axis] > 1e-12 * h[axis] * h[axis]) c.col(axis) = b.col(axis) / d[axis];
    }
    return c;
  }
};

/// Consistent ("full") mass: v = M^-1 sum_p N m_p v_p with the walls' values imposed, and the particle takes
/// the grid's velocity. The projection leaves fields of the grid as they are, so nothing is lost on the way
/// (Burgess, Sulsky and Brackbill 1992).
struct FullMass : VelocityToGrid {
  using Mass = ConsistentMass;
  static constexpr bool is_grid_field = true;
  [[nodiscard]] static double grid_fraction() { return 1; }

  template <class Basis>
  void take(const Grid& grid, double, Particles& particles) const {
    for (std::size_t p = 0; p < particles.size(); ++p)
      particles.velocity[p] = interpolate<Basis>(grid, grid.velocity, particles.position[p]);
  }
};

}  // namespace mpm

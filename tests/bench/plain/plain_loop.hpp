#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

// What the vector kernels are measured against: the paper's scheme (linear basis, FLIP, update stress first)
// as one would write it down at first, an array of particles, an array of nodes, three scalar loops a step.
// It is not made slow on purpose: everything is inlined, nothing is allocated in a step, the stress update
// and the internal force share one visit to the nodes, as do G2P and the move, no pow or division is done
// twice.
namespace plain {

template <class Real>
struct Particle {
  Real x, y, u, v, mass, density, s_xx, s_yy, s_xy;
};

template <class Real>
struct Node {
  Real mass, u, v, f_x, f_y, a_x, a_y;
};

/// A channel along x, periodic, between walls at rest at y = 0 and y = height.
struct Channel {
  double length, height;
  int cells_x, cells_y, per_side;  ///< cells, and particles a cell and direction
  double density, bulk_modulus, body_acceleration;
  bool pressure;
};

/// `Viscosity` gives mu [Pa s] from gdot^2 = 2 D:D [1/s2]; for one that does not ask for it the compiler
/// leaves the shear rate out. `Real` is double, or a number that counts what is done to it.
template <class Viscosity, class Real = double>
class Loop {
 public:
  using Particle = plain::Particle<Real>;
  using Node = plain::Node<Real>;

  Loop(const Channel& channel, Viscosity viscosity)
      : channel_(channel),
        viscosity_(viscosity),
        inverse_hx_(channel.cells_x / channel.length),
        inverse_hy_(channel.cells_y / channel.height),
        nodes_(static_cast<std::size_t>(channel.cells_x * (channel.cells_y + 1))) {
    const int nx = channel.cells_x * channel.per_side, ny = channel.cells_y * channel.per_side;
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        particles_.push_back({(i + 0.5) * channel.length / nx, (j + 0.5) * channel.height / ny, 0, 0,
                              channel.density * channel.length * channel.height / (nx * ny), channel.density,
                              0, 0, 0});
  }

  [[nodiscard]] std::vector<Particle>& particles() { return particles_; }

  void step(double dt) {
    for (Node& node : nodes_) node = {0, 0, 0, 0, 0, 0, 0};
    for (const Particle& p : particles_) {
      const Stencil s = stencil(p);
      for (int k = 0; k < 4; ++k) {
        Node& node = nodes_[s.node[k]];
        const Real m = s.n[k] * p.mass;
        node.mass += m;
        node.u += m * p.u;
        node.v += m * p.v;
      }
    }
    for (Node& node : nodes_) {
      if (!(node.mass > 0)) continue;
      node.u /= node.mass;
      node.v /= node.mass;
    }
    each_wall_node([](Node& node) { node.u = node.v = 0; });

    for (Particle& p : particles_) {
      const Stencil s = stencil(p);
      Real d_xx = 0, d_yy = 0, l_xy = 0, l_yx = 0;
      for (int k = 0; k < 4; ++k) {
        const Node& node = nodes_[s.node[k]];
        d_xx += node.u * s.dn_x[k];
        l_xy += node.u * s.dn_y[k];
        l_yx += node.v * s.dn_x[k];
        d_yy += node.v * s.dn_y[k];
      }
      const Real d_xy = 0.5 * (l_xy + l_yx), trace = d_xx + d_yy;
      const Real mu = viscosity_(2 * (d_xx * d_xx + d_yy * d_yy) + 4 * d_xy * d_xy);
      Real isotropic = -(2.0 / 3.0) * mu * trace;
      if (channel_.pressure) {
        p.density /= 1 + dt * trace;
        const Real r = p.density * (1 / channel_.density), r3 = r * r * r;
        isotropic -= channel_.bulk_modulus * (r3 * r3 * r - 1);
      }
      p.s_xx = 2 * mu * d_xx + isotropic;
      p.s_yy = 2 * mu * d_yy + isotropic;
      p.s_xy = 2 * mu * d_xy;
      const Real volume = p.mass / p.density;
      const Real f_xx = volume * p.s_xx, f_yy = volume * p.s_yy, f_xy = volume * p.s_xy;
      for (int k = 0; k < 4; ++k) {
        Node& node = nodes_[s.node[k]];
        node.f_x -= f_xx * s.dn_x[k] + f_xy * s.dn_y[k];
        node.f_y -= f_xy * s.dn_x[k] + f_yy * s.dn_y[k];
      }
    }
    for (Node& node : nodes_) {
      if (!(node.mass > 0)) continue;
      node.a_x = node.f_x / node.mass + channel_.body_acceleration;
      node.a_y = node.f_y / node.mass;
    }
    each_wall_node([](Node& node) { node.a_x = node.a_y = 0; });
    for (Node& node : nodes_) {
      node.u += dt * node.a_x;
      node.v += dt * node.a_y;
    }

    for (Particle& p : particles_) {
      const Stencil s = stencil(p);
      Real u = 0, v = 0, a_x = 0, a_y = 0;
      for (int k = 0; k < 4; ++k) {
        const Node& node = nodes_[s.node[k]];
        u += s.n[k] * node.u;
        v += s.n[k] * node.v;
        a_x += s.n[k] * node.a_x;
        a_y += s.n[k] * node.a_y;
      }
      p.u += dt * a_x;
      p.v += dt * a_y;
      p.x += dt * u;
      p.y += dt * v;
      if (p.x < 0) p.x += channel_.length;
      if (p.x > channel_.length) p.x -= channel_.length;
    }
  }

 private:
  struct Stencil {
    std::size_t node[4];
    Real n[4], dn_x[4], dn_y[4];
  };

  [[nodiscard]] Stencil stencil(const Particle& p) const {
    const int i = std::clamp(static_cast<int>(p.x * inverse_hx_), 0, channel_.cells_x - 1);
    const int j = std::clamp(static_cast<int>(p.y * inverse_hy_), 0, channel_.cells_y - 1);
    const int right = i + 1 == channel_.cells_x ? 0 : i + 1;
    const Real s = p.x * inverse_hx_ - i, t = p.y * inverse_hy_ - j;
    const auto at = [&](int column, int row) {
      return static_cast<std::size_t>(row * channel_.cells_x + column);
    };
    return {{at(i, j), at(right, j), at(i, j + 1), at(right, j + 1)},
            {(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t},
            {-inverse_hx_ * (1 - t), inverse_hx_ * (1 - t), -inverse_hx_ * t, inverse_hx_ * t},
            {-inverse_hy_ * (1 - s), -inverse_hy_ * s, inverse_hy_ * (1 - s), inverse_hy_ * s}};
  }

  template <class F>
  void each_wall_node(F f) {
    for (int i = 0; i < channel_.cells_x; ++i) {
      f(nodes_[static_cast<std::size_t>(i)]);
      f(nodes_[static_cast<std::size_t>(channel_.cells_y * channel_.cells_x + i)]);
    }
  }

  Channel channel_;
  Viscosity viscosity_;
  double inverse_hx_, inverse_hy_;
  std::vector<Particle> particles_;
  std::vector<Node> nodes_;
};

struct Newtonian {
  double mu;
  template <class Real>
  Real operator()(const Real&) const {
    return mu;
  }
};

/// Cross fluid with M = 1.
struct Cross {
  double mu_0, mu_inf, K;
  template <class Real>
  Real operator()(const Real& gdot_squared) const {
    using std::sqrt;
    return mu_inf + (mu_0 - mu_inf) / (1 + K * sqrt(gdot_squared));
  }
};

struct PowerLaw {
  double mu_0, n, floor;
  template <class Real>
  Real operator()(const Real& gdot_squared) const {
    using std::pow;
    return mu_0 * pow(std::max<Real>(gdot_squared, floor * floor), 0.5 * (n - 1));
  }
};

}  // namespace plain

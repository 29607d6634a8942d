#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

// What the schemes that are accurate in two dimensions are measured against, as plain_loop.hpp for the
// paper's scheme: a Newtonian fluid under Tait's pressure in a periodic square box, particle by particle, as
// one would write it down at first. Nothing is slow on purpose: all is inlined, nothing is allocated in a
// step, weights are products of one function an axis.
namespace plain {

/// Per unit depth, SI units. Affine field L_ab = d v_a/d x_b.
struct Point {
  double x[2], v[2], mass, volume, l[2][2];
};

struct Box {
  double length;
  int cells;
  double density, bulk_modulus, viscosity;
};

/// A particle's uniform B-splines along one axis: numbers of their nodes, values, slopes [1/m], and where
/// their control points are from the particle [m].
template <int degree>
struct Line {
  int node[degree + 1];
  double n[degree + 1], dn[degree + 1], away[degree + 1];

  Line(double x, int cells, double inverse_h) {
    const int cell = std::clamp(static_cast<int>(x * inverse_h), 0, cells - 1);
    const double s = x * inverse_h - cell, r = 1 - s;
    for (int k = 0; k <= degree; ++k) {
      node[k] = cell + k < cells ? cell + k : cell + k - cells;
      away[k] = (k - 0.5 * (degree - 1) - s) / inverse_h;
    }
    if constexpr (degree == 2) {
      set({0.5 * r * r, 0.5 + s * r, 0.5 * s * s}, {-r, r - s, s}, inverse_h);
    } else {
      const double sixth = 1.0 / 6;
      set({sixth * r * r * r, sixth * (4 - 3 * s * s * (1 + r)), sixth * (4 - 3 * r * r * (1 + s)),
           sixth * s * s * s},
          {-0.5 * r * r, s * (1.5 * s - 2), -r * (1.5 * r - 2), 0.5 * s * s}, inverse_h);
    }
  }

 private:
  void set(const double (&values)[degree + 1], const double (&slopes)[degree + 1], double inverse_h) {
    for (int k = 0; k <= degree; ++k) {
      n[k] = values[k];
      dn[k] = slopes[k] * inverse_h;
    }
  }
};

/// A particle's functions: f(node, value, slope along x, slope along y, k, l) for all of them.
template <int degree>
struct Functions {
  Line<degree> x, y;
  int cells;

  Functions(const Point& p, const Box& box)
      : x(p.x[0], box.cells, box.cells / box.length),
        y(p.x[1], box.cells, box.cells / box.length),
        cells(box.cells) {}

  template <class F>
  void each(F&& f) const {
    for (int l = 0; l <= degree; ++l)
      for (int k = 0; k <= degree; ++k)
        f(static_cast<std::size_t>(y.node[l] * cells + x.node[k]), x.n[k] * y.n[l], x.dn[k] * y.n[l],
          x.n[k] * y.dn[l], k, l);
  }
};

/// Volume times stress, of a velocity gradient.
struct Tension {
  double xx, yy, xy;

  Tension(const Box& box, const Point& p, const double (&l)[2][2]) {
    const double r = p.mass / (p.volume * box.density), r3 = r * r * r;
    const double isotropic =
        -(2.0 / 3.0) * box.viscosity * (l[0][0] + l[1][1]) - box.bulk_modulus * (r3 * r3 * r - 1);
    xx = p.volume * (2 * box.viscosity * l[0][0] + isotropic);
    yy = p.volume * (2 * box.viscosity * l[1][1] + isotropic);
    xy = p.volume * box.viscosity * (l[0][1] + l[1][0]);
  }
};

inline void wrap(Point& p, double length) {
  for (double& x : p.x) {
    if (x < 0) x += length;
    if (x >= length) x -= length;
  }
}

/// Quadratic splines, APIC, update stress first.
class Apic {
 public:
  Apic(const Box& box, std::vector<Point> points)
      : box_(box), points_(std::move(points)), nodes_(static_cast<std::size_t>(box.cells * box.cells)) {}

  [[nodiscard]] const std::vector<Point>& points() const { return points_; }

  void step(double dt) {
    for (Node& node : nodes_) node = {};
    for (const Point& p : points_) {
      const Functions<2> at(p, box_);
      at.each([&](std::size_t i, double n, double, double, int k, int l) {
        Node& node = nodes_[i];
        const double m = n * p.mass;
        node.mass += m;
        for (int c : {0, 1}) node.v[c] += m * (p.v[c] + p.l[c][0] * at.x.away[k] + p.l[c][1] * at.y.away[l]);
      });
    }
    for (Node& node : nodes_)
      if (node.mass > 0)
        for (double& v : node.v) v /= node.mass;
    for (Point& p : points_) {
      const Functions<2> at(p, box_);
      double grad[2][2] = {};
      at.each([&](std::size_t i, double, double dn_x, double dn_y, int, int) {
        for (int c : {0, 1}) {
          grad[c][0] += nodes_[i].v[c] * dn_x;
          grad[c][1] += nodes_[i].v[c] * dn_y;
        }
      });
      p.volume *= 1 + dt * (grad[0][0] + grad[1][1]);
      const Tension q(box_, p, grad);
      at.each([&](std::size_t i, double, double dn_x, double dn_y, int, int) {
        nodes_[i].f[0] -= q.xx * dn_x + q.xy * dn_y;
        nodes_[i].f[1] -= q.xy * dn_x + q.yy * dn_y;
      });
    }
    for (Node& node : nodes_)
      if (node.mass > 0)
        for (int c : {0, 1}) node.v[c] += dt * node.f[c] / node.mass;
    for (Point& p : points_) {
      const Functions<2> at(p, box_);
      double d[2] = {0, 0};
      for (int k = 0; k < 3; ++k) {
        d[0] += at.x.n[k] * at.x.away[k] * at.x.away[k];
        d[1] += at.y.n[k] * at.y.away[k] * at.y.away[k];
      }
      double v[2] = {}, b[2][2] = {};
      at.each([&](std::size_t i, double n, double, double, int k, int l) {
        for (int c : {0, 1}) {
          const double nv = n * nodes_[i].v[c];
          v[c] += nv;
          b[c][0] += nv * at.x.away[k];
          b[c][1] += nv * at.y.away[l];
        }
      });
      for (int c : {0, 1}) {
        p.v[c] = v[c];
        p.l[c][0] = b[c][0] / d[0];
        p.l[c][1] = b[c][1] / d[1];
        p.x[c] += dt * v[c];
      }
      wrap(p, box_.length);
    }
  }

 private:
  struct Node {
    double mass = 0, v[2] = {0, 0}, f[2] = {0, 0};
  };

  Box box_;
  std::vector<Point> points_;
  std::vector<Node> nodes_;
};

}  // namespace plain

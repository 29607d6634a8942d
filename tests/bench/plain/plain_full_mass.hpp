#pragma once

#include <array>

#include "tests/bench/plain/plain_vortices.hpp"

namespace plain {

/// Cubic splines, full mass, leapfrog: the mass matrix as 49 entries a row, its solves by conjugate gradients
/// scaled by the diagonal, from the solution of the step before.
class FullMass {
 public:
  FullMass(const Box& box, std::vector<Point> points)
      : box_(box),
        points_(std::move(points)),
        rows_(static_cast<std::size_t>(box.cells * box.cells)),
        column_(rows_.size()),
        v_(rows_.size()),
        start_(v_),
        a_(v_),
        b_(v_),
        r_(v_),
        z_(v_),
        d_(v_),
        q_(v_) {
    const int n = box.cells;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (int dj = -3; dj <= 3; ++dj)
          for (int di = -3; di <= 3; ++di)
            column_[static_cast<std::size_t>(j * n + i)][number(di, dj)] =
                (j + dj + n) % n * n + (i + di + n) % n;
  }

  [[nodiscard]] const std::vector<Point>& points() const { return points_; }

  void step(double dt) {
    drift(dt / 2);
    project();
    start_ = v_;
    kick(dt / 2);
    kick(dt);
    take();
    drift(dt / 2);
  }

 private:
  using Pair = std::array<double, 2>;
  using Field = std::vector<Pair>;
  using Row = std::array<double, 49>;

  static std::size_t number(int di, int dj) { return static_cast<std::size_t>((dj + 3) * 7 + di + 3); }

  void drift(double dt) {
    for (Point& p : points_) {
      auto& l = p.l;
      const double det = l[0][0] * l[1][1] - l[0][1] * l[1][0];
      const double ratio = 1 + dt * (l[0][0] + l[1][1]) + dt * dt * det;
      p.volume *= ratio;
      l[0][0] = (l[0][0] + dt * det) / ratio;
      l[1][1] = (l[1][1] + dt * det) / ratio;
      l[0][1] /= ratio;
      l[1][0] /= ratio;
      for (int c : {0, 1}) p.x[c] += dt * p.v[c];
      wrap(p, box_.length);
    }
  }

  void project() {
    for (Row& row : rows_) row = {};
    for (Pair& b : b_) b = {};
    for (const Point& p : points_) {
      const Functions<3> at(p, box_);
      at.each([&](std::size_t i, double n_i, double, double, int k, int l) {
        const double m = p.mass * n_i;
        for (int c : {0, 1}) b_[i][static_cast<std::size_t>(c)] += m * p.v[c];
        at.each([&](std::size_t, double n_j, double, double, int of_x, int of_y) {
          rows_[i][number(of_x - k, of_y - l)] += m * n_j;
        });
      });
    }
    solve(v_);
  }

  /// a = M^-1 f of the nodal velocity, v = start + dt a.
  void kick(double dt) {
    for (Pair& b : b_) b = {};
    for (const Point& p : points_) {
      const Functions<3> at(p, box_);
      double grad[2][2] = {};
      at.each([&](std::size_t i, double, double dn_x, double dn_y, int, int) {
        for (std::size_t c : {0, 1}) {
          grad[c][0] += v_[i][c] * dn_x;
          grad[c][1] += v_[i][c] * dn_y;
        }
      });
      const Tension q(box_, p, grad);
      at.each([&](std::size_t i, double, double dn_x, double dn_y, int, int) {
        b_[i][0] -= q.xx * dn_x + q.xy * dn_y;
        b_[i][1] -= q.xy * dn_x + q.yy * dn_y;
      });
    }
    solve(a_);
    for (std::size_t i = 0; i < v_.size(); ++i)
      for (std::size_t c : {0, 1}) v_[i][c] = start_[i][c] + dt * a_[i][c];
  }

  void take() {
    for (Point& p : points_) {
      double v[2] = {}, grad[2][2] = {};
      Functions<3>(p, box_).each([&](std::size_t i, double n, double dn_x, double dn_y, int, int) {
        for (std::size_t c : {0, 1}) {
          v[c] += n * v_[i][c];
          grad[c][0] += v_[i][c] * dn_x;
          grad[c][1] += v_[i][c] * dn_y;
        }
      });
      for (int c : {0, 1}) {
        p.v[c] = v[c];
        for (int axis : {0, 1}) p.l[c][axis] = grad[c][axis];
      }
    }
  }

  /// M x = b for both components at once, from x on.
  void solve(Field& x) {
    constexpr double tolerance = 1e-14;
    constexpr std::size_t own = 24;  // in the middle of a row
    const auto precondition = [&](const Field& r) {
      Pair product{};
      for (std::size_t i = 0; i < r.size(); ++i)
        for (std::size_t c : {0, 1}) {
          z_[i][c] = r[i][c] / rows_[i][own];
          product[c] += r[i][c] * z_[i][c];
        }
      return product;
    };
    Pair enough = precondition(b_);
    for (double& e : enough) e *= tolerance * tolerance;
    multiply(x);
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t c : {0, 1}) r_[i][c] = b_[i][c] - q_[i][c];
    Pair size = precondition(r_);
    d_ = z_;
    for (int iteration = 0; iteration < 200 && (size[0] > enough[0] || size[1] > enough[1]); ++iteration) {
      multiply(d_);
      Pair step{};
      for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t c : {0, 1}) step[c] += d_[i][c] * q_[i][c];
      for (std::size_t c : {0, 1}) step[c] = step[c] > 0 ? size[c] / step[c] : 0;
      for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t c : {0, 1}) {
          x[i][c] += step[c] * d_[i][c];
          r_[i][c] -= step[c] * q_[i][c];
        }
      const Pair next = precondition(r_);
      Pair turn{};
      for (std::size_t c : {0, 1}) turn[c] = size[c] > 0 ? next[c] / size[c] : 0;
      for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t c : {0, 1}) d_[i][c] = z_[i][c] + turn[c] * d_[i][c];
      size = next;
    }
  }

  /// q = M x
  void multiply(const Field& x) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      Pair sum{};
      for (std::size_t k = 0; k < 49; ++k) {
        const Pair& of = x[static_cast<std::size_t>(column_[i][k])];
        for (std::size_t c : {0, 1}) sum[c] += rows_[i][k] * of[c];
      }
      q_[i] = sum;
    }
  }

  Box box_;
  std::vector<Point> points_;
  std::vector<Row> rows_;
  std::vector<std::array<int, 49>> column_;
  Field v_, start_, a_, b_, r_, z_, d_, q_;
};

}  // namespace plain

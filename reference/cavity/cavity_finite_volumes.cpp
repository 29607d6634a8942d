#include "reference/cavity/cavity_finite_volumes.hpp"

#include <Eigen/Sparse>
#include <Eigen/SparseLU>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "reference/interruption.hpp"

namespace reference {
namespace {

constexpr double sweep_tolerance = 2e-8;
constexpr int most_sweeps = 300;

/// Cubic through four neighbours of an array of places (i + offset) h.
std::array<double, 4> cubic_weights(double s) {  // s in [0, 1] between the second and the third
  return {-s * (s - 1) * (s - 2) / 6, (s + 1) * (s - 1) * (s - 2) / 2, -(s + 1) * s * (s - 2) / 2,
          (s + 1) * s * (s - 1) / 6};
}

}  // namespace

/// One substitution: coefficients from the last velocities, then the linear system for the next.
class CavityEquations {
 public:
  CavityEquations(const ViscosityOfRate& viscosity, CavityFiniteVolumes& flow)
      : viscosity_(viscosity), flow_(flow), n_(flow.cells_), h_(1.0 / n_) {}

  /// Largest change of a velocity.
  double substitute() {
    find_viscosities();
    entries_.clear();
    const int velocities = 2 * n_ * (n_ - 1), size = velocities + n_ * n_;
    right_ = Eigen::VectorXd::Zero(size);
    for (int j = 0; j < n_; ++j)
      for (int i = 1; i < n_; ++i) x_momentum(i, j);
    for (int j = 1; j < n_; ++j)
      for (int i = 0; i < n_; ++i) y_momentum(i, j);
    for (int j = 0; j < n_; ++j)
      for (int i = 0; i < n_; ++i) {
        const int row = p_at(i, j);
        if (row == velocities) {  // the pressure is known up to a constant
          entries_.emplace_back(row, row, 1);
          continue;
        }
        add_u(row, i + 1, j, h_);
        add_u(row, i, j, -h_);
        add_v(row, i, j + 1, h_);
        add_v(row, i, j, -h_);
      }
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    if (!analysed_) solver_.analyzePattern(matrix);
    analysed_ = true;
    solver_.factorize(matrix);
    const Eigen::VectorXd next = solver_.solve(right_);
    double change = 0;
    const auto take = [&](double& old, double value) {
      change = std::max(change, std::abs(value - old));
      if (!std::isfinite(value)) change = value;
      old = value;
    };
    for (int j = 0; j < n_; ++j)
      for (int i = 1; i < n_; ++i) take(u(i, j), next[u_at(i, j)]);
    for (int j = 1; j < n_; ++j)
      for (int i = 0; i < n_; ++i) take(v(i, j), next[v_at(i, j)]);
    return change;
  }

 private:
  double& u(int i, int j) { return flow_.u_[static_cast<std::size_t>(i + (n_ + 1) * j)]; }
  double& v(int i, int j) { return flow_.v_[static_cast<std::size_t>(i + n_ * j)]; }
  [[nodiscard]] int u_at(int i, int j) const { return (i - 1) + (n_ - 1) * j; }
  [[nodiscard]] int v_at(int i, int j) const { return n_ * (n_ - 1) + i + n_ * (j - 1); }
  [[nodiscard]] int p_at(int i, int j) const { return 2 * n_ * (n_ - 1) + i + n_ * j; }
  double& centre(int i, int j) { return centres_[static_cast<std::size_t>(i + n_ * j)]; }
  double& corner(int i, int j) { return corners_[static_cast<std::size_t>(i + (n_ + 1) * j)]; }

  void add_u(int row, int i, int j, double value) {
    if (i == 0 || i == n_) return;  // zero on the wall
    if (j < 0) return add_u(row, i, 0, -value);
    if (j == n_) {
      right_[row] -= 2 * value;  // the lid: 2 - u
      return add_u(row, i, n_ - 1, -value);
    }
    entries_.emplace_back(row, u_at(i, j), value);
  }
  void add_v(int row, int i, int j, double value) {
    if (j == 0 || j == n_) return;
    if (i < 0) return add_v(row, 0, j, -value);
    if (i == n_) return add_v(row, n_ - 1, j, -value);
    entries_.emplace_back(row, v_at(i, j), value);
  }
  double u_or_mirror(int i, int j) {
    if (j < 0) return -u(i, 0);
    return j == n_ ? 2 - u(i, n_ - 1) : u(i, j);
  }
  double v_or_mirror(int i, int j) {
    if (i < 0) return -v(0, j);
    return i == n_ ? -v(n_ - 1, j) : v(i, j);
  }

  void find_viscosities() {
    std::vector<double> stretch(centres_.size()), shear(corners_.size());
    stretch.resize(static_cast<std::size_t>(n_ * n_));
    shear.resize(static_cast<std::size_t>((n_ + 1) * (n_ + 1)));
    centres_.resize(stretch.size());
    corners_.resize(shear.size());
    for (int j = 0; j < n_; ++j)
      for (int i = 0; i < n_; ++i)
        stretch[static_cast<std::size_t>(i + n_ * j)] = (u(i + 1, j) - u(i, j)) / h_;  // v_y = -u_x
    for (int j = 0; j <= n_; ++j)
      for (int i = 0; i <= n_; ++i)
        shear[static_cast<std::size_t>(i + (n_ + 1) * j)] =
            (u_or_mirror(i, j) - u_or_mirror(i, j - 1) + v_or_mirror(i, j) - v_or_mirror(i - 1, j)) / h_;
    const auto at_squared = [&](double q) { return viscosity_(std::sqrt(std::max(q, 1e-16))); };
    for (int j = 0; j < n_; ++j)
      for (int i = 0; i < n_; ++i) {
        double mean = 0;
        for (const int b : {0, 1})
          for (const int a : {0, 1}) {
            const double g = shear[static_cast<std::size_t>(i + a + (n_ + 1) * (j + b))];
            mean += 0.25 * g * g;
          }
        const double e = stretch[static_cast<std::size_t>(i + n_ * j)];
        centre(i, j) = at_squared(4 * e * e + mean);
      }
    for (int j = 0; j <= n_; ++j)
      for (int i = 0; i <= n_; ++i) {
        double sum = 0;
        int count = 0;
        for (const int b : {j - 1, j})
          for (const int a : {i - 1, i}) {
            if (a < 0 || a >= n_ || b < 0 || b >= n_) continue;
            const double e = stretch[static_cast<std::size_t>(a + n_ * b)];
            sum += e * e;
            ++count;
          }
        const double g = shear[static_cast<std::size_t>(i + (n_ + 1) * j)];
        corner(i, j) = at_squared(4 * sum / count + g * g);
      }
  }

  /// Fluxes of momentum out of the cell of u_ij, times h.
  void x_momentum(int i, int j) {
    const int row = u_at(i, j);
    for (const int side : {0, 1}) {
      const double out = side == 0 ? -1 : 1;
      const int c = i - 1 + side;  // cell whose centre lies on the face
      const double speed = 0.5 * (u(c, j) + u(c + 1, j));
      add_u(row, c, j, out * h_ * 0.5 * speed);
      add_u(row, c + 1, j, out * h_ * 0.5 * speed);
      add_u(row, c + 1, j, -out * 2 * centre(c, j));
      add_u(row, c, j, out * 2 * centre(c, j));
      entries_.emplace_back(row, p_at(c, j), out * h_);
      const int k = j + side;  // row of corners
      const double across = 0.5 * (v(i - 1, k) + v(i, k));
      add_u(row, i, k - 1, out * h_ * 0.5 * across);
      add_u(row, i, k, out * h_ * 0.5 * across);
      const double nu = corner(i, k);
      add_u(row, i, k, -out * nu);
      add_u(row, i, k - 1, out * nu);
      add_v(row, i, k, -out * nu);
      add_v(row, i - 1, k, out * nu);
    }
  }

  void y_momentum(int i, int j) {
    const int row = v_at(i, j);
    for (const int side : {0, 1}) {
      const double out = side == 0 ? -1 : 1;
      const int c = j - 1 + side;
      const double speed = 0.5 * (v(i, c) + v(i, c + 1));
      add_v(row, i, c, out * h_ * 0.5 * speed);
      add_v(row, i, c + 1, out * h_ * 0.5 * speed);
      add_v(row, i, c + 1, -out * 2 * centre(i, c));
      add_v(row, i, c, out * 2 * centre(i, c));
      entries_.emplace_back(row, p_at(i, c), out * h_);
      const int k = i + side;
      const double across = 0.5 * (u(k, j - 1) + u(k, j));
      add_v(row, k - 1, j, out * h_ * 0.5 * across);
      add_v(row, k, j, out * h_ * 0.5 * across);
      const double nu = corner(k, j);
      add_v(row, k, j, -out * nu);
      add_v(row, k - 1, j, out * nu);
      add_u(row, k, j, -out * nu);
      add_u(row, k, j - 1, out * nu);
    }
  }

  const ViscosityOfRate& viscosity_;
  CavityFiniteVolumes& flow_;
  int n_;
  double h_;
  std::vector<double> centres_, corners_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd right_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver_;
  bool analysed_ = false;
};

CavityFiniteVolumes::CavityFiniteVolumes(const ViscosityOfRate& viscosity, int cells,
                                         const CavityFiniteVolumes* coarser)
    : cells_(cells),
      u_(static_cast<std::size_t>((cells + 1) * cells), 0.0),
      v_(static_cast<std::size_t>((cells + 1) * cells), 0.0) {
  const double h = 1.0 / cells;
  if (coarser) {
    for (int j = 0; j < cells; ++j)
      for (int i = 1; i < cells; ++i) {
        u_[static_cast<std::size_t>(i + (cells + 1) * j)] = coarser->velocity(0, i * h, (j + 0.5) * h);
        v_[static_cast<std::size_t>(j + cells * i)] = coarser->velocity(1, (j + 0.5) * h, i * h);
      }
  } else {
    // Any flow with a shear rate: a fluid at rest may have no viscosity, or an infinite one.
    for (int j = 0; j < cells; ++j)
      for (int i = 1; i < cells; ++i)
        u_[static_cast<std::size_t>(i + (cells + 1) * j)] = (j + 0.5) * h * (3 * (j + 0.5) * h - 2);
  }
  CavityEquations equations(viscosity, *this);
  for (int k = 0; k < most_sweeps; ++k) {
    between_steps();
    const double change = equations.substitute();
    if (change < sweep_tolerance) return;
    if (!std::isfinite(change)) break;
  }
  throw std::runtime_error("the finite volumes of the cavity did not come to rest");
}

double CavityFiniteVolumes::velocity(int component, double x, double y) const {
  const double h = 1.0 / cells_;
  // Places along the component's own direction are i h, across it (j + 1/2) h.
  const double along = (component == 0 ? x : y) / h, across = (component == 0 ? y : x) / h - 0.5;
  const auto value = [&](int i, int j) -> double {
    double sign = 1, lid = 0;
    if (i < 0) i = -i, sign = -sign;
    if (i > cells_) i = 2 * cells_ - i, sign = -sign;
    if (j < 0) j = -1 - j, sign = -sign;
    if (j >= cells_) {
      if (component == 0 && i > 0 && i < cells_) lid = 2 * sign;
      j = 2 * cells_ - 1 - j, sign = -sign;
    }
    const std::vector<double>& values = component == 0 ? u_ : v_;
    return lid +
           sign * values[static_cast<std::size_t>(component == 0 ? i + (cells_ + 1) * j : j + cells_ * i)];
  };
  // One-sided where the mirrored flow has a kink: at walls a cubic of inner places and the wall's neighbour.
  const int i0 = std::clamp(static_cast<int>(std::floor(along)) - 1, 0, std::max(0, cells_ - 3));
  const int j0 = std::clamp(static_cast<int>(std::floor(across)) - 1, 0, std::max(0, cells_ - 4));
  const auto a = cubic_weights(along - i0 - 1), b = cubic_weights(across - j0 - 1);
  double sum = 0;
  for (int m = 0; m < 4; ++m)
    for (int k = 0; k < 4; ++k)
      sum += a[static_cast<std::size_t>(k)] * b[static_cast<std::size_t>(m)] * value(i0 + k, j0 + m);
  return sum;
}

std::vector<CavityLine> cavity_centre_lines(const ViscosityOfRate& viscosity, int coarsest) {
  const CavityFiniteVolumes coarse(viscosity, coarsest), middle(viscosity, 2 * coarsest, &coarse),
      fine(viscosity, 4 * coarsest, &middle);
  std::vector<CavityLine> lines;
  for (const int component : {0, 1})
    for (int k = 1; k < 16; ++k) {
      const double x = component == 0 ? 0.5 : k / 16.0, y = component == 0 ? k / 16.0 : 0.5;
      const auto at = [&](const CavityFiniteVolumes& flow) { return flow.velocity(component, x, y); };
      const double first = at(middle) + (at(middle) - at(coarse)) / 3,
                   second = at(fine) + (at(fine) - at(middle)) / 3;
      lines.push_back({{x, y, component, second}, std::abs(second - first)});
    }
  return lines;
}

}  // namespace reference

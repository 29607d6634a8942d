#include "reference/transient/shear_diffusion.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace reference {
namespace {

const double kRoot6 = std::sqrt(6.0);
const std::array<double, 3> kPoints{(4.0 - kRoot6) / 10.0, (4.0 + kRoot6) / 10.0, 1.0};

/// Inverse of Radau IIA's matrix: turns stage increments into h times stage derivatives.
Eigen::Matrix3d derivative_matrix() {
  Eigen::Matrix3d a;
  a << (88 - 7 * kRoot6) / 360, (296 - 169 * kRoot6) / 1800, (-2 + 3 * kRoot6) / 225,  //
      (296 + 169 * kRoot6) / 1800, (88 + 7 * kRoot6) / 360, (-2 - 3 * kRoot6) / 225,   //
      (16 - kRoot6) / 36, (16 + kRoot6) / 36, 1.0 / 9.0;
  return a.inverse();
}

const Eigen::Matrix3d kDerivative = derivative_matrix();

double largest(const std::vector<double>& v) {
  double m = 0.0;
  for (const double x : v) m = std::max(m, std::abs(x));
  return m;
}

}  // namespace

/// The linear system of Newton's iteration: M dW/dt + K T - b = 0 at the stages, linearised, with the
/// interior of every element eliminated on the spot and the 3x3-block tridiagonal rest solved from the
/// far end backwards. Factorised where the iteration stands, and again only when it converges
/// slowly with that.
class ShearDiffusion::Newton {
 public:
  explicit Newton(const ShearDiffusion& owner)
      : owner_(owner),
        p_(owner.line_.degree()),
        elements_(owner.line_.elements()),
        element_(elements_),
        corner_(elements_ + 1),
        local_(3 * (p_ + 1), 3 * (p_ + 1)),
        residual_(3 * (p_ + 1)) {}

  /// `dw`, `dtau`: derivatives of the stage values with respect to q.
  void factorise(double h, const Stages& dw, const Stages& dtau) {
    for (Corner& corner : corner_) {
      corner.diagonal.setZero();
      corner.lower.setZero();
      corner.upper.setZero();
    }
    for (int e = 0; e < elements_; ++e) {
      assemble(e, h, dw, dtau);
      condense(e);
    }
    if (owner_.far_end_ == FarEnd::kGivenRate) {
      corner_[elements_].diagonal.setIdentity();
      corner_[elements_].lower.setZero();
    }
    for (int e = 0; e <= elements_; ++e) {
      Corner& corner = corner_[e];
      if (e > 0) {
        const Corner& before = corner_[e - 1];
        corner.factor =
            before.diagonal.transpose().partialPivLu().solve(corner.lower.transpose()).transpose();
        corner.diagonal -= corner.factor * before.upper;
      }
      corner.lu.compute(corner.diagonal);
    }
  }

  /// Change of q at all nodes and stages: rows nodes, columns stages. `w`, `tau`: current stage values. False
  /// when it is not finite.
  bool solve(double h, const std::vector<double>& start, const Stages& w, const Stages& tau, Stages& change) {
    for (Corner& corner : corner_) corner.right.setZero();
    corner_[0].right.array() -= owner_.stress_slope_;
    if (owner_.far_end_ == FarEnd::kWall) corner_[elements_].right.array() += owner_.stress_slope_;
    const int inner = 3 * (p_ - 1), last = 3 * p_;
    for (int e = 0; e < elements_; ++e) {
      compute_residual(e, h, start, w, tau);
      Element& element = element_[e];
      element.right = element.lu.solve(residual_.segment(3, inner));
      corner_[e].right += residual_.segment(0, 3) - element.to_left * element.right;
      corner_[e + 1].right += residual_.segment(last, 3) - element.to_right * element.right;
    }
    if (owner_.far_end_ == FarEnd::kGivenRate) corner_[elements_].right.setZero();
    return substitute(change);
  }

 private:
  struct Element {
    Eigen::PartialPivLU<Eigen::MatrixXd> lu;              // of the interior
    Eigen::Matrix<double, Eigen::Dynamic, 6> of_corners;  // what a change at the corners does to the interior
    Eigen::Matrix<double, 3, Eigen::Dynamic> to_left, to_right;  // what the interior does to the corners
    Eigen::VectorXd right;
  };
  struct Corner {
    Eigen::Matrix3d diagonal, lower, upper, factor;
    Eigen::PartialPivLU<Eigen::Matrix3d> lu;
    Eigen::Vector3d right;
  };

  void assemble(int e, double h, const Stages& dw, const Stages& dtau) {
    const GaussLobatto& gl = owner_.line_.lobatto();
    const double size = owner_.line_.element_size(e);
    const int n = p_ + 1, first = e * p_;
    local_.setZero();
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b)
          local_(3 * a + i, 3 * b + i) = 2.0 / size * owner_.stiffness_[a * n + b] * dtau[i][first + b];
    for (int a = 0; a < n; ++a) {
      const double mass = 0.5 * size * gl.weights[a] / h;
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          local_(3 * a + i, 3 * a + k) += mass * kDerivative(i, k) * dw[k][first + a];
    }
  }

  void compute_residual(int e, double h, const std::vector<double>& start, const Stages& w,
                        const Stages& tau) {
    const GaussLobatto& gl = owner_.line_.lobatto();
    const double size = owner_.line_.element_size(e);
    const int n = p_ + 1, first = e * p_;
    residual_.setZero();
    for (int i = 0; i < 3; ++i) {
      // The stress enters through differences within the element: its large mean would drown the flux in
      // round-off.
      for (int q = 0; q < n; ++q) {
        double slope = 0.0;
        for (int b = 1; b < n; ++b) slope += gl.derivative[q * n + b] * (tau[i][first + b] - tau[i][first]);
        const double flux = 2.0 / size * gl.weights[q] * slope;
        for (int a = 0; a < n; ++a) residual_(3 * a + i) -= gl.derivative[q * n + a] * flux;
      }
    }
    for (int a = 0; a < n; ++a) {
      const double mass = 0.5 * size * gl.weights[a] / h;
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          residual_(3 * a + i) -= mass * kDerivative(i, k) * (w[k][first + a] - start[first + a]);
    }
  }

  void condense(int e) {
    const int inner = 3 * (p_ - 1), last = 3 * p_;
    Element& element = element_[e];
    element.lu.compute(local_.block(3, 3, inner, inner));
    element.of_corners.resize(inner, 6);
    element.of_corners.leftCols<3>() = local_.block(3, 0, inner, 3);
    element.of_corners.rightCols<3>() = local_.block(3, last, inner, 3);
    element.of_corners = element.lu.solve(element.of_corners).eval();
    element.to_left = local_.block(0, 3, 3, inner);
    element.to_right = local_.block(last, 3, 3, inner);
    const Eigen::Matrix<double, 3, 6> left = element.to_left * element.of_corners;
    const Eigen::Matrix<double, 3, 6> right = element.to_right * element.of_corners;
    corner_[e].diagonal += local_.block(0, 0, 3, 3) - left.leftCols<3>();
    corner_[e].upper = local_.block(0, last, 3, 3) - left.rightCols<3>();
    corner_[e + 1].lower = local_.block(last, 0, 3, 3) - right.leftCols<3>();
    corner_[e + 1].diagonal += local_.block(last, last, 3, 3) - right.rightCols<3>();
  }

  bool substitute(Stages& change) {
    for (int e = 1; e <= elements_; ++e) corner_[e].right -= corner_[e].factor * corner_[e - 1].right;
    Eigen::Vector3d next = corner_[elements_].lu.solve(corner_[elements_].right);
    store(change, elements_ * p_, next);
    bool finite = next.allFinite();
    for (int e = elements_ - 1; e >= 0; --e) {
      const Eigen::Vector3d here = corner_[e].lu.solve(corner_[e].right - corner_[e].upper * next);
      Element& element = element_[e];
      element.right -= element.of_corners.leftCols<3>() * here + element.of_corners.rightCols<3>() * next;
      for (int a = 1; a < p_; ++a) store(change, e * p_ + a, element.right.segment<3>(3 * (a - 1)));
      store(change, e * p_, here);
      finite = finite && here.allFinite() && element.right.allFinite();
      next = here;
    }
    return finite;
  }

  static void store(Stages& change, int node, const Eigen::Vector3d& value) {
    for (int i = 0; i < 3; ++i) change[i][node] = value(i);
  }

  const ShearDiffusion& owner_;
  int p_, elements_;
  std::vector<Element> element_;
  std::vector<Corner> corner_;  // between elements, and at the ends
  Eigen::MatrixXd local_;
  Eigen::VectorXd residual_;
};

ShearDiffusion::ShearDiffusion(const FlowCurve& curve, const SpectralLine& line, double stress_slope,
                               FarEnd far_end, Unknown unknown, double far_rate)
    : curve_(curve),
      line_(line),
      stress_slope_(stress_slope),
      far_end_(far_end),
      unknown_(unknown),
      far_rate_(far_rate) {
  const GaussLobatto& gl = line.lobatto();
  const int n = gl.degree + 1;
  stiffness_.assign(n * n, 0.0);
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b < n; ++b) {
      for (int q = 0; q < n; ++q) {
        stiffness_[a * n + b] += gl.weights[q] * gl.derivative[q * n + a] * gl.derivative[q * n + b];
      }
    }
  }
}

bool ShearDiffusion::step(double h, const std::vector<double>& start, Stages& w) const {
  // A factorisation serves several iterations where it can; where the curve bends too much for that, each has
  // its own.
  Stages stages = w;
  if (!iterate(h, start, stages, Factorisations::kShared) &&
      !iterate(h, start, stages = w, Factorisations::kFresh))
    return false;
  w = std::move(stages);
  return true;
}

bool ShearDiffusion::iterate(double h, const std::vector<double>& start, Stages& w,
                             Factorisations factorisations) const {
  constexpr int kIterations = 60;
  constexpr double kConverged = 1e-13;  // of the largest rate and stress
  constexpr double kStalled = 1e-9;     // below this an update that no longer shrinks is round-off
  constexpr double kFar = 1e-2,
                   kSlow = 0.1;  // an update so large, or that shrinks so little, asks for a new one
  const std::size_t size = start.size();
  Newton newton(*this);
  Stages tau, dw, dtau, change;
  for (int i = 0; i < 3; ++i) {
    if (far_end_ == FarEnd::kGivenRate) w[i].back() = far_rate_;
    tau[i].resize(size), dw[i].resize(size), dtau[i].resize(size), change[i].resize(size);
    for (std::size_t j = 0; j < size; ++j) tau[i][j] = curve_.stress(w[i][j]);
  }

  double previous = std::numeric_limits<double>::infinity();
  bool is_fresh = true;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    if (is_fresh) {
      for (int i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < size; ++j) {
          const double slope = curve_.slope(w[i][j]);
          dw[i][j] = unknown_ == Unknown::kStress ? 1.0 / slope : 1.0;
          dtau[i][j] = unknown_ == Unknown::kStress ? 1.0 : slope;
        }
      }
      newton.factorise(h, dw, dtau);
    }
    if (!newton.solve(h, start, w, tau, change)) return false;
    double update = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double w_scale = largest(w[i]), tau_scale = largest(tau[i]);
      double w_change = 0.0, tau_change = 0.0;
      for (std::size_t j = 0; j < size; ++j) {
        const double w_old = w[i][j], tau_old = tau[i][j];
        if (unknown_ == Unknown::kStress) {
          tau[i][j] += change[i][j];
          if (!(std::abs(tau[i][j]) < 1e60)) return false;  // astray: no rate need exist there
          w[i][j] = curve_.rate(tau[i][j]);
        } else {
          w[i][j] += change[i][j];
          tau[i][j] = curve_.stress(w[i][j]);
        }
        w_change = std::max(w_change, std::abs(w[i][j] - w_old));
        tau_change = std::max(tau_change, std::abs(tau[i][j] - tau_old));
      }
      update = std::max({update, w_change / std::max(w_scale, largest(w[i])),
                         tau_change / std::max(tau_scale, largest(tau[i]))});
    }
    if (!std::isfinite(update)) return false;
    if (update < kConverged || (is_fresh && update < kStalled && update > 0.5 * previous)) return true;
    is_fresh = factorisations == Factorisations::kFresh || update > kFar || update > kSlow * previous;
    previous = update;
  }
  return false;
}

std::vector<double> ShearDiffusion::rate_at_end(double h, const std::vector<double>& start,
                                                const Stages& stages) const {
  std::vector<double> rate(start.size());
  for (std::size_t j = 0; j < start.size(); ++j) {
    for (int k = 0; k < 3; ++k) rate[j] += kDerivative(2, k) / h * (stages[k][j] - start[j]);
  }
  return rate;
}

std::array<double, 4> ShearDiffusion::collocation_weights(double theta) {
  const std::array<double, 4> nodes{0.0, kPoints[0], kPoints[1], kPoints[2]};
  std::array<double, 4> weights{};
  for (int i = 0; i < 4; ++i) {
    weights[i] = 1.0;
    for (int j = 0; j < 4; ++j) {
      if (j != i) weights[i] *= (theta - nodes[j]) / (nodes[i] - nodes[j]);
    }
  }
  return weights;
}

const std::array<double, 3>& ShearDiffusion::points() {
  return kPoints;
}

}  // namespace reference

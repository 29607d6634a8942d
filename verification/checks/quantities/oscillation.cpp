#include "verification/checks/quantities/oscillation.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "verification/convergence/least_squares.hpp"

namespace verification {
namespace {

constexpr std::size_t fewest_points = 8;  // twice the parameters

/// Amplitudes of cosine and sine that fit best for given w and g, and the sum of squares left.
struct Trial {
  Oscillation oscillation;
  Eigen::Vector2d amplitude;
  double left;
};

Trial best_amplitudes(const Signal& signal, const Oscillation& o) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  double square = 0;
  for (std::size_t i = 0; i < signal.t.size(); ++i) {
    const double t = signal.t[i], envelope = std::exp(-o.decay_rate * t);
    const Eigen::Vector2d basis =
        envelope * Eigen::Vector2d(std::cos(o.angular_frequency * t), std::sin(o.angular_frequency * t));
    normal += basis * basis.transpose();
    right += basis * signal.value[i];
    square += signal.value[i] * signal.value[i];
  }
  const Eigen::Vector2d amplitude = normal.ldlt().solve(right);
  return {o, amplitude, square - amplitude.dot(right)};
}

Trial coarse_search(const Signal& signal, const Oscillation& expected) {
  Trial best{{}, {}, std::numeric_limits<double>::infinity()};
  for (int i = 50; i <= 150; ++i) {
    for (const double decay : {0.0, 0.5, 1.0, 1.5, 2.0, 4.0}) {
      const Trial trial =
          best_amplitudes(signal, {0.01 * i * expected.angular_frequency, decay * expected.decay_rate});
      if (trial.left < best.left) best = trial;
    }
  }
  return best;
}

}  // namespace

std::optional<Oscillation> fit_damped_oscillation(const Signal& signal, const Oscillation& expected) {
  if (signal.t.size() < fewest_points) return std::nullopt;
  const Trial start = coarse_search(signal, expected);
  if (!std::isfinite(start.left)) return std::nullopt;
  // x = (A, B, w, g) in units of the amplitude and of the expected frequency.
  const double unit = expected.angular_frequency, size = start.amplitude.norm();
  if (!(size > 0)) return std::nullopt;
  Eigen::Vector4d x(start.amplitude[0] / size, start.amplitude[1] / size,
                    start.oscillation.angular_frequency / unit, start.oscillation.decay_rate / unit);
  const auto rows = static_cast<Eigen::Index>(signal.t.size());
  for (int iteration = 0; iteration < 50; ++iteration) {
    Eigen::MatrixXd jacobian(rows, 4);
    Eigen::VectorXd residual(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double t = signal.t[k] * unit, envelope = std::exp(-x[3] * t);
      const double cosine = envelope * std::cos(x[2] * t), sine = envelope * std::sin(x[2] * t);
      const double model = x[0] * cosine + x[1] * sine;
      jacobian.row(i) << cosine, sine, t * (x[1] * cosine - x[0] * sine), -t * model;
      residual[i] = signal.value[k] / size - model;
    }
    const Eigen::Vector4d step = least_squares(jacobian, residual);
    x += step;
    if (!x.allFinite() || !(x[2] > 0)) return std::nullopt;
    // Far below any tolerance on a period, far above rounding in the sums.
    if (step.tail<2>().cwiseAbs().maxCoeff() < 1e-10) return Oscillation{x[2] * unit, x[3] * unit};
  }
  return std::nullopt;
}

std::optional<std::complex<double>> fit_harmonic(const Signal& signal, double angular_frequency) {
  if (signal.t.size() < fewest_points) return std::nullopt;
  const auto rows = static_cast<Eigen::Index>(signal.t.size());
  Eigen::MatrixXd basis(rows, 3);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double phase = angular_frequency * signal.t[static_cast<std::size_t>(i)];
    basis.row(i) << 1, std::cos(phase), std::sin(phase);
  }
  const Eigen::Vector3d fit =
      least_squares(basis, Eigen::Map<const Eigen::VectorXd>(signal.value.data(), rows));
  if (!fit.allFinite()) return std::nullopt;
  return std::complex<double>(fit[1], -fit[2]);
}

}  // namespace verification

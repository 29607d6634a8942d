#include "reference/transient/finite_volume_channel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "reference/channel/steady_channel.hpp"
#include "reference/require.hpp"

namespace reference {
namespace {

constexpr double kLargeRate = 1e9;  // [1/s], beyond any model's bend: thinning or thickening on the whole

/// One level: w at the faces of a graded mesh, whose sum times the spacings is the plates' velocity
/// difference.
class Level {
 public:
  Level(const ChannelProblem& problem, int cells)
      : problem_(problem),
        stress_unknown_(problem.curve.slope(0.0) > problem.curve.slope(kLargeRate)),
        nodes_(cells + 1),
        w_(cells, 0.0) {
    for (int j = 0; j <= cells; ++j) nodes_[j] = height(double(j) / cells);
    for (int j = 0; j < cells; ++j) {
      faces_.push_back(height((j + 0.5) / cells));
      spacing_.push_back(nodes_[j + 1] - nodes_[j]);
    }
    for (int j = 1; j < cells; ++j) width_.push_back(faces_[j] - faces_[j - 1]);
    if (problem.initial_acceleration != 0.0) {
      const SteadyChannel before(problem.height, problem.initial_acceleration, 0.0, problem.curve);
      for (int j = 0; j < cells; ++j)
        w_[j] = (before.velocity(nodes_[j + 1]) - before.velocity(nodes_[j])) / spacing_[j];
    }
    w_.back() += problem.plate_velocity / spacing_.back();
  }

  /// TR-BDF2 from 0 to t: step k ends at t (k/steps)^5.
  void integrate(double t, int steps) {
    const double gamma = 2.0 - std::sqrt(2.0);
    double begin = 0.0;
    for (int k = 1; k <= steps; ++k) {
      const double end = t * std::pow(double(k) / steps, 5), dt = end - begin;
      const std::vector<double> old = w_, change = rate_of_change(w_);
      std::vector<double> known(old);
      for (std::size_t j = 0; j < old.size(); ++j) known[j] += 0.5 * gamma * dt * change[j];
      // The very first step is implicit Euler: the trapezoidal rule would answer the point source with its
      // own image.
      implicit(k == 1 ? old : known, k == 1 ? gamma * dt : 0.5 * gamma * dt);
      const double a = 1.0 / (gamma * (2.0 - gamma)),
                   b = (1.0 - gamma) * (1.0 - gamma) / (gamma * (2.0 - gamma));
      for (std::size_t j = 0; j < old.size(); ++j) known[j] = a * w_[j] - b * old[j];
      implicit(known, (1.0 - gamma) / (2.0 - gamma) * dt);
      begin = end;
    }
  }

  [[nodiscard]] const std::vector<double>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<double>& faces() const { return faces_; }
  [[nodiscard]] const std::vector<double>& gradient() const { return w_; }
  [[nodiscard]] std::vector<double> velocity() const {
    std::vector<double> u{0.0};
    for (std::size_t j = 0; j < w_.size(); ++j) u.push_back(u.back() + spacing_[j] * w_[j]);
    return u;
  }

 private:
  /// Smooth map of [0, 1] onto the gap, flat (as x^4) at plates and middle.
  [[nodiscard]] double height(double x) const {
    const double z = 2.0 * x - (x < 0.5 ? 0.0 : 1.0);
    const double step = z * z * z * z * (35.0 - z * (84.0 - z * (70.0 - 20.0 * z)));
    return 0.5 * problem_.height * (step + (x < 0.5 ? 0.0 : 1.0));
  }

  /// dw/dt: difference of the nodes' accelerations F + dtau/dy, which vanish at the plates.
  [[nodiscard]] std::vector<double> rate_of_change(const std::vector<double>& w) const {
    std::vector<double> rate(w.size());
    double below = 0.0;
    for (std::size_t j = 0; j < w.size(); ++j) {
      const double above =
          j + 1 < w.size() ? problem_.body_acceleration +
                                 (problem_.curve.stress(w[j + 1]) - problem_.curve.stress(w[j])) / width_[j]
                           : 0.0;
      rate[j] = (above - below) / spacing_[j];
      below = above;
    }
    return rate;
  }

  /// Where the fluid is at rest as a whole and its viscosity there infinite (n < 1), dw/dtau is zero at every
  /// face: the stress is then known up to a constant only, and Newton's matrix singular. An explicit step
  /// shears the faces at the plates, which is enough, as a first guess.
  void leave_rest(double h) {
    const auto still = [](double w) { return w == 0.0; };
    if (!stress_unknown_ || !std::all_of(w_.begin(), w_.end(), still)) return;
    const std::vector<double> rate = rate_of_change(w_);
    for (std::size_t j = 0; j < w_.size(); ++j) w_[j] = h * rate[j];
  }

  /// Solves w = known + h dw/dt for w, starting from the present one: Newton on the stress or on w, Thomas'
  /// algorithm.
  void implicit(const std::vector<double>& known, double h) {
    const std::size_t n = w_.size();
    const FlowCurve& curve = problem_.curve;
    std::vector<double> tau(n), upper(n), right(n);
    leave_rest(h);
    for (std::size_t j = 0; j < n; ++j) tau[j] = curve.stress(w_[j]);
    double previous = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < 200; ++iteration) {
      const std::vector<double> rate = rate_of_change(w_);
      double update = 0.0, scale = 0.0;
      const auto derivative = [&](std::size_t j) {  // of w and tau with respect to the unknown
        const double slope = curve.slope(w_[j]);
        return stress_unknown_ ? std::pair{1.0 / slope, 1.0} : std::pair{1.0, slope};
      };
      for (std::size_t j = 0; j < n; ++j) {
        const double to_lower = j > 0 ? h / (spacing_[j] * width_[j - 1]) : 0.0;
        const double to_upper = j + 1 < n ? h / (spacing_[j] * width_[j]) : 0.0;
        const auto [dw, dtau] = derivative(j);
        const double lower = j > 0 ? -to_lower * derivative(j - 1).second : 0.0;
        const double pivot = dw + (to_lower + to_upper) * dtau - (j > 0 ? lower * upper[j - 1] : 0.0);
        upper[j] = j + 1 < n ? -to_upper * derivative(j + 1).second / pivot : 0.0;
        right[j] = (known[j] + h * rate[j] - w_[j] - (j > 0 ? lower * right[j - 1] : 0.0)) / pivot;
      }
      for (std::size_t j = n; j-- > 0;) {
        if (j + 1 < n) right[j] -= upper[j] * right[j + 1];
        const double old = w_[j];
        if (stress_unknown_) {
          tau[j] += right[j];
          w_[j] = curve.rate(tau[j]);
        } else {
          w_[j] += right[j];
        }
        update +=
            spacing_[j] * std::abs(w_[j] - old);  // as a velocity: the point source's w dwarfs all others
        scale += spacing_[j] * std::abs(w_[j]);
      }
      if (!std::isfinite(update)) break;
      if (update <= 1e-13 * scale || (update <= 1e-9 * scale && update > 0.5 * previous))
        return;  // or round-off
      previous = update;
    }
    throw std::runtime_error("finite volume channel: Newton's method does not converge");
  }

  const ChannelProblem& problem_;
  bool stress_unknown_;
  std::vector<double> nodes_, faces_, spacing_, width_, w_;
};

struct Extrapolated {
  std::vector<double> values;
  double error = 0.0;
};

/// Second-order extrapolation of coincident values on levels three times as fine each; `pick(level, j)` is
/// the j-th.
template <class Pick>
Extrapolated extrapolate(int count, Pick pick) {
  Extrapolated result;
  for (int j = 0; j < count; ++j) {
    const double coarse = (9.0 * pick(1, j) - pick(0, j)) / 8.0, fine = (9.0 * pick(2, j) - pick(1, j)) / 8.0;
    result.values.push_back((81.0 * fine - coarse) / 80.0);
    result.error = std::max(result.error, 0.25 * std::abs(fine - coarse));
  }
  return result;
}

}  // namespace

FiniteVolumeProfile finite_volume_channel(const ChannelProblem& problem, double t, int cells, int steps) {
  problem.check();
  require(t > 0.0 && std::isfinite(t), "finite volume channel: the time must be positive and finite");
  require(cells >= 4 && cells % 2 == 0,
          "finite volume channel: at least four cells, an even number, are needed");
  require(steps >= 2, "finite volume channel: at least two steps are needed");
  std::vector<Level> levels;
  std::vector<std::vector<double>> u;
  for (int refine = 1; refine <= 9; refine *= 3) {
    levels.emplace_back(problem, cells * refine);
    levels.back().integrate(t, steps * refine);
    u.push_back(levels.back().velocity());
  }
  const int factor[] = {1, 3, 9};
  const Extrapolated velocity =
      extrapolate(cells + 1, [&](int level, int j) { return u[level][j * factor[level]]; });
  const Extrapolated gradient = extrapolate(cells, [&](int level, int j) {
    return levels[level].gradient()[j * factor[level] + (factor[level] - 1) / 2];
  });
  return {levels[0].nodes(), velocity.values, levels[0].faces(),
          gradient.values,   velocity.error,  gradient.error};
}

}  // namespace reference

#include "verification/stability/predicted_limit.hpp"

#include <cmath>
#include <numbers>

namespace verification {
namespace {

// A radius above one by less than this is no growth: neutral waves (|g| = 1) may sit in defective blocks,
// whose computed eigenvalues err by the square root of round-off. Viscous limits move by half of it.
constexpr double growth_allowance = 1e-6;

// Fractions of the present limit at which a wave is tested: one that grows only inside a window of time
// steps must not slip through.
constexpr double probes[] = {1, 0.75, 0.5, 0.25};

/// A point of the scan: wavenumber and offset.
using Point = std::array<double, 4>;

class LimitSearch {
 public:
  LimitSearch(const StabilityProblem& problem, double largest) : problem_(problem), limit_(largest) {}

  /// Lowers the limit if the wave grows below it; true when it did.
  bool consider(const Point& at) {
    ParticleLattice lattice = problem_.lattice;
    lattice.offset = {lattice.offset[0] + at[2], lattice.offset[1] + at[3]};
    const BlochSymbols symbols = bloch_symbols(problem_.scheme.basis, lattice, {at[0], at[1]});
    const auto grows_at = [&](double multiple) {
      return grows(amplification_matrix(problem_.scheme, symbols, problem_.waves, problem_.at(multiple)),
                   growth_allowance);
    };
    bool lower = false;
    for (const double probe : probes) {
      double unstable = probe * limit_ * (1 - 1e-9);
      if (!grows_at(unstable)) continue;
      double stable = 0;
      // 40 halvings would reach round-off; a limit that is zero stays above the last.
      for (int i = 0; i < 40 && unstable - stable > 1e-8 * unstable; ++i) {
        const double middle = 0.5 * (stable + unstable);
        (grows_at(middle) ? unstable : stable) = middle;
      }
      limit_ = 0.5 * (stable + unstable);
      worst_ = at;
      found_ = lower = true;
    }
    return lower;
  }

  /// Descends from the worst point, step by step along each coordinate, with steps that shrink from `steps`.
  void refine(Point steps) {
    for (int halving = 0; halving < 12; ++halving) {
      bool moved = true;
      for (int round = 0; moved && round < 20; ++round) {
        moved = false;
        for (std::size_t k = 0; k < steps.size(); ++k)
          for (const double sign : {-1.0, 1.0}) {
            if (steps[k] == 0) continue;
            Point neighbour = worst_;
            neighbour[k] += sign * steps[k];
            moved |= consider(neighbour);
          }
      }
      for (double& step : steps) step *= 0.5;
    }
  }

  [[nodiscard]] bool found() const { return found_; }
  [[nodiscard]] double limit() const { return limit_; }
  [[nodiscard]] const Point& worst() const { return worst_; }

 private:
  const StabilityProblem& problem_;
  double limit_;
  Point worst_{};
  bool found_ = false;
};

}  // namespace

PredictedLimit predict_limit(const StabilityProblem& problem, Motion motion, double largest) {
  using std::numbers::pi;
  // Conjugation and the lattice's own reflections leave half of the wavenumbers and half a period of offsets.
  const bool plane = problem.waves == Waves::Plane;
  const int waves_x = plane ? 16 : 1, waves_y = plane ? 8 : 32;
  const bool moves_x = plane && (motion == Motion::AlongX || motion == Motion::Any);
  const bool moves_y = motion == Motion::AlongY || motion == Motion::Any;
  const int seats = plane ? 4 : 16;
  const std::array<double, 2> period = problem.lattice.period();
  const Point steps = {plane ? 2 * pi / waves_x : 0, pi / waves_y, moves_x ? 0.5 * period[0] / seats : 0,
                       moves_y ? 0.5 * period[1] / seats : 0};

  LimitSearch search(problem, largest);
  for (int a = 0; a <= (moves_x ? seats : 0); ++a)
    for (int b = 0; b <= (moves_y ? seats : 0); ++b)
      for (int i = 0; i < waves_x; ++i)
        for (int j = 0; j <= waves_y; ++j)
          search.consider({plane ? (i + 1) * steps[0] - pi : 0, j * steps[1], a * steps[2], b * steps[3]});
  if (!search.found()) return {};
  search.refine(steps);
  const Point& worst = search.worst();
  return {search.limit(), {worst[0], worst[1]}, {worst[2], worst[3]}};
}

double wave_limit(const StabilityProblem& problem, const std::array<double, 2>& theta,
                  const std::array<double, 2>& offset, double largest) {
  LimitSearch search(problem, largest);
  search.consider({theta[0], theta[1], offset[0], offset[1]});
  return search.limit();
}

}  // namespace verification

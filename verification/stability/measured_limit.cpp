#include "verification/stability/measured_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "solver/simulation.hpp"

namespace verification {
namespace {

using mpm::Vec2;

// Relative to cell and step: far above round-off, far below what makes P(rho) curved or moves particles.
constexpr double amplitude = 1e-10;
constexpr double growth = 1e4;  // of energy: a factor 100 of the amplitude
// Energies below this part of the first are round-off.
constexpr double limit_round_off = 1e-10;
constexpr double resolution = 2e-3;  // of the bisection
// Around the limit that is expected: no wave grows below it but for the resolution, and a box and a stream
// have little but not exactly the worst wave and seat (1.024 times the prediction at most in
// stability-matrix-plane).
constexpr double below_expected = 1 - resolution, above_expected = 1.03;

/// Random values between -1 and 1 on a fine periodic lattice, interpolated bilinearly: a function with a
/// gradient, which particles with affine fields ask for, and with every wave in it.
class Noise {
 public:
  Noise(const std::array<int, 2>& cells, unsigned seed) : points_{4 * cells[0], 4 * cells[1]} {
    std::mt19937 generator(seed);
    for (int i = 0; i < points_[0] * points_[1]; ++i)
      values_.push_back(static_cast<double>(generator()) * 0x1p-31 - 1);
  }

  /// At a point in cells.
  [[nodiscard]] double operator()(const Vec2& x) const {
    const double sx = 4 * x.x(), sy = 4 * x.y();
    const double i = std::floor(sx), j = std::floor(sy), a = sx - i, b = sy - j;
    return (1 - b) * ((1 - a) * value(i, j) + a * value(i + 1, j)) +
           b * ((1 - a) * value(i, j + 1) + a * value(i + 1, j + 1));
  }

 private:
  [[nodiscard]] double value(double i, double j) const {
    const auto wrap = [](double k, int n) { return ((static_cast<int>(k) % n) + n) % n; };
    return values_[static_cast<std::size_t>(wrap(j, points_[1]) * points_[0] + wrap(i, points_[0]))];
  }

  std::array<int, 2> points_;
  std::vector<double> values_;
};

/// The box, in units that make cell and density one; nu and c are those of the ray.
mpm::Scene periodic_box(const MeasuringPlan& plan, double dt) {
  const StabilityProblem& problem = plan.problem;
  mpm::Scene scene;
  scene.size = Vec2(plan.cells[0], plan.cells[1]);
  scene.cells = plan.cells;
  scene.particles_per_cell = problem.lattice.per_cell;
  if (problem.lattice.gauss) scene.seeding.rule = {mpm::Seeding::Rule::Gauss, mpm::Seeding::Rule::Gauss};
  scene.seeding.shift = plan.offset;
  scene.fluid.density = 1;
  scene.fluid.pressure = problem.ray.cfl > 0;
  scene.fluid.bulk_modulus = problem.ray.cfl * problem.ray.cfl / 7;  // c^2 = 7 K/rho
  scene.fluid.rheology = mpm::Newtonian{problem.ray.r};

  const Vec2 stream = Vec2(plan.travel[0], plan.travel[1]) / (plan.steps * dt);
  const Vec2 mask(problem.waves != Waves::Longitudinal, problem.waves != Waves::Shear);
  scene.initial_velocity = [stream, mask, dt, u = Noise(plan.cells, 1),
                            v = Noise(plan.cells, 2)](const Vec2& x) -> Vec2 {
    return stream + amplitude / dt * mask.cwiseProduct(Vec2(u(x), v(x)));
  };
  if (scene.fluid.pressure)
    scene.initial_density = [noise = Noise(plan.cells, 3)](const Vec2& x) {
      return 1 + amplitude * noise(x);
    };
  return scene;
}

/// Energy of what is not uniform.
double perturbation_energy(const mpm::Particles& particles, double sound_speed) {
  Vec2 mean = Vec2::Zero();
  double mass = 0, mean_density = 0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    mass += particles.mass[p];
    mean += particles.mass[p] * particles.velocity[p];
    mean_density += particles.mass[p] * particles.density[p];
  }
  mean /= mass;
  mean_density /= mass;
  double kinetic = 0, elastic = 0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    kinetic += particles.mass[p] * (particles.velocity[p] - mean).squaredNorm();
    elastic += particles.mass[p] * std::pow(particles.density[p] - mean_density, 2);
  }
  return 0.5 * (kinetic + sound_speed * sound_speed * elastic);
}

}  // namespace

bool perturbation_grows(const MeasuringPlan& plan, double multiple) {
  const double dt = multiple;
  const mpm::Scene scene = periodic_box(plan, dt);
  const auto simulation = mpm::make_simulation(scene, plan.problem.scheme);
  const double c = plan.problem.ray.cfl;
  const double first = perturbation_energy(simulation->particles(), c);
  double least = first;
  for (int step = 0; step < plan.steps; ++step) {
    simulation->advance(step * dt, dt);
    if (simulation->breakdown()) return true;
    const double energy = perturbation_energy(simulation->particles(), c);
    if (!(energy <= growth * std::max(least, limit_round_off * first))) return true;
    least = std::min(least, energy);
  }
  return false;
}

double measured_growth(const MeasuringPlan& plan, double multiple) {
  // Amplitudes 1e4 and 3e6 times the first: the fastest waves rule, and all are still small.
  constexpr double begin_energy = 1e8, end_energy = 1e13;
  const mpm::Scene scene = periodic_box(plan, multiple);
  const auto simulation = mpm::make_simulation(scene, plan.problem.scheme);
  const double first = perturbation_energy(simulation->particles(), plan.problem.ray.cfl);
  double begun_at = 0;
  int begun = -1;
  for (int step = 0; step < plan.steps && !simulation->breakdown(); ++step) {
    simulation->advance(step * multiple, multiple);
    const double energy = perturbation_energy(simulation->particles(), plan.problem.ray.cfl) / first;
    if (begun < 0 && energy > begin_energy) {
      begun = step;
      begun_at = energy;
    }
    if (energy > end_energy) return std::pow(energy / begun_at, 0.5 / std::max(1, step - begun));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::optional<double> measure_limit(const MeasuringPlan& plan, double largest,
                                    std::optional<double> expected) {
  if (!perturbation_grows(plan, largest)) return std::nullopt;
  double unstable = largest, stable = 0;
  // A right guess leaves a short way to go; a wrong one is found out, and costs two runs. Zero is none:
  // without a step nothing is measured.
  if (expected && *expected > 0 && above_expected * *expected < largest &&
      perturbation_grows(plan, above_expected * *expected)) {
    unstable = above_expected * *expected;
    if (!perturbation_grows(plan, below_expected * *expected)) stable = below_expected * *expected;
  }
  if (stable == 0) {  // down from above, since runs that grow end soon
    stable = 0.5 * unstable;
    while (perturbation_grows(plan, stable)) {
      unstable = stable;
      stable *= 0.5;
      if (stable < 1e-6 * largest) return 0;
    }
  }
  while (unstable - stable > resolution * stable) {
    const double middle = 0.5 * (stable + unstable);
    (perturbation_grows(plan, middle) ? unstable : stable) = middle;
  }
  return 0.5 * (stable + unstable);
}

int steps_to_tell(const StabilityProblem& problem, const PredictedLimit& predicted) {
  constexpr int fewest = 400, most = 8000;
  if (!predicted.multiple) return fewest;
  ParticleLattice lattice = problem.lattice;
  lattice.offset = predicted.offset;
  const BlochSymbols symbols = bloch_symbols(problem.scheme.basis, lattice, predicted.theta);
  const double factor = spectral_radius(
      amplification_matrix(problem.scheme, symbols, problem.waves, problem.at(1.01 * *predicted.multiple)));
  return static_cast<int>(std::clamp(12 / std::max(std::log(factor), 1e-9), 1.0 * fewest, 1.0 * most));
}

std::array<int, 2> box_for(const std::array<double, 2>& theta, Waves waves) {
  const bool plane = waves == Waves::Plane;
  const auto nearest = [](double angle, int fewest, int most) {
    int best = fewest;
    double least = 10;
    for (int n = fewest; n <= most; ++n) {
      const double turns = angle * n / (2 * std::numbers::pi);
      const double error = std::abs(turns - std::round(turns)) / n;
      if (error < least - 1e-9) {
        least = error;
        best = n;
      }
    }
    return best;
  };
  // Six cells at least, so that no support wraps onto itself.
  return {plane ? nearest(theta[0], 6, 10) : 1, plane ? nearest(theta[1], 6, 10) : nearest(theta[1], 12, 20)};
}

}  // namespace verification

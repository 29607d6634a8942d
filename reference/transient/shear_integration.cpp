#include "reference/transient/shear_integration.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "reference/interruption.hpp"

namespace reference {
namespace {

using Stages = ShearDiffusion::Stages;

constexpr double kLongestStep = 0.1;  // of the time since the start
constexpr long kMostSteps = 100000;   // a hundred times what the slowest known problem takes

/// Extrapolates the collocation polynomial of a step of length `h` to the stages of the next one, of length
/// `next`.
Stages extrapolate(const std::vector<double>& start, const Stages& stages, double h, double next) {
  Stages guess;
  for (int i = 0; i < 3; ++i) {
    const auto weights = ShearDiffusion::collocation_weights(1.0 + ShearDiffusion::points()[i] * next / h);
    guess[i].resize(start.size());
    for (std::size_t j = 0; j < start.size(); ++j) {
      guess[i][j] = weights[0] * start[j] + weights[1] * stages[0][j] + weights[2] * stages[1][j] +
                    weights[3] * stages[2][j];
    }
  }
  return guess;
}

/// Size of the difference between two gradients, as integrate_shear describes.
double distance(const SpectralLine& line, const std::vector<double>& a, const std::vector<double>& b,
                double t, const ShearIntegration& settings) {
  double u = 0.0, mean = 0.0, largest_u = 0.0, largest_w = 0.0, scale_w = settings.least_rate;
  for (std::size_t j = 0; j < a.size(); ++j) {
    const double m = line.mass()[j];
    u += m * (a[j] - b[j]);
    mean += m * std::abs(u);
    largest_u = std::max(largest_u, std::abs(u));
    largest_w = std::max(largest_w, std::abs(a[j] - b[j]));
    scale_w = std::max(scale_w, std::abs(a[j]));
  }
  const double pointwise = largest_u / settings.velocity_scale + 0.1 * largest_w / scale_w;
  return mean / (line.length() * settings.velocity_scale) +
         std::min(1.0, t / settings.accurate_from) * pointwise;
}

}  // namespace

GradientHistory integrate_shear(const ShearDiffusion& diffusion, const SpectralLine& line,
                                std::vector<double> w, const ShearIntegration& settings) {
  GradientHistory history(line);
  Stages stages, previous_stages;
  std::vector<double> previous_start;
  double t = settings.start_time, h = settings.first_step, previous_h = 0.0;
  long tried = 0;
  // One step beyond the end, so that times before it lie between two steps on either side.
  for (bool beyond = false; !beyond;) {
    between_steps();
    if (++tried > kMostSteps)
      throw std::runtime_error("transient channel: no end after " + std::to_string(kMostSteps) +
                               " time steps");
    const bool extrapolated = previous_h > 0.0;
    if (extrapolated) {
      stages = extrapolate(previous_start, previous_stages, previous_h, h);
    } else {
      stages = {w, w, w};
    }
    const std::vector<double> predicted = stages[2];
    bool accepted = diffusion.step(h, w, stages);
    if (!accepted && extrapolated) {
      stages = {w, w, w};
      accepted = diffusion.step(h, w, stages);
    }
    double growth = 2.0;
    if (!accepted) {
      growth = 0.25;
    } else if (extrapolated) {
      const double indicator = distance(line, stages[2], predicted, t + h, settings);
      growth = std::clamp(0.9 * std::pow(settings.tolerance / indicator, 0.25), 0.2, 2.0);
      accepted = indicator < 4.0 * settings.tolerance;
    }
    if (accepted) {
      beyond = t >= settings.end_time;
      t += h;
      history.append({t, stages[2], diffusion.rate_at_end(h, w, stages)});
      previous_start = std::move(w);
      w = stages[2];
      previous_stages = stages;
      previous_h = h;
    }
    h *= growth;
    // Near the steady state nothing is left to misjudge, but the interpolation between the steps must still
    // follow.
    if (t > settings.accurate_from) h = std::min(h, kLongestStep * t);
    if (t + h <= t) throw std::runtime_error("transient channel: the implicit time step does not converge");
  }
  return history;
}

}  // namespace reference

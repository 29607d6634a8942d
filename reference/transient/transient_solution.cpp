#include "reference/transient/transient_solution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/require.hpp"
#include "reference/transient/shear_integration.hpp"

namespace reference {
namespace {

constexpr double kThinnestLayer = 1e-10;  // of the height: a point source for every practical purpose
constexpr double kLeastExponent = 0.1;    // below, the layer's tail spans the gap from the first moment on

}  // namespace

namespace {

/// Whether the flow curve's local exponent d ln(tau)/d ln(w) varies by more than half over the shear rates of
/// a start-up, from the core's to the first layer's: such a profile is nearly kinked, and its spectrum long.
bool nearly_kinked(const ChannelProblem& problem) {
  const double rate = problem.pull != 0.0 ? std::abs(problem.curve.rate(problem.pull))
                                          : SteadyChannel(problem.height, problem.body_acceleration,
                                                          problem.plate_velocity, problem.curve)
                                                    .maximum() /
                                                problem.height;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (double share = 1e-3; share < 1e7; share *= 10.0) {
    const double n = problem.curve.local_exponent(share * rate);
    least = std::min(least, n);
    most = std::max(most, n);
  }
  return most - least > 0.5;
}

bool is_combined(const ChannelProblem& problem) {
  return problem.plate_velocity != 0.0 && problem.body_acceleration != 0.0;
}

}  // namespace

/// A regularised yield stress bends the profile within a shear rate of 1/m; where, moves. Neither order nor
/// small steps pay there: with these, stated errors of 1e-7 to 1e-4 (m w from 100 to 2000) are still well
/// below what a mesh that a solver can afford leaves.
TransientResolution yielding_resolution(bool fine) {
  return fine ? TransientResolution{8, 1e-5, 1e-5, 1e-11} : TransientResolution{6, 1e-4, 1e-4, 1e-10};
}

// Time steps dominate the error, measured over the fluids of the suite: degree 12 and 10 instead leave every
// stated error as it is, but where the curve is nearly kinked.
TransientResolution coarse_resolution(const ChannelProblem& problem) {
  if (problem.curve.yielding()) return yielding_resolution(false);
  if (is_combined(problem)) return {4, 1e-4, 1e-5, 1e-10};
  return {nearly_kinked(problem) ? 10 : 7, 3e-7, 1e-6, 1e-11};
}

TransientResolution fine_resolution(const ChannelProblem& problem) {
  if (problem.curve.yielding()) return yielding_resolution(true);
  if (is_combined(problem)) return {6, 5e-5, 1e-6, 1e-12};
  return {nearly_kinked(problem) ? 12 : 8, 1e-7, 1e-8, 1e-12};
}

TransientSolution::TransientSolution(const ChannelProblem& problem, const TransientResolution& resolution)
    : problem_(problem),
      resolution_(resolution),
      before_(problem.height, problem.initial_acceleration, 0.0, problem.curve) {
  const SteadyChannel steady(problem_.height, problem_.body_acceleration, problem_.plate_velocity,
                             problem_.curve);
  velocity_scale_ = std::max(steady.maximum(), before_.maximum());
  thinning_ = std::isinf(problem_.curve.slope(0.0));
  if (pulled()) {
    far_rate_ = problem_.curve.rate(problem_.pull);
    velocity_scale_ = std::abs(far_rate_) * problem_.height;
    return;
  }
  const auto* power_law = std::get_if<PowerLawCurve>(&problem_.curve.model());
  if (whole_gap()) {
    if (power_law && power_law->n > 1.0 && problem_.body_acceleration == 0.0) {
      layer_.emplace(power_law->nu_0, power_law->n, problem_.plate_velocity);
      start_time_ = layer_->arrival(problem_.height);
      fronts_arrived_ = true;
    } else {
      choose_layer();
    }
  } else if (problem_.initial_acceleration != 0.0) {
    // steady at t = 0
  } else if (power_law && power_law->n >= PowerLawStartUp::kLeastExponent) {
    start_up_.emplace(power_law->nu_0, power_law->n, problem_.body_acceleration);
    start_time_ = start_up_->arrival(0.5 * problem_.height);
    fronts_arrived_ = true;
  }
}

void TransientSolution::choose_layer() {
  const double height = problem_.height, plate = std::abs(problem_.plate_velocity);
  const bool power_law = std::holds_alternative<PowerLawCurve>(problem_.curve.model());
  for (double thickness = 0.02 * height;; thickness *= 0.3) {
    const double rate = plate / thickness;
    problem_.curve.require_monotone(rate);
    double n = problem_.curve.local_exponent(rate);
    const double bend = power_law ? 0.0
                                  : std::abs(problem_.curve.local_exponent(4.0 * rate) -
                                             problem_.curve.local_exponent(0.25 * rate));
    require(n >= kLeastExponent,
            "transient channel: the flow curve flattens too much for an impulsively started plate");
    if (std::abs(n - 1.0) < 1e-6) n = 1.0;  // the layer's thinness makes up for the rest
    layer_.emplace(problem_.curve.stress(rate) / std::pow(rate, n), n, problem_.plate_velocity);
    start_time_ = layer_->time_of_thickness(thickness);
    const double share = thickness / height;
    // What the curve's bend, the other plate and the body force - which moves the whole core - would have
    // changed by now.
    const double neglected = std::max({bend * share, std::abs(layer_->velocity(height, start_time_)) / plate,
                                       std::abs(problem_.body_acceleration) * start_time_ / plate});
    const bool early = problem_.accurate_from() == 0.0 || start_time_ < 0.01 * problem_.accurate_from();
    if ((neglected < resolution_.neglected && early) || share < kThinnestLayer) return;
  }
}

SpectralLine TransientSolution::mesh() const {
  const double length = whole_gap() || pulled() ? problem_.height : 0.5 * problem_.height;
  // A combined flow's zero-shear point, a kink of the flow curve, wanders through the mesh, and a strongly
  // thickening fluid ends its layer in a bend that does: nothing but size helps there.
  const bool bends =
      problem_.curve.slope(velocity_scale_ / problem_.height) > 4.0 * problem_.curve.slope(0.0);
  const double largest = length / (combined() ? 100.0 : bends ? 48.0 : 28.0);
  // At the start, the layer or - where it has filled the gap - a few elements; at the far end the centre's
  // |z|^(1/n), or what a landed front leaves, or the lower wall's own layer.
  const double near_end = whole_gap()
                              ? (fronts_arrived_ ? 0.1 * length : 0.3 * layer_->thickness(start_time_))
                              : (fronts_arrived_ || pulled() ? 1e-2 * length : 1e-5 * length);
  const double far_end =
      whole_gap() && !fronts_arrived_ && !combined() ? 0.1 * length : resolution_.smallest * length;
  std::vector<double> sizes = graded_sizes(0.5 * length, near_end, largest, 2.0);
  const std::vector<double> far = graded_sizes(0.5 * length, far_end, largest, 2.0);
  sizes.insert(sizes.end(), far.rbegin(), far.rend());
  return {sizes, resolution_.degree};
}

std::vector<double> TransientSolution::start(const SpectralLine& line) const {
  std::vector<double> w;
  for (const double s : line.nodes()) {
    w.push_back(layer_      ? layer_->rate(s, start_time_)
                : start_up_ ? start_up_->gradient(s, start_time_)
                : pulled()  ? 0.0
                            : before_.gradient(s));
  }
  if (layer_) {
    // The velocity difference between the plates is conserved from here on: made exact here.
    double difference = 0.0;
    for (std::size_t j = 0; j < w.size(); ++j) difference += line.mass()[j] * w[j];
    for (double& value : w) value *= problem_.plate_velocity / difference;
  }
  return w;
}

void TransientSolution::solve() {
  if (problem_.last_time() <= start_time_) return;
  const SpectralLine line = mesh();
  const double stress_slope = whole_gap() ? problem_.body_acceleration : -problem_.body_acceleration;
  const ShearDiffusion diffusion(
      problem_.curve, line, stress_slope,
      whole_gap() ? ShearDiffusion::FarEnd::kWall : ShearDiffusion::FarEnd::kGivenRate,
      thinning_ ? ShearDiffusion::Unknown::kStress : ShearDiffusion::Unknown::kRate, far_rate_);
  ShearIntegration settings;
  settings.start_time = start_time_;
  settings.end_time = problem_.last_time();
  settings.first_step = fronts_arrived_ ? 1e-6 * start_time_
                        : start_time_ > 0.0
                            ? 0.05 * start_time_
                            : 1e-4 * std::sqrt(resolution_.tolerance) * problem_.accurate_from();
  settings.accurate_from = problem_.accurate_from();
  settings.velocity_scale = velocity_scale_;
  settings.tolerance = resolution_.tolerance;
  if (problem_.initial_acceleration != 0.0) settings.least_rate = 1e-6 * velocity_scale_ / problem_.height;
  history_ = integrate_shear(diffusion, line, start(line), settings);
}

bool TransientSolution::adopt(const std::vector<GradientHistory::Snapshot>& snapshots) {
  history_.reset();
  const double last = problem_.last_time();
  if (last <= start_time_) return true;
  GradientHistory history(mesh());
  const std::size_t nodes = history.line().size();
  bool beyond = false;  // integrate_shear goes one step beyond; what lies further was for a later time
  for (auto snapshot = snapshots.begin(); snapshot != snapshots.end() && !beyond; ++snapshot) {
    const double before = history.empty() ? start_time_ : history.last_time();
    if (!(snapshot->time > before) || snapshot->w.size() != nodes || snapshot->rate.size() != nodes)
      return false;
    beyond = before >= last;
    history.append(*snapshot);
  }
  if (beyond) history_ = std::move(history);
  return beyond;
}

std::vector<GradientHistory::Snapshot> TransientSolution::snapshots() const {
  return history_ ? history_->snapshots() : std::vector<GradientHistory::Snapshot>{};
}

double TransientSolution::velocity(double y, double t) const {
  require(y >= 0.0 && y <= problem_.height, "channel: y must lie between the plates");
  require(t >= 0.0 && t <= problem_.last_time(),
          "transient channel: the time is beyond the last one asked for");
  if (y == 0.0) return 0.0;
  if (y == problem_.height && !pulled()) return problem_.plate_velocity;
  if (t == 0.0) return before_.velocity(y);
  const double above = problem_.height - y;
  if (whole_gap()) {
    if (t <= start_time_) return layer_->velocity(above, t);
    if (t < history_->first_time()) {
      const double share = (t - start_time_) / (history_->first_time() - start_time_);
      return (1.0 - share) * layer_->velocity(above, start_time_) +
             share * (problem_.plate_velocity - history_->integral(above, history_->first_time()));
    }
    return problem_.plate_velocity - history_->integral(above, t);
  }
  const double s = pulled() ? y : std::min(y, above);
  if (t <= start_time_) return start_up_->velocity(s, t);
  if (t < history_->first_time()) {
    const double share = (t - start_time_) / (history_->first_time() - start_time_);
    return (1.0 - share) * (start_up_ ? start_up_->velocity(s, start_time_) : before_.velocity(s)) +
           share * history_->integral(s, history_->first_time());
  }
  return history_->integral(s, t);
}

double TransientSolution::gradient(double y, double t) const {
  require(y >= 0.0 && y <= problem_.height, "channel: y must lie between the plates");
  require(t >= 0.0 && t <= problem_.last_time(),
          "transient channel: the time is beyond the last one asked for");
  const double s = whole_gap() ? problem_.height - y : pulled() ? y : std::min(y, problem_.height - y);
  const double sign = whole_gap() || pulled() || y <= 0.5 * problem_.height ? 1.0 : -1.0;
  if (t == 0.0)
    return whole_gap() && s == 0.0
               ? std::copysign(std::numeric_limits<double>::infinity(), problem_.plate_velocity)
               : before_.gradient(y);
  // There |z|^(1/n) would turn the last bit of y into a visible shear rate.
  constexpr double kMiddle = 4.0 * std::numeric_limits<double>::epsilon();
  if (!whole_gap() && !pulled() && std::abs(0.5 * problem_.height - y) <= kMiddle * problem_.height)
    return 0.0;
  if (t <= start_time_) return sign * (layer_ ? layer_->rate(s, t) : start_up_->gradient(s, t));
  const double at = std::max(t, history_->first_time());
  const SpectralLine& line = history_->line();
  const auto [e, xi] = line.locate(s);
  std::vector<double> values = history_->element(e, at);
  // Near the centre the stress is smooth and the gradient is not; where a front has landed it is the other
  // way round.
  if ((whole_gap() || pulled()) && !thinning_) return sign * line.interpolate(values.data(), xi);
  for (double& value : values) value = problem_.curve.stress(value);
  return sign * problem_.curve.rate(line.interpolate(values.data(), xi));
}

}  // namespace reference

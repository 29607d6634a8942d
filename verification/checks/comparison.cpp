#include "verification/checks/comparison.hpp"

#include <algorithm>
#include <cmath>

#include "verification/not_a_number.hpp"
#include "verification/runs/measures.hpp"

namespace verification {
namespace {

/// A sample in the flow's own frame.
struct Sample {
  double place;               // across [m]
  double streamwise, across;  // [m/s]
};

std::vector<Sample> samples_across(const RunData& run, double t, Location location) {
  const Flow& flow = *run.plan->scene.flow;
  const Vec2 direction = flow.probe().direction;
  std::vector<Sample> samples;
  for (const reports::ProfileRow* row : rows_at(run, t, location)) {
    const Vec2 x(row->x, row->y), v(row->u, row->v);
    samples.push_back({x[flow.across()], v.dot(direction), v[flow.across()]});
  }
  return samples;
}

/// std::max that keeps a NaN.
double worst(double a, double b) {
  return std::isnan(a) || std::isnan(b) ? nan : std::max(a, b);
}

}  // namespace

double particle_bias(const RunData& run, double t) {
  const Flow& flow = *run.plan->scene.flow;
  const Vec2 direction = flow.probe().direction;
  double sum = 0;
  long count = 0;
  for (const reports::ProfileRow* row : rows_at(run, t, Location::Particles)) {
    const double place = flow.across() == 0 ? row->x : row->y;
    if (std::abs(place / flow.length() - 0.5) > 0.25) continue;
    sum += Vec2(row->u - row->u_exact, row->v - row->v_exact).dot(direction);
    ++count;
  }
  return count == 0 ? nan : sum / static_cast<double>(count) / flow.bias_unit(run.plan->scene.cell_size());
}

double largest_difference(const RunData& run, const RunData& other, double t, Location location) {
  const Flow& flow = *run.plan->scene.flow;
  const double tolerance =
      1e-9 * flow.length();  // places are computed alike up to rounding; rows lie far wider apart
  const std::vector<Sample> samples = samples_across(run, t, location);
  std::vector<Sample> counterparts = samples_across(other, t, location);
  if (samples.empty() || counterparts.empty()) return nan;
  std::ranges::sort(counterparts, {}, &Sample::place);
  double largest = 0;
  for (const Sample& sample : samples) {
    auto match = std::ranges::lower_bound(counterparts, sample.place - tolerance, {}, &Sample::place);
    if (match == counterparts.end() || match->place > sample.place + tolerance) return nan;
    for (; match != counterparts.end() && match->place <= sample.place + tolerance; ++match) {
      largest = worst(largest, std::abs(sample.streamwise - match->streamwise));
      largest = worst(largest, std::abs(sample.across - match->across));
    }
  }
  return largest / flow.velocity_scale_at(t);
}

double mass_drift(const RunData& run) {
  if (run.history.empty()) return nan;
  double largest = 0;
  for (const reports::HistoryRow& row : run.history)
    largest = worst(largest, std::abs(row.mass / run.history.front().mass - 1));
  return run.completed() ? largest : nan;
}

double momentum_drift(const RunData& run) {
  if (run.history.empty()) return nan;
  const reports::HistoryRow& start = run.history.front();
  double largest = 0, present = start.mass * run.plan->scene.flow->velocity_scale();
  for (const reports::HistoryRow& row : run.history) {
    present = std::max(present, std::hypot(row.momentum_x, row.momentum_y));
    const Vec2 defect(row.momentum_x - start.momentum_x - row.impulse_x,
                      row.momentum_y - start.momentum_y - row.impulse_y);
    largest = worst(largest, defect.norm());
  }
  return run.completed() ? largest / present : nan;
}

}  // namespace verification

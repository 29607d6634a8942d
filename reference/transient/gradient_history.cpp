#include "reference/transient/gradient_history.hpp"

#include <algorithm>

#include "reference/require.hpp"

namespace reference {

void GradientHistory::append(const Snapshot& snapshot) {
  const std::size_t size = line_.size();
  require(snapshot.w.size() == size && snapshot.rate.size() == size,
          "gradient history: wrong number of nodes");
  require(snapshots_.empty() || snapshot.time > last_time(), "gradient history: times must increase");
  const std::vector<double>& weights = line_.lobatto().weights;
  std::vector<double> edge{0.0}, edge_rate{0.0};
  for (int e = 0; e < line_.elements(); ++e) {
    double sum = 0.0, sum_rate = 0.0;
    for (int a = 0; a <= line_.degree(); ++a) {
      sum += weights[a] * snapshot.w[e * line_.degree() + a];
      sum_rate += weights[a] * snapshot.rate[e * line_.degree() + a];
    }
    edge.push_back(edge.back() + 0.5 * line_.element_size(e) * sum);
    edge_rate.push_back(edge_rate.back() + 0.5 * line_.element_size(e) * sum_rate);
  }
  snapshots_.push_back(snapshot);
  edge_.push_back(std::move(edge));
  edge_rate_.push_back(std::move(edge_rate));
}

GradientHistory::Blend GradientHistory::blend(double t) const {
  require(!empty(), "gradient history: no snapshots");
  require(t >= first_time() && t <= last_time(), "gradient history: the time is outside what was computed");
  const auto above = std::upper_bound(snapshots_.begin(), snapshots_.end(), t,
                                      [](double time, const Snapshot& s) { return time < s.time; });
  const std::size_t count = std::min<std::size_t>(4, snapshots_.size());
  const std::size_t after = above - snapshots_.begin();
  const std::size_t first = std::min(after < 2 ? 0 : after - 2, snapshots_.size() - count);
  Blend b{first, {}, {}};
  for (std::size_t i = 0; i < count; ++i) {
    const double t_i = snapshots_[first + i].time;
    double cardinal = 1.0, slope = 0.0;  // Lagrange's polynomial at t, and its derivative at t_i
    for (std::size_t j = 0; j < count; ++j) {
      if (j == i) continue;
      const double t_j = snapshots_[first + j].time;
      cardinal *= (t - t_j) / (t_i - t_j);
      slope += 1.0 / (t_i - t_j);
    }
    b.value.push_back((1.0 - 2.0 * (t - t_i) * slope) * cardinal * cardinal);
    b.rate.push_back((t - t_i) * cardinal * cardinal);
  }
  return b;
}

std::vector<double> GradientHistory::element(int e, double t) const {
  const Blend b = blend(t);
  std::vector<double> w(line_.degree() + 1, 0.0);
  for (std::size_t i = 0; i < b.value.size(); ++i) {
    const Snapshot& snapshot = snapshots_[b.first + i];
    for (int a = 0; a <= line_.degree(); ++a) {
      const std::size_t node = e * line_.degree() + a;
      w[a] += b.value[i] * snapshot.w[node] + b.rate[i] * snapshot.rate[node];
    }
  }
  return w;
}

double GradientHistory::integral(double s, double t) const {
  const auto [e, xi] = line_.locate(s);
  const Blend b = blend(t);
  double sum = line_.integrate(element(e, t).data(), xi, line_.element_size(e));
  for (std::size_t i = 0; i < b.value.size(); ++i) {
    sum += b.value[i] * edge_[b.first + i][e] + b.rate[i] * edge_rate_[b.first + i][e];
  }
  return sum;
}

}  // namespace reference

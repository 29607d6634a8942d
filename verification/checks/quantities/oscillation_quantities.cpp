#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "verification/checks/quantities/oscillation.hpp"
#include "verification/checks/quantities/quantity_entries.hpp"
#include "verification/not_a_number.hpp"

namespace verification {
namespace {

std::optional<Oscillation> free_oscillation(const RunData& run) {
  const auto expected = run.plan->scene.flow->oscillation();
  if (!expected || expected->decay_rate == 0 || !run.completed()) return std::nullopt;
  Signal signal;
  for (const reports::HistoryRow& row : run.history) {
    signal.t.push_back(row.t);
    signal.value.push_back(row.probe);
  }
  return fit_damped_oscillation(signal, *expected);
}

double period_error(const RunData& run) {
  const auto fit = free_oscillation(run);
  return fit ? run.plan->scene.flow->oscillation()->angular_frequency / fit->angular_frequency - 1 : nan;
}

double decay_error(const RunData& run) {
  const auto fit = free_oscillation(run);
  return fit ? fit->decay_rate / run.plan->scene.flow->oscillation()->decay_rate - 1 : nan;
}

/// Complex amplitude of the probe over that of the exact solution, both fitted to the last period; NaN where
/// there is none.
std::complex<double> relative_amplitude(const RunData& run) {
  const auto driven = run.plan->scene.flow->oscillation();
  if (!driven || driven->decay_rate != 0 || !run.completed() || run.history.empty()) return nan;
  const double omega = driven->angular_frequency, period = 2 * std::numbers::pi / omega;
  const double begin = run.history.back().t - period * (1 + 1e-9);
  if (begin < run.history.front().t - 1e-6 * period) return nan;
  Signal measured, exact;
  for (const reports::HistoryRow& row : run.history) {
    if (row.t < begin) continue;
    measured.t.push_back(row.t);
    measured.value.push_back(row.probe);
    exact.value.push_back(row.probe_exact);
  }
  exact.t = measured.t;
  const auto ours = fit_harmonic(measured, omega), theirs = fit_harmonic(exact, omega);
  return ours && theirs ? *ours / *theirs : nan;
}

}  // namespace

void add_oscillation_quantities(std::vector<QuantityEntry>& entries) {
  entries.insert(entries.end(),
                 {
                     {"period-error", "1", Record::History, false, false,
                      [](const Quantity&, const RunData& r) { return period_error(r); }},
                     {"decay-error", "1", Record::History, false, false,
                      [](const Quantity&, const RunData& r) { return decay_error(r); }},
                     {"amplitude-error", "1", Record::History, false, false,
                      [](const Quantity&, const RunData& r) { return std::abs(relative_amplitude(r)) - 1; }},
                     {"phase-error", "rad", Record::History, false, false,
                      [](const Quantity&, const RunData& r) { return std::arg(relative_amplitude(r)); }},
                 });
}

}  // namespace verification

#include "reference/fluids/flow_curve.hpp"

#include <fmt/format.h>
#include <gsl/gsl_integration.h>

#include <cmath>
#include <limits>
#include <memory>

#include "reference/gsl_quiet.hpp"
#include "reference/require.hpp"

namespace reference {
namespace {

bool positive(double x) {
  return std::isfinite(x) && x > 0.0;
}
bool not_negative(double x) {
  return std::isfinite(x) && x >= 0.0;
}

/// (x - log(1 + x))/x^2, without the cancellation at small x.
double log_remainder(double x) {
  if (x > 0.1) return (x - std::log1p(x)) / (x * x);
  double sum = 0.0, power = 1.0;
  for (int k = 2; std::abs(power) > 1e-18; ++k, power *= -x) sum += power / k;
  return sum;
}

double quadrature(double (*function)(double, void*), const FlowCurve& curve, double upper) {
  quiet_gsl();
  const std::unique_ptr<gsl_integration_cquad_workspace, decltype(&gsl_integration_cquad_workspace_free)>
      work(gsl_integration_cquad_workspace_alloc(200), &gsl_integration_cquad_workspace_free);
  gsl_function f{function, const_cast<FlowCurve*>(&curve)};
  double result = 0.0;
  gsl_integration_cquad(&f, 0.0, upper, 0.0, 1e-14, work.get(), &result, nullptr, nullptr);
  return result;
}

}  // namespace

void NewtonianCurve::check() const {
  require(positive(nu), "Newtonian fluid: nu must be positive and finite");
}

std::string NewtonianCurve::describe() const {
  return fmt::format("Newtonian nu={:.17g}", nu);
}

void CrossCurve::check() const {
  require(positive(nu_0), "Cross fluid: nu_0 must be positive and finite");
  require(not_negative(nu_inf), "Cross fluid: nu_inf must not be negative");
  require(positive(K), "Cross fluid: K must be positive and finite");
  require(positive(M), "Cross fluid: M must be positive and finite");
}

double CrossCurve::viscosity(double w) const {
  const double x = M == 1.0 ? K * w : std::pow(K * w, M), share = 1.0 / (1.0 + x);
  // A weighted mean, as nu_0 - nu_inf would cancel; x/(1+x) in a form that survives an infinite x.
  return nu_0 * share + nu_inf * (x < 1.0 ? x * share : 1.0 - share);
}

double CrossCurve::slope(double w) const {
  const double x = M == 1.0 ? K * w : std::pow(K * w, M);
  // Factors 1/(1+x) kept apart, so that a huge x gives 0 and not inf/inf.
  const double share = 1.0 / (1.0 + x);
  return nu_inf + (nu_0 - nu_inf) * share * (share + (1.0 - M) * (1.0 - share));
}

std::optional<double> CrossCurve::rate(double tau) const {
  if (M != 1.0) return std::nullopt;
  // nu_inf K w^2 + (nu_0 - K tau) w - tau = 0; the positive root in the form that does not cancel.
  const double b = nu_0 - K * tau, root = std::sqrt(b * b + 4.0 * nu_inf * K * tau);
  if (b >= 0.0) return 2.0 * tau / (b + root);
  return (root - b) / (2.0 * nu_inf * K);
}

std::optional<double> CrossCurve::potential(double w) const {
  if (M != 1.0) return std::nullopt;
  return w * w * (0.5 * nu_inf + (nu_0 - nu_inf) * log_remainder(K * w));
}

std::optional<double> CrossCurve::newtonian() const {
  return nu_0 == nu_inf ? std::optional(nu_0) : std::nullopt;
}

std::string CrossCurve::describe() const {
  return fmt::format("Cross nu_0={:.17g} nu_inf={:.17g} K={:.17g} M={:.17g}", nu_0, nu_inf, K, M);
}

void PowerLawCurve::check() const {
  require(positive(nu_0), "power-law fluid: nu_0 must be positive and finite");
  require(positive(n), "power-law fluid: n must be positive and finite");
}

double PowerLawCurve::viscosity(double w) const {
  return nu_0 * std::pow(w, n - 1.0);
}
double PowerLawCurve::slope(double w) const {
  return n * viscosity(w);
}
double PowerLawCurve::rate(double tau) const {
  return std::pow(tau / nu_0, 1.0 / n);
}
double PowerLawCurve::potential(double w) const {
  return nu_0 * std::pow(w, n + 1.0) / (n + 1.0);
}

std::optional<double> PowerLawCurve::newtonian() const {
  return n == 1.0 ? std::optional(nu_0) : std::nullopt;
}

std::string PowerLawCurve::describe() const {
  return fmt::format("power law nu_0={:.17g} n={:.17g}", nu_0, n);
}

void CarreauYasudaCurve::check() const {
  require(positive(nu_0), "Carreau-Yasuda fluid: nu_0 must be positive and finite");
  require(not_negative(nu_inf), "Carreau-Yasuda fluid: nu_inf must not be negative");
  require(positive(lambda), "Carreau-Yasuda fluid: lambda must be positive and finite");
  require(positive(a), "Carreau-Yasuda fluid: a must be positive and finite");
  require(positive(n), "Carreau-Yasuda fluid: n must be positive and finite");
}

double CarreauYasudaCurve::viscosity(double w) const {
  return nu_inf + (nu_0 - nu_inf) * std::pow(1.0 + std::pow(lambda * w, a), (n - 1.0) / a);
}

double CarreauYasudaCurve::slope(double w) const {
  const double x = std::pow(lambda * w, a), factor = std::pow(1.0 + x, (n - 1.0) / a);
  const double share = 1.0 / (1.0 + x);  // a huge x gives n, and not inf/inf
  return nu_inf + (nu_0 - nu_inf) * factor * (share + n * (1.0 - share));
}

std::optional<double> CarreauYasudaCurve::newtonian() const {
  return nu_0 == nu_inf || n == 1.0 ? std::optional(nu_0) : std::nullopt;
}

std::string CarreauYasudaCurve::describe() const {
  return fmt::format("Carreau-Yasuda nu_0={:.17g} nu_inf={:.17g} lambda={:.17g} a={:.17g} n={:.17g}", nu_0,
                     nu_inf, lambda, a, n);
}

void HerschelBulkleyCurve::check() const {
  require(positive(nu_0), "Herschel-Bulkley fluid: nu_0 must be positive and finite");
  require(positive(n), "Herschel-Bulkley fluid: n must be positive and finite");
  require(positive(tau_y), "Herschel-Bulkley fluid: tau_y must be positive and finite");
  require(m > 0.0, "Herschel-Bulkley fluid: m must be positive");
}

double HerschelBulkleyCurve::viscosity(double w) const {
  const double power = n == 1.0 ? nu_0 : nu_0 * std::pow(w, n - 1.0);
  if (w == 0.0) return power + tau_y * m;
  return power - tau_y * std::expm1(-m * w) / w;
}

double HerschelBulkleyCurve::slope(double w) const {
  const double power = n == 1.0 ? nu_0 : n * nu_0 * std::pow(w, n - 1.0);
  if (std::isinf(m)) return w == 0.0 ? m : power;
  return power + tau_y * m * std::exp(-m * w);
}

double HerschelBulkleyCurve::rate(double tau) const {
  const double beyond = tau - tau_y, least = beyond > 0.0 ? std::pow(beyond / nu_0, 1.0 / n) : 0.0;
  if (std::isinf(m)) return least;
  // A bracket: the regularised stress lies below the ideal one, above each of its parts, and below
  // nu_0 w^n + tau_y m w. In it Newton's method, which a bisection of log(w) replaces where it would leave
  // it.
  double low = std::max(least, std::min(std::pow(0.5 * tau / nu_0, 1.0 / n), 0.5 * tau / (tau_y * m)));
  double high = std::pow(tau / nu_0, 1.0 / n);
  if (beyond < 0.0) high = std::min(high, -std::log1p(-tau / tau_y) / m);
  high = std::max(high, low);
  double w = low;
  for (int i = 0; i < 200; ++i) {
    // With beyond, nothing cancels far above the yield stress, nor with expm1 far below it.
    const double power = nu_0 * std::pow(w, n), decay = std::exp(-m * w);
    const double excess =
        beyond > 0.0 ? (power - beyond) - tau_y * decay : (power - tau) - tau_y * std::expm1(-m * w);
    if (excess == 0.0) return w;
    (excess < 0.0 ? low : high) = w;
    const double next = w - excess / slope(w);
    const bool inside = next > low && next < high;
    const double before = w;
    w = inside ? next : std::sqrt(low) * std::sqrt(high);
    if (std::abs(w - before) <= 2.0 * std::numeric_limits<double>::epsilon() * w) return w;
  }
  return w;
}

double HerschelBulkleyCurve::potential(double w) const {
  const double yield = std::isinf(m) ? w : w + std::expm1(-m * w) / m;
  return nu_0 * std::pow(w, n + 1.0) / (n + 1.0) + tau_y * yield;
}

std::string HerschelBulkleyCurve::describe() const {
  return fmt::format("Herschel-Bulkley nu_0={:.17g} n={:.17g} tau_y={:.17g} m={:.17g}", nu_0, n, tau_y, m);
}

HerschelBulkleyCurve HerschelBulkleyCurve::ideal() const {
  return {nu_0, n, tau_y, std::numeric_limits<double>::infinity()};
}

FlowCurve::FlowCurve(const Model& model) : model_(model) {
  std::visit([](const auto& m) { m.check(); }, model_);
}

double FlowCurve::viscosity(double w) const {
  return std::visit([w](const auto& m) { return m.viscosity(std::abs(w)); }, model_);
}

double FlowCurve::stress(double w) const {
  if (w == 0.0) return 0.0;
  return w * viscosity(w);
}

double FlowCurve::slope(double w) const {
  return std::visit([w](const auto& m) { return m.slope(std::abs(w)); }, model_);
}

double FlowCurve::rate(double tau) const {
  if (tau == 0.0) return 0.0;
  const double magnitude = std::abs(tau);
  std::optional<double> w = std::visit(
      [magnitude](const auto& m) -> std::optional<double> {
        if constexpr (requires { m.rate(magnitude); }) return m.rate(magnitude);
        return std::nullopt;
      },
      model_);
  if (!w) w = invert(magnitude);
  require(std::isfinite(*w), "flow curve: no finite shear rate gives this stress");
  return std::copysign(*w, tau);
}

double FlowCurve::invert(double tau) const {
  // Bracket by doubling from a first guess, then Newton steps on log(w), which a bisection replaces whenever
  // they leave the bracket. On these axes every power law is a straight line, hence one step.
  double low = tau / viscosity(1e-3), high = low;
  while (stress(low) > tau) low *= 0.25;
  while (stress(high) < tau) {
    high *= 4.0;
    require(high < 1e150, "flow curve: no finite shear rate gives this stress");
  }
  double w = std::sqrt(low) * std::sqrt(high);
  for (int i = 0; i < 200; ++i) {
    const double value = stress(w);
    (value < tau ? low : high) = w;
    const double log_step = std::log(tau / value) / local_exponent(w);
    if (std::abs(log_step) <= 2.0 * std::numeric_limits<double>::epsilon()) return w;
    w *= std::exp(log_step);
    if (!(w > low && w < high)) w = std::sqrt(low) * std::sqrt(high);
  }
  return w;
}

double FlowCurve::potential(double w) const {
  const double magnitude = std::abs(w);
  const std::optional<double> closed = std::visit(
      [magnitude](const auto& m) -> std::optional<double> {
        if constexpr (requires { m.potential(magnitude); }) return m.potential(magnitude);
        return std::nullopt;
      },
      model_);
  if (closed) return *closed;
  return quadrature([](double s, void* curve) { return static_cast<const FlowCurve*>(curve)->stress(s); },
                    *this, magnitude);
}

double FlowCurve::complementary_potential(double tau) const {
  const double w = rate(tau);
  return w * tau - potential(w);
}

std::optional<double> FlowCurve::newtonian() const {
  return std::visit([](const auto& m) { return m.newtonian(); }, model_);
}

void FlowCurve::require_monotone(double largest_rate) const {
  require(std::isfinite(largest_rate), "flow curve: the largest shear rate must be finite");
  constexpr int kPerDecade = 64;  // the models' slopes vary over a decade at the fastest
  constexpr int kDecades = 20;
  for (int i = 0; i <= kDecades * kPerDecade; ++i) {
    const double w = std::abs(largest_rate) * std::pow(10.0, -double(i) / kPerDecade);
    if (w > 0.0 && !(slope(w) > 0.0)) {
      throw std::invalid_argument(
          fmt::format("flow curve: the stress falls with the shear rate near {:g} 1/s ({})", w, describe()));
    }
  }
}

std::string FlowCurve::describe() const {
  return std::visit([](const auto& m) { return m.describe(); }, model_);
}

}  // namespace reference

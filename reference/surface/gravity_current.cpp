#include "reference/surface/gravity_current.hpp"

#include <cmath>

#include "reference/require.hpp"

namespace reference {
namespace {

void check(double value, const char* message) {
  require(std::isfinite(value) && value > 0, message);
}

}  // namespace

GravityCurrent::GravityCurrent(const GravityCurrentParameters& p) : parameters_(p) {
  check(p.area, "gravity current: the area must be positive and finite");
  check(p.gravity, "gravity current: gravity must be positive and finite");
  check(p.consistency, "gravity current: the consistency must be positive and finite");
  check(p.index, "gravity current: the index must be positive and finite");
  c_ = p.index / (2 * p.index + 1) * std::pow(p.gravity / p.consistency, 1 / p.index);
}

double GravityCurrent::exponent(double n) {
  return n / (2 * n + 3);
}

/// Integral of (1 - s^m)^p over [0, 1] = Gamma(1 + 1/m) Gamma(1 + p)/Gamma(1 + 1/m + p).
double GravityCurrent::fullness(double n) {
  const double a = 1 / (n + 1), p = 1 / (n + 2);
  // Not by lgamma(), which keeps the sign in a variable that all threads share.
  return std::tgamma(1 + a) * std::tgamma(1 + p) / std::tgamma(1 + a + p);
}

double GravityCurrent::front_constant(double n) {
  const double shape = (n + 1) / ((n + 2) * std::pow(fullness(n), n + 2));
  return std::pow((2 * n + 3) / n, exponent(n)) * std::pow(shape, 1 / (2 * n + 3));
}

double GravityCurrent::gravity_of(double front, double t, const GravityCurrentParameters& p) {
  check(front, "gravity current: the front must be positive and finite");
  check(t, "gravity current: the time must be positive and finite");
  const double n = p.index;
  const double c_to_n =
      std::pow(front / front_constant(n), 2 * n + 3) / (std::pow(p.area, n + 2) * std::pow(t, n));
  return p.consistency * std::pow((2 * n + 1) / n, n) * c_to_n;
}

double GravityCurrent::front(double t) const {
  check(t, "gravity current: the time must be positive and finite");
  const auto& [area, gravity, consistency, n] = parameters_;
  return front_constant(n) * std::pow(std::pow(c_ * t, n) * std::pow(area, n + 2), 1 / (2 * n + 3));
}

double GravityCurrent::height(double x, double t) const {
  const double n = parameters_.index, end = front(t), s = x / end;
  if (!(s < 1)) return 0;
  return parameters_.area / (end * fullness(n)) * std::pow(1 - std::pow(s, n + 1), 1 / (n + 2));
}

}  // namespace reference

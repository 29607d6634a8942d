#include "verification/checks/quantities/oscillation.hpp"

#include <cmath>
#include <numbers>

#include "tests/catch.hpp"

using namespace verification;
using std::numbers::pi;

namespace {

template <class F>
Signal sampled(F f, double end, int n) {
  Signal signal;
  for (int i = 0; i <= n; ++i) {
    signal.t.push_back(end * i / n);
    signal.value.push_back(f(signal.t.back()));
  }
  return signal;
}

}  // namespace

TEST_CASE("a damped oscillation's frequency and decay are found, though others were expected") {
  const double omega = 6e3, decay = 500, size = GENERATE(1e-6, 1.0, -3e4);
  const double wrong = GENERATE(1.0, 0.93, 1.08, 0.7, 1.4);  // an EOS exponent of 6 is off by 0.93
  const double phase = GENERATE(0.0, 1.0, -2.5);
  const Signal signal = sampled(
      [&](double t) { return size * std::exp(-decay * t) * std::cos(omega * t + phase); }, 2.8e-3, 140);
  const auto fit = fit_damped_oscillation(signal, {omega / wrong, 1.5 * decay});
  REQUIRE(fit);
  // Round-off: the fit stops at 1e-10 of the expected frequency.
  CHECK(fit->angular_frequency == Approx(omega).epsilon(1e-9));
  CHECK(fit->decay_rate == Approx(decay).epsilon(1e-8));
}

TEST_CASE("noise moves the fit of a damped oscillation by as much as it should") {
  const double omega = 6e3, decay = 500;
  int k = 0;
  const Signal signal =
      sampled([&](double t) { return std::exp(-decay * t) * std::cos(omega * t) + (++k % 2 ? 1e-3 : -1e-3); },
              2.8e-3, 140);
  const auto fit = fit_damped_oscillation(signal, {omega, decay});
  REQUIRE(fit);
  CHECK(fit->angular_frequency == Approx(omega).epsilon(1e-4));  // alternating noise averages out
  CHECK(fit->decay_rate == Approx(decay).epsilon(1e-3));
}

TEST_CASE("nothing is fitted to too little, to silence, or to a run that blew up") {
  CHECK_FALSE(fit_damped_oscillation(sampled([](double t) { return std::cos(t); }, 6, 6), {1, 0.1}));
  CHECK_FALSE(fit_damped_oscillation(sampled([](double) { return 0.0; }, 6, 60), {1, 0.1}));
  CHECK_FALSE(fit_damped_oscillation(sampled([](double t) { return t > 3 ? NAN : t; }, 6, 60), {1, 0.1}));
  CHECK_FALSE(fit_harmonic(sampled([](double t) { return std::cos(t); }, 6, 6), 1));
  CHECK_FALSE(fit_harmonic(sampled([](double) { return NAN; }, 6, 60), 1));
}

TEST_CASE("a driven oscillation's amplitude and phase are found beside a mean") {
  const double omega = 100;
  const auto fit = fit_harmonic(
      sampled([&](double t) { return 0.3 + 2 * std::cos(omega * t + 0.7); }, 2 * pi / omega, 40), omega);
  REQUIRE(fit);
  CHECK(std::abs(*fit) == Approx(2).epsilon(1e-12));
  CHECK(std::arg(*fit) == Approx(0.7).epsilon(1e-12));
}

#include "reference/transient/transient_channel.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>

#include "reference/channel/channel_factory.hpp"
#include "reference/channel/newtonian_channel.hpp"
#include "reference/channel/power_law_exact.hpp"
#include "reference/channel/steady_channel.hpp"
#include "reference/transient/shear_integration.hpp"
#include "reference/transient/transient_cache.hpp"
#include "tests/catch.hpp"
#include "tests/scratch_directory.hpp"

using namespace reference;

namespace {

constexpr double kHeight = 1e-3, kForce = 8e-3, kPlate = 1e-4;

ChannelProblem problem(const FlowCurve& curve, double force, double plate, std::vector<double> times) {
  return {kHeight, force, plate, curve, std::move(times)};
}

struct Gap {
  double velocity = 0.0, gradient = 0.0;  // largest differences
};

template <class A, class B>
Gap gap(const A& a, const B& b, double t, double from = 0.0, double to = kHeight) {
  Gap g;
  for (int i = 0; i <= 80; ++i) {
    const double y = std::min(to, from + (to - from) * i / 80);
    g.velocity = std::max(g.velocity, std::abs(a.velocity(y, t) - b.velocity(y, t)));
    if (y < kHeight) g.gradient = std::max(g.gradient, std::abs(a.gradient(y, t) - b.gradient(y, t)));
  }
  return g;
}

}  // namespace

TEST_CASE("transient channel: the method reproduces the Newtonian series") {
  for (const auto& drive : {std::pair{kForce, 0.0}, std::pair{0.0, -kPlate}, std::pair{kForce, 5 * kPlate}}) {
    TransientSolution computed(problem(NewtonianCurve{1e-6}, drive.first, drive.second, {0.005, 0.05, 1.0}),
                               {10, 1e-6, 1e-4, 1e-12});
    computed.solve();
    const NewtonianChannel exact({kHeight, 1e-6, drive.first, drive.second});
    for (double t : {0.005, 0.0123, 0.05, 0.3, 1.0}) {
      // Measured 8e-11 and 9e-10 at this tolerance, listed times or not; five times that.
      const Gap g = gap(computed, exact, t);
      CHECK(g.velocity < 4e-10 * exact.steady_maximum());
      CHECK(g.gradient < 5e-9 * std::abs(exact.gradient(kHeight, t)));
    }
  }
}

TEST_CASE("transient channel: thinning Couette is Barenblatt's while its tail is far from the other plate") {
  for (double n : {0.6, 0.8}) {
    const BarenblattCouette exact(1e-6, n, kPlate);
    const double t = exact.time_of_thickness(n < 0.7 ? 2e-3 * kHeight : 0.03 * kHeight);
    TransientSolution computed(problem(PowerLawCurve{1e-6, n}, 0.0, kPlate, {t}), {12, 1e-7, 1e-4, 1e-12});
    computed.solve();
    double velocity = 0.0, rate = 0.0;
    for (int i = 0; i <= 200; ++i) {
      const double s = 10.0 * exact.thickness(t) * i / 200;
      velocity = std::max(velocity, std::abs(computed.velocity(kHeight - s, t) - exact.velocity(s, t)));
      rate = std::max(rate, std::abs(computed.gradient(kHeight - s, t) - exact.rate(s, t)));
    }
    // The gap cuts off the tail, a share of velocity(H)/V0 = 2e-11 (n = 0.6) and 1e-12 (0.8); the rest is the
    // method's error.
    CHECK(exact.velocity(kHeight, t) < 1e-10 * kPlate);
    CHECK(velocity < 2e-10 * kPlate);
    CHECK(rate < 2e-9 * exact.rate(0.0, t));
  }
}

TEST_CASE("transient channel: the method follows the self-similar start-up and its front") {
  // n = 1.2: stress ~ (distance to the front)^6, smooth enough for eight digits with the front amid an
  // element.
  const FlowCurve curve = PowerLawCurve{1e-6, 1.2};
  const PowerLawStartUp exact(1e-6, 1.2, kForce);
  const double end = exact.arrival(0.5 * kHeight), begin = 0.25 * end;
  const SpectralLine line(std::vector<double>(32, 0.5 * kHeight / 32), 8);
  const ShearDiffusion diffusion(curve, line, -kForce, ShearDiffusion::FarEnd::kGivenRate,
                                 ShearDiffusion::Unknown::kRate);
  std::vector<double> w;
  for (double s : line.nodes()) w.push_back(exact.gradient(s, begin));
  const GradientHistory history =
      integrate_shear(diffusion, line, w, {begin, end, 1e-3 * begin, begin, kForce * end, 1e-5});
  for (double share : {0.3, 0.6, 1.0}) {
    double error = 0.0;
    for (int i = 0; i <= 100; ++i) {
      const double s = 0.5 * kHeight * i / 100, t = share * end;
      error = std::max(error, std::abs(history.integral(s, t) - exact.velocity(s, t)));
    }
    CHECK(error < 1e-8 * kForce * end);
  }
}

TEST_CASE("transient channel: joins its exact beginning and its steady end") {
  // Fronts meet at 0.0284 s; before that the exact profile is served, after it the computed one, with no step
  // between.
  const FlowCurve curve = PowerLawCurve{1e-6, 1.4};
  const PowerLawStartUp exact(1e-6, 1.4, kForce);
  const double meet = exact.arrival(0.5 * kHeight);
  const TransientChannel flow(problem(curve, kForce, 0.0, {0.01, 0.05, 2.0}));
  CHECK(flow.velocity(0.1e-3, 0.01) == exact.velocity(0.1e-3, 0.01));
  // u_t = F at most, so 1e-4 of the time moves u by less than F t 1e-4.
  CHECK(gap(flow, exact, meet * 1.0001, 0.0, 0.5 * kHeight).velocity < 1e-4 * kForce * meet);
  CHECK(flow.stated_error() < 1e-9);
  CHECK(flow.stated_gradient_error() < 1e-8);
  const SteadyChannel steady(kHeight, kForce, 0.0, curve);
  CHECK(flow.steady_maximum() == steady.maximum());
  for (int i = 0; i <= 50; ++i) {
    // Thickening: by 2 s, seventy times the meeting time, the transient has died out.
    const double y = kHeight * i / 50;
    CHECK(std::abs(flow.velocity(y, 2.0) - steady.velocity(y)) < 1e-9 * steady.maximum());
    CHECK(std::abs(flow.gradient(y, 2.0) - steady.gradient(y)) < 1e-8 * steady.largest_rate());
  }
}

TEST_CASE("transient channel: walls, symmetries and rest") {
  const FlowCurve curve = CrossCurve{1e-6, 0.25e-6, 1.0, 1.0};
  const TransientResolution resolution{8, 1e-5, 1e-6, 1e-11};
  TransientSolution poiseuille(problem(curve, -kForce, 0.0, {0.05, 0.2}), resolution);
  TransientSolution couette(problem(curve, 0.0, kPlate, {0.05, 0.2}), resolution);
  poiseuille.solve();
  couette.solve();
  for (double t : {0.0, 1e-12, 1e-5, 0.05, 0.2}) {
    CHECK(poiseuille.velocity(0.0, t) == 0.0);
    CHECK(poiseuille.velocity(kHeight, t) == 0.0);
    CHECK(couette.velocity(0.0, t) == 0.0);
    CHECK(couette.velocity(kHeight, t) == kPlate);
    CHECK(poiseuille.gradient(0.5 * kHeight, t) == 0.0);
  }
  CHECK(couette.velocity(0.9e-3, 0.0) == 0.0);
  CHECK(couette.gradient(0.9e-3, 0.0) == 0.0);
  CHECK(std::isinf(couette.gradient(kHeight, 0.0)));
  CHECK(poiseuille.velocity(0.25e-3, 0.1) == poiseuille.velocity(0.75e-3, 0.1));
  CHECK(poiseuille.gradient(0.25e-3, 0.1) == -poiseuille.gradient(0.75e-3, 0.1));
  CHECK(poiseuille.velocity(0.3e-3, 0.05) < 0.0);
  // Before the walls' layers reach it, the core moves with F t: at 1e-5 s they are sqrt(1e-6 1e-5) = 3 um
  // thick.
  CHECK(poiseuille.velocity(0.5e-3, 1e-5) == Approx(-kForce * 1e-5).epsilon(1e-9));
  // u_t = F + tau_y in the middle of it all, by central differences: truncation (dt/t)^2, (dy/H)^2 of some
  // tens.
  const double y = 0.23e-3, t = 0.1, dy = 1e-6, dt = 1e-4;
  const double u_t = (poiseuille.velocity(y, t + dt) - poiseuille.velocity(y, t - dt)) / (2 * dt);
  const double tau_y =
      (curve.stress(poiseuille.gradient(y + dy, t)) - curve.stress(poiseuille.gradient(y - dy, t))) /
      (2 * dy);
  CHECK(std::abs(u_t + kForce - tau_y) < 1e-5 * kForce);
}

TEST_CASE("transient channel: a combined flow states an error that a finer computation confirms") {
  const ChannelProblem combined =
      problem(CrossCurve{1e-6, 4e-6, 1.0, 1.0}, kForce, 5 * kPlate, {0.005, 0.05, 0.5});
  const TransientChannel flow(combined);
  TransientSolution finer(combined, {8, 3e-5, 1e-7, 1e-13});
  finer.solve();
  double velocity = 0.0;
  for (double t : combined.times) velocity = std::max(velocity, gap(flow, finer, t).velocity);
  CHECK(flow.stated_error() < 1e-5);
  CHECK(velocity < flow.stated_error() * flow.steady_maximum());
  const SteadyChannel steady(kHeight, kForce, 5 * kPlate, combined.curve);
  CHECK(flow.steady_maximum() == steady.maximum());
  CHECK(std::abs(flow.velocity(0.4e-3, 0.5) - steady.velocity(0.4e-3)) < 1e-4 * steady.maximum());
}

TEST_CASE("transient channel: the cache gives the same bytes back, and nothing that is damaged") {
  const ScratchDirectory scratch;
  const ChannelProblem thickening = problem(PowerLawCurve{1e-6, 1.4}, 0.0, kPlate, {0.05, 0.2});
  const TransientChannel first(thickening, scratch.path()), second(thickening, scratch.path());
  CHECK_FALSE(first.from_cache());
  CHECK(second.from_cache());
  CHECK(second.stated_error() == first.stated_error());
  CHECK(second.stated_gradient_error() == first.stated_gradient_error());
  CHECK(second.velocity(0.3e-3, 0.2) == first.velocity(0.3e-3, 0.2));
  CHECK(second.gradient(0.3e-3, 0.17) == first.gradient(0.3e-3, 0.17));

  int files = 0;
  std::filesystem::path stored;
  for (const auto& entry : std::filesystem::directory_iterator(scratch.path()))
    stored = entry.path(), ++files;
  REQUIRE(files == 1);  // no temporary file stays behind
  const auto size = std::filesystem::file_size(stored);
  SECTION("one byte changed") {
    std::fstream file(stored, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(size / 2));
    const char old = static_cast<char>(file.peek());
    file.seekp(static_cast<std::streamoff>(size / 2));
    file.put(static_cast<char>(old ^ 1));
  }
  SECTION("cut short") {
    std::filesystem::resize_file(stored, size / 3);
  }
  SECTION("empty") {
    std::filesystem::resize_file(stored, 0);
  }
  SECTION("another problem's") {
    std::ofstream(stored, std::ios::binary) << "mpm-verify transient reference, format 3\nsomething else\n";
  }
  const TransientChannel third(thickening, scratch.path());
  CHECK_FALSE(third.from_cache());
  CHECK(third.velocity(0.3e-3, 0.2) == first.velocity(0.3e-3, 0.2));
  CHECK(TransientChannel(thickening, scratch.path()).from_cache());
}

TEST_CASE("transient channel: a shorter problem reads the same numbers off a longer one's history") {
  const ScratchDirectory scratch;
  for (const double force : {0.0, kForce}) {  // from a landed front, and from rest
    const FlowCurve curve =
        force == 0.0 ? FlowCurve(PowerLawCurve{1e-6, 1.4}) : FlowCurve(CrossCurve{1e-6, 4e-6, 1.0, 1.0});
    const double plate = force == 0.0 ? kPlate : 0.0;
    const ChannelProblem brief = problem(curve, force, plate, {0.02, 0.1});
    const ChannelProblem longer = problem(curve, force, plate, {0.05, 0.4});
    const TransientChannel alone(brief);
    CHECK_FALSE(TransientChannel(longer, scratch.path()).from_cache());
    const TransientChannel shared(brief, scratch.path());
    CHECK(shared.from_cache());
    CHECK(shared.stated_error() == alone.stated_error());
    CHECK(shared.stated_gradient_error() == alone.stated_gradient_error());
    for (const double t : {0.005, 0.02, 0.0734, 0.1}) {
      const Gap g = gap(shared, alone, t);
      CHECK(g.velocity == 0.0);
      CHECK(g.gradient == 0.0);
    }
    CHECK_FALSE(TransientChannel(problem(curve, force, plate, {0.02, 0.5}), scratch.path()).from_cache());
    CHECK_FALSE(TransientChannel(problem(curve, force, plate, {0.002, 0.1}), scratch.path()).from_cache());
  }
}

TEST_CASE("transient channel: degree 12 where the flow curve is nearly kinked, 8 elsewhere") {
  const auto degree = [](const FlowCurve& curve, double force, double plate) {
    return fine_resolution(problem(curve, force, plate, {0.1})).degree;
  };
  CHECK(degree(CrossCurve{1e-6, 1e-9, 1.0, 1.0}, 0.0, 1e-2) == 12);  // its exponent falls from 1 to 0.1
  CHECK(degree(CrossCurve{1e-6, 4e-6, 1.0, 1.0}, kForce, 0.0) == 8);
  CHECK(degree(PowerLawCurve{1e-6, 0.2}, kForce, 0.0) == 8);  // one exponent everywhere
}

TEST_CASE("transient channel: a cache that cannot be written costs nothing but time") {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("cache", "a file where the directory should be");
  const ChannelProblem thickening = problem(PowerLawCurve{1e-6, 1.4}, 0.0, kPlate, {0.05});
  CHECK(TransientChannel(thickening, file).velocity(0.9e-3, 0.05) > 0.0);
}

TEST_CASE("channel factory: exact where it can be, else a transient") {
  const auto is_newtonian = [](const FlowCurve& curve) {
    const auto flow = make_channel_solution(problem(curve, kForce, 0.0, {1e-3}));
    return dynamic_cast<const NewtonianChannel*>(flow.get()) != nullptr;
  };
  CHECK(is_newtonian(NewtonianCurve{1e-6}));
  CHECK(is_newtonian(CrossCurve{1e-6, 1e-6, 1.0, 1.0}));
  CHECK(is_newtonian(PowerLawCurve{1e-6, 1.0}));
  CHECK_FALSE(is_newtonian(PowerLawCurve{1e-6, 1.4}));
}

TEST_CASE("transient channel: what cannot be computed is refused") {
  const FlowCurve curve = PowerLawCurve{1e-6, 1.4};
  CHECK_THROWS_WITH(TransientChannel(problem(curve, 0.0, 0.0, {1.0})), contains("nothing drives"));
  CHECK_THROWS_WITH(TransientChannel(problem(curve, kForce, 0.0, {})), contains("positive time"));
  CHECK_THROWS_WITH(TransientChannel(problem(curve, kForce, 0.0, {-1.0})), contains("not negative"));
  CHECK_THROWS_WITH(TransientChannel(problem(NewtonianCurve{1e-6}, kForce, 0.0, {1.0})),
                    contains("Newtonian"));
  CHECK_THROWS_WITH(TransientChannel({0.0, kForce, 0.0, curve, {1.0}}), contains("height"));
  CHECK_THROWS_WITH(TransientChannel(problem(CrossCurve{1e-6, 0.01e-6, 1.0, 2.0}, 0.0, kPlate, {1.0})),
                    contains("falls"));
  CHECK_THROWS_WITH(TransientChannel(problem(CrossCurve{1e-6, 0.0, 1.0, 1.0}, 0.0, kPlate, {1.0})),
                    contains("flattens"));
  const TransientChannel flow(problem(curve, 0.0, kPlate, {0.01}));
  CHECK_THROWS_WITH(flow.velocity(0.5e-3, 0.02), contains("beyond"));
  CHECK_THROWS_WITH(flow.gradient(2e-3, 0.01), contains("plates"));
  CHECK_THROWS_WITH(flow.velocity(0.5e-3, std::numeric_limits<double>::quiet_NaN()), contains("time"));
}

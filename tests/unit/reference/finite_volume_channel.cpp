#include "reference/transient/finite_volume_channel.hpp"

#include <algorithm>
#include <cmath>

#include "reference/channel/channel_factory.hpp"
#include "tests/catch.hpp"

using namespace reference;

namespace {

constexpr double kHeight = 1e-3, kForce = 8e-3, kPlate = 1e-4;

struct Disagreement {
  double velocity = 0.0, gradient = 0.0, largest_gradient = 0.0;
};

Disagreement compare(const FiniteVolumeProfile& fv, const ChannelSolution& flow, double t) {
  Disagreement d;
  for (std::size_t j = 0; j < fv.velocity.size(); ++j) {
    const double y = std::min(fv.node_heights[j], kHeight);
    d.velocity = std::max(d.velocity, std::abs(fv.velocity[j] - flow.velocity(y, t)));
  }
  for (std::size_t j = 0; j < fv.gradient.size(); ++j) {
    const double w = flow.gradient(fv.face_heights[j], t);
    d.gradient = std::max(d.gradient, std::abs(fv.gradient[j] - w));
    d.largest_gradient = std::max(d.largest_gradient, std::abs(w));
  }
  return d;
}

}  // namespace

TEST_CASE("finite volume channel: within its own error of the Newtonian series, and that shrinks as h^4") {
  for (const auto& drive : {std::pair{kForce, 0.0}, std::pair{0.0, kPlate}, std::pair{-kForce, 5 * kPlate}}) {
    const ChannelProblem problem{kHeight, drive.first, drive.second, NewtonianCurve{1e-6}, {}};
    const auto exact = make_channel_solution(problem);
    for (double t : {0.005, 0.1, 1.0}) {
      const FiniteVolumeProfile fv = finite_volume_channel(problem, t, 24, 24);
      const Disagreement d = compare(fv, *exact, t);
      CHECK(d.velocity < fv.velocity_error);
      CHECK(d.gradient < fv.gradient_error);
      CHECK(fv.velocity_error <
            1e-4 * exact->steady_maximum());  // two hundred cells of a second-order scheme
    }
    // Three times as fine: 81 times less if the h^4 term is what is left; TR-BDF2's odd powers of dt take
    // some of that.
    const double coarse = finite_volume_channel(problem, 0.1, 16, 16).velocity_error;
    const double fine = finite_volume_channel(problem, 0.1, 48, 48).velocity_error;
    CHECK(coarse / fine > 27.0);
  }
}

TEST_CASE("finite volume channel: a fluid of infinite viscosity at rest starts to flow") {
  // At rest dw/dtau = 0 everywhere, and Newton's matrix for the stress is singular there.
  const ChannelProblem problem{kHeight, kForce, 0.0, PowerLawCurve{1e-6, 0.6}, {0.02}};
  const auto reference = make_channel_solution(problem);
  const FiniteVolumeProfile fv = finite_volume_channel(problem, 0.02, 32, 32);
  CHECK(compare(fv, *reference, 0.02).velocity <
        fv.velocity_error + reference->stated_error() * reference->steady_maximum());
  CHECK(fv.velocity_error < 1e-3 * reference->steady_maximum());
}

TEST_CASE("finite volume channel: agrees with the transient reference within its own error") {
  struct Case {
    FlowCurve curve;
    double force, plate;
  };
  // One of each kind; every fluid and both flows take a minute, and have been compared by hand.
  const Case c =
      GENERATE(Case{CrossCurve{1e-6, 0.25e-6, 1.0, 1.0}, kForce, 0.0},
               Case{CrossCurve{1e-6, 4e-6, 1.0, 1.0}, 0.0, kPlate},
               Case{PowerLawCurve{1e-6, 0.6}, 0.0, kPlate}, Case{PowerLawCurve{1e-6, 1.2}, kForce, 0.0});
  INFO(c.curve.describe() << " F = " << c.force);
  const ChannelProblem problem{kHeight, c.force, c.plate, c.curve, {0.02, 0.2}};
  const auto reference = make_channel_solution(problem);
  for (double t : problem.times) {
    const FiniteVolumeProfile fv = finite_volume_channel(problem, t, 32, 32);
    const Disagreement d = compare(fv, *reference, t);
    const double scale = reference->steady_maximum();
    CHECK(d.velocity < fv.velocity_error + reference->stated_error() * scale);
    CHECK(d.gradient < fv.gradient_error + 1e-8 * d.largest_gradient);
    // Measured 1e-9 to 1.3e-7; the finest level has 288 cells.
    CHECK(d.velocity < 1e-6 * scale);
  }
}

TEST_CASE("finite volume channel: bad arguments are refused") {
  const ChannelProblem problem{kHeight, kForce, 0.0, NewtonianCurve{1e-6}, {}};
  CHECK_THROWS_WITH(finite_volume_channel(problem, 0.0, 16, 16), contains("time"));
  CHECK_THROWS_WITH(finite_volume_channel(problem, 1.0, 5, 16), contains("cells"));
  CHECK_THROWS_WITH(finite_volume_channel(problem, 1.0, 16, 1), contains("steps"));
}

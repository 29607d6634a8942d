#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "tests/catch.hpp"
#include "verification/stability/predicted_limit.hpp"

using namespace verification;
using mpm::Scheme;
using std::numbers::pi;
using Basis = Scheme::Basis;
using Transfer = Scheme::Transfer;
using Stepping = Scheme::Stepping;

namespace {

Scheme scheme_of(Basis basis, Transfer transfer, Stepping stepping) {
  return {basis, transfer, stepping};
}

StabilityProblem problem_of(const Scheme& scheme, Waves waves, const StepSize& ray) {
  StabilityProblem problem{scheme, {}, waves, ray};
  if (waves != Waves::Plane) problem.lattice.per_cell[0] = 1;
  return problem;
}

double limit(Stepping stepping, Waves waves, const StepSize& ray, Motion motion) {
  const auto problem = problem_of(scheme_of(Basis::Linear, Transfer::Flip, stepping), waves, ray);
  return predict_limit(problem, motion, 40).multiple.value_or(NAN);
}

constexpr StepSize viscous{1, 0}, acoustic{0, 1};
// Limits move by half of the growth that is taken for round-off (1e-6), and by the last step of the search
// for the worst point, squared.
constexpr double exactly = 1e-5;

}  // namespace

TEST_CASE("with the linear basis and rows at a quarter, P2G after G2P is 1 - 3/4 sin^2(theta/2)") {
  const double theta = GENERATE(0.0, 0.7, 1.9, pi);
  const double s = std::pow(std::sin(theta / 2), 2);
  const BlochSymbols symbols = bloch_symbols(Basis::Linear, {{1, 2}}, {0, theta});
  CHECK(symbols.remap == Approx(1 - 0.75 * s).margin(1e-14));
  CHECK(symbols.affine_remap == Approx(1).margin(1e-14));  // loses nothing
  CHECK(symbols.viscous(0, 0).real() == Approx(4 * s).margin(1e-13));
  CHECK(symbols.viscous(1, 1).real() == Approx(4.0 / 3 * 4 * s).margin(1e-13));
  CHECK(symbols.dilation(1, 1).real() == Approx(4 * s).margin(1e-13));
  CHECK(std::abs(symbols.viscous(0, 1)) < 1e-14);
}

TEST_CASE("a uniform field passes every basis unchanged and feels no stress") {
  const Basis basis = GENERATE(Basis::Linear, Basis::Quadratic, Basis::Cubic);
  const bool gauss = GENERATE(false, true);
  const BlochSymbols symbols = bloch_symbols(basis, {{2, 3}, gauss, {0.13, 0.31}}, {0, 0});
  CHECK(symbols.remap == Approx(1).margin(1e-14));
  CHECK(symbols.affine_remap == Approx(1).margin(1e-14));
  CHECK(symbols.viscous.norm() < 1e-13);
  CHECK(symbols.dilation.norm() < 1e-13);
}

TEST_CASE("the work of the viscous stress is never negative, whatever the wave and the offset") {
  const Basis basis = GENERATE(Basis::Linear, Basis::Quadratic, Basis::Cubic);
  const double theta = GENERATE(0.4, 2.0, 3.0);
  const BlochSymbols symbols = bloch_symbols(basis, {{2, 2}, false, {0.2, 0.05}}, {theta, 1.1});
  CHECK((symbols.viscous - symbols.viscous.adjoint()).norm() < 1e-13);
  CHECK((symbols.dilation - symbols.dilation.adjoint()).norm() < 1e-13);
  const double determinant =
      (symbols.viscous(0, 0) * symbols.viscous(1, 1)).real() - std::norm(symbols.viscous(0, 1));
  CHECK(symbols.viscous.trace().real() > 0);
  CHECK(determinant > 0);
}

TEST_CASE("limits of the paper's basis and transfer in closed form") {
  // Stress first, shear: r 4 s (1 - 3/4 s) <= 2 for all s = sin^2(theta/2). Streaming: S = 1/2 at s = 1.
  CHECK(limit(Stepping::Usf, Waves::Shear, viscous, Motion::Rest) == Approx(1.5).epsilon(exactly));
  CHECK(limit(Stepping::Musl, Waves::Shear, viscous, Motion::Rest) == Approx(1.5).epsilon(exactly));
  CHECK(limit(Stepping::Leapfrog, Waves::Shear, viscous, Motion::Rest) == Approx(1.5).epsilon(exactly));
  CHECK(limit(Stepping::Usf, Waves::Shear, viscous, Motion::AlongY) == Approx(1).epsilon(exactly));
  CHECK(limit(Stepping::Usl, Waves::Shear, viscous, Motion::Rest) == Approx(2.0 / 7).epsilon(exactly));
  // Longitudinal waves feel 4/3 of the viscosity.
  CHECK(limit(Stepping::Usf, Waves::Longitudinal, viscous, Motion::Rest) == Approx(1.125).epsilon(exactly));
  CHECK(limit(Stepping::Usl, Waves::Longitudinal, viscous, Motion::Rest) ==
        Approx(3.0 / 14).epsilon(exactly));
  CHECK(limit(Stepping::Usf, Waves::Longitudinal, acoustic, Motion::Rest) ==
        Approx(std::sqrt(3)).epsilon(exactly));
  CHECK(limit(Stepping::Usf, Waves::Longitudinal, acoustic, Motion::AlongY) ==
        Approx(std::sqrt(2)).epsilon(exactly));
  CHECK(limit(Stepping::Usl, Waves::Longitudinal, acoustic, Motion::AlongY) ==
        Approx(std::sqrt(4.0 / 7)).epsilon(exactly));
}

TEST_CASE("limits in the plane, at rest and along x, are those of an independent prototype") {
  // The prototype's three digits.
  CHECK(limit(Stepping::Usf, Waves::Plane, viscous, Motion::Rest) == Approx(1.125).epsilon(exactly));
  CHECK(limit(Stepping::Usl, Waves::Plane, viscous, Motion::Rest) == Approx(0.2143).margin(5e-5));
  CHECK(limit(Stepping::Usf, Waves::Plane, viscous, Motion::AlongX) == Approx(0.745).margin(5e-4));
  CHECK(limit(Stepping::Usl, Waves::Plane, viscous, Motion::AlongX) == Approx(0.205).margin(6e-4));
}

TEST_CASE("what the grid loses buys stability, and full mass pays for losing nothing") {
  const auto at = [](Transfer transfer) {
    const auto problem = problem_of(scheme_of(Basis::Linear, transfer, Stepping::Usf), Waves::Shear, viscous);
    return predict_limit(problem, Motion::Rest, 40).multiple.value_or(NAN);
  };
  CHECK(at(Transfer::Apic) == Approx(0.5).epsilon(exactly));        // S = 1: 4 r <= 2
  CHECK(at(Transfer::FullMass) == Approx(0.125).epsilon(exactly));  // 4 r <= 2 (1 - 3/4)
  CHECK(at(Transfer::Pic) > 1);
}

TEST_CASE("viscosity and sound together: stress first is stable where r/r_max + (CFL/CFL_max)^2 <= 1") {
  const Scheme scheme = scheme_of(Basis::Linear, Transfer::Flip, Stepping::Usf);
  const auto problem = problem_of(scheme, Waves::Longitudinal, {0.5, 0.5});
  const double multiple = predict_limit(problem, Motion::Rest, 40).multiple.value_or(NAN);
  const StepSize step = problem.at(multiple);
  CHECK(step.r / 1.125 + step.cfl * step.cfl / 3 == Approx(1).epsilon(1e-4));  // one wave is worst for both
}

TEST_CASE("implicit viscosity has no viscous limit, and the sound limit of its explicit twin") {
  const Basis basis = GENERATE(Basis::Linear, Basis::Cubic);
  const Transfer transfer = GENERATE(Transfer::Flip, Transfer::Apic, Transfer::FullMass);
  const auto limit_of = [&](Stepping stepping, const StepSize& ray) {
    return predict_limit(problem_of(scheme_of(basis, transfer, stepping), Waves::Longitudinal, ray),
                         Motion::AlongY, 40)
        .multiple;
  };
  CHECK_FALSE(limit_of(Stepping::ImplicitEuler, viscous));
  CHECK_FALSE(limit_of(Stepping::ImplicitSdirk2, viscous));
  CHECK(*limit_of(Stepping::ImplicitEuler, acoustic) ==
        Approx(*limit_of(Stepping::Usf, acoustic)).epsilon(exactly));
  CHECK(*limit_of(Stepping::ImplicitSdirk2, acoustic) ==
        Approx(*limit_of(Stepping::Leapfrog, acoustic)).epsilon(exactly));
}

TEST_CASE("below its limit the leapfrog with FLIP keeps every sound wave's amplitude") {
  const Scheme scheme = scheme_of(Basis::Quadratic, Transfer::Flip, Stepping::Leapfrog);
  const double theta = GENERATE(0.3, 1.4, 2.9);
  const BlochSymbols symbols = bloch_symbols(Basis::Quadratic, {{1, 2}}, {0, theta});
  const Eigen::MatrixXcd g = amplification_matrix(scheme, symbols, Waves::Longitudinal, {0, 2.3});
  REQUIRE(g.rows() == 2);
  CHECK(std::abs(g.determinant()) == Approx(1).epsilon(1e-12));
  CHECK(spectral_radius(g) == Approx(1).epsilon(1e-9));
}

TEST_CASE("the spectral radius is the largest modulus of the eigenvalues that a matrix was made of") {
  using namespace std::complex_literals;
  // Unit triangular times diagonal times its inverse: eigenvalues as on the diagonal.
  for (const Eigen::Index n : {1, 2, 3, 4, 6}) {
    Eigen::MatrixXcd base = Eigen::MatrixXcd::Identity(n, n), inverse = base, values = base;
    for (Eigen::Index k = 0; k < n; ++k) values(k, k) = (0.3 + 0.1 * double(k)) * std::exp(1i * double(k));
    for (Eigen::Index k = 0; k + 1 < n; ++k) base(k, k + 1) = 0.5 - 0.25i;
    for (Eigen::Index j = 1; j < n; ++j)
      for (Eigen::Index i = 0; i < j; ++i)
        inverse(i, j) = std::pow(-(0.5 - 0.25i), double(j - i));  // of the two diagonals above
    const Eigen::MatrixXcd matrix = base * values * inverse;
    // Triangular, with no eigenvalue close to another: round-off, some ten times.
    CHECK(spectral_radius(matrix) == Approx(0.3 + 0.1 * double(n - 1)).epsilon(1e-14 * double(n)));
    CHECK(spectral_radius(1i * matrix.transpose()) ==
          Approx(0.3 + 0.1 * double(n - 1)).epsilon(1e-14 * double(n)));
  }
  Eigen::MatrixXcd unknown = Eigen::MatrixXcd::Identity(4, 4);
  unknown(1, 2) = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isinf(spectral_radius(unknown)));
}

TEST_CASE("growth is told by powers as it is by eigenvalues, however near to one they lie") {
  using namespace std::complex_literals;
  constexpr double allowance = 1e-6;
  for (const Eigen::Index n : {1, 2, 3, 6})
    for (const double shear : {0.0, 0.5, 30.0})
      for (const double away : {-0.5, -1e-3, -1e-5, 0.0, 0.9e-6, 1.1e-6, 1e-5, 1e-3, 0.5}) {
        // Triangular: its eigenvalues stand on the diagonal, one of them away from the unit circle.
        Eigen::MatrixXcd matrix = Eigen::MatrixXcd::Zero(n, n);
        for (Eigen::Index k = 0; k < n; ++k) matrix(k, k) = 0.9 * std::exp(1i * double(k));
        for (Eigen::Index k = 0; k + 1 < n; ++k) matrix(k, k + 1) = shear;
        matrix(n / 2, n / 2) *= (1 + away) / 0.9;
        INFO(n << " " << shear << " " << away);
        CHECK(grows(matrix, allowance) == (away > allowance));
        CHECK(grows(matrix.transpose(), allowance) == (away > allowance));
      }
  Eigen::MatrixXcd unknown = Eigen::MatrixXcd::Identity(4, 4);
  unknown(1, 2) = std::numeric_limits<double>::quiet_NaN();
  CHECK(grows(unknown, allowance));
}

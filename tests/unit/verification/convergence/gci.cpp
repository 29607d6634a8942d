#include "verification/convergence/gci.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "tests/catch.hpp"

using namespace verification;

namespace {

using Ladder = std::vector<double>;

/// h = N^(-1/2) of a two-dimensional grid of N cells on a unit area.
double cell_size(double cells) {
  return 1.0 / std::sqrt(cells);
}

Ladder power_law(const Ladder& steps, double limit, double coefficient, double order) {
  Ladder values;
  for (double h : steps) values.push_back(limit + coefficient * std::pow(h, order));
  return values;
}

}  // namespace

TEST_CASE("GCI: Celik et al. (2008), Table 1", "[convergence]") {
  // I. B. Celik, U. Ghia, P. J. Roache, C. J. Freitas, H. Coleman, P. E. Raad, J. Fluids Eng. 130 (2008)
  // 078001, Table 1: backward-facing step. Columns: reattachment length, axial velocity at x/H = 8 (monotone,
  // p < 1), the same elsewhere (oscillatory). Tolerances: half a unit of the last printed digit, but for
  // e_ext of the second column: the table's own phi_ext gives (10.8801 - 10.7880)/10.8801 = 0.847 %, which it
  // prints as 0.9 %.
  struct Column {
    Ladder cells;
    Ladder phi;  // coarse to fine
    Convergence convergence;
    double p, extrapolated, ea, eext, gci, eext_margin;
  };
  const std::vector<Column> table{
      {{4500, 8000, 18000}, {5.863, 5.972, 6.063}, Convergence::Monotone, 1.53, 6.1685, 1.5, 1.7, 2.2, 0.05},
      {{980, 4500, 18000},
       {10.6050, 10.7250, 10.7880},
       Convergence::Monotone,
       0.75,
       10.8801,
       0.6,
       0.9,
       1.1,
       0.06},
      {{980, 4500, 18000},
       {6.0909, 5.9624, 6.0042},
       Convergence::Oscillatory,
       1.51,
       6.0269,
       0.7,
       0.4,
       0.5,
       0.05}};
  for (const Column& c : table) {
    const Ladder steps{cell_size(c.cells[0]), cell_size(c.cells[1]), cell_size(c.cells[2])};
    const GciResult g = grid_convergence_index(steps, c.phi, 2.0, SafetyRule::Celik2008);
    CHECK(g.convergence == c.convergence);
    CHECK(g.observed_order == Approx(c.p).margin(0.005).epsilon(0.0));
    CHECK(g.extrapolated == Approx(c.extrapolated).margin(5e-5).epsilon(0.0));
    CHECK(100.0 * g.relative_error == Approx(c.ea).margin(0.05).epsilon(0.0));
    CHECK(100.0 * g.extrapolated_error == Approx(c.eext).margin(c.eext_margin).epsilon(0.0));
    CHECK(100.0 * g.gci_fine == Approx(c.gci).margin(0.05).epsilon(0.0));
    CHECK(g.safety_factor == 1.25);
    CHECK(g.uncertainty == Approx(g.gci_fine * c.phi[2]).epsilon(1e-13));
  }
}

TEST_CASE("GCI: NPARC Alliance tutorial, 'Examining Spatial (Grid) Convergence'", "[convergence]") {
  // Pressure recovery of a supersonic inlet on normalised spacings 4, 2, 1. Published: p = 1.786170,
  // f_h=0 = 0.971300 (written 0.97130), GCI12 = 0.103083 %, GCI23 = 0.356249 %, ratio about 1 (1.002). The
  // tutorial carries six digits through the calculation; tolerance one unit of the last printed digit.
  const GciResult g =
      grid_convergence_index({4.0, 2.0, 1.0}, {0.96178, 0.96854, 0.97050}, 2.0, SafetyRule::Celik2008);
  CHECK(g.convergence == Convergence::Monotone);
  CHECK(g.observed_order == Approx(1.786170).margin(1e-6).epsilon(0.0));
  CHECK(g.extrapolated == Approx(0.971300).margin(1e-6).epsilon(0.0));
  CHECK(100.0 * g.gci_fine == Approx(0.103083).margin(1e-6).epsilon(0.0));
  CHECK(100.0 * g.gci_coarse == Approx(0.356249).margin(1e-6).epsilon(0.0));
  CHECK(g.asymptotic_ratio == Approx(1.002).margin(5e-4).epsilon(0.0));
  // The ratio test is a tautology: it is phi_1/phi_2.
  CHECK(g.asymptotic_ratio == Approx(0.97050 / 0.96854).epsilon(1e-12));
}

TEST_CASE("GCI: safety factor and order by Oberkampf and Roy", "[convergence]") {
  const Ladder steps{3.0, 1.4, 1.0};
  SECTION("within ten per cent of the formal order") {
    const Ladder phi = power_law(steps, 1.0, 0.1, 1.9);
    const GciResult g = grid_convergence_index(steps, phi, 2.0);
    CHECK(g.observed_order == Approx(1.9).epsilon(1e-10));
    CHECK(g.used_order == 2.0);
    CHECK(g.safety_factor == 1.25);
    CHECK(g.uncertainty == Approx(1.25 * (phi[1] - phi[2]) / (1.4 * 1.4 - 1.0)).epsilon(1e-12));
    CHECK(g.uncertainty_coarse ==
          Approx(1.25 * (phi[0] - phi[1]) / (std::pow(3.0 / 1.4, 2.0) - 1.0)).epsilon(1e-12));
  }
  SECTION("below: the observed order and a factor of three") {
    const Ladder phi = power_law(steps, 1.0, 0.1, 1.5);
    const GciResult g = grid_convergence_index(steps, phi, 2.0);
    CHECK(g.used_order == Approx(1.5).epsilon(1e-10));
    CHECK(g.safety_factor == 3.0);
    CHECK(g.uncertainty == Approx(3.0 * 0.1).epsilon(1e-9));  // the exact error times Fs
  }
  SECTION("far below: not less than one half") {
    CHECK(grid_convergence_index(steps, power_law(steps, 1.0, 0.1, 0.2), 2.0).used_order == 0.5);
  }
  SECTION("above: not more than the formal order") {
    const GciResult g = grid_convergence_index(steps, power_law(steps, 1.0, 0.1, 3.0), 2.0);
    CHECK(g.observed_order == Approx(3.0).epsilon(1e-10));
    CHECK(g.used_order == 2.0);
    CHECK(g.safety_factor == 3.0);
  }
  SECTION("an oscillatory ladder never gets 1.25") {
    // e32 = 4, e21 = -1 with ratio 2: p = 2 = the formal order.
    const GciResult g = grid_convergence_index({4.0, 2.0, 1.0}, {4.0, 0.0, 1.0}, 2.0);
    CHECK(g.convergence == Convergence::Oscillatory);
    CHECK(g.observed_order == Approx(2.0).epsilon(1e-10));
    CHECK(g.safety_factor == 3.0);
    CHECK(g.uncertainty == Approx(1.0).epsilon(1e-10));  // 3 |e21|/(2^2 - 1)
  }
}

TEST_CASE("GCI: exact power laws at non-constant ratios", "[convergence]") {
  const double order = GENERATE(0.8, 1.0, 2.0, 4.0);
  const Ladder steps{1.0, 0.9, 0.4};
  const GciResult g =
      grid_convergence_index(steps, power_law(steps, -3.0, 0.7, order), order, SafetyRule::Celik2008);
  CHECK(g.convergence == Convergence::Monotone);
  CHECK(g.observed_order == Approx(order).epsilon(1e-10));
  CHECK(g.extrapolated == Approx(-3.0).epsilon(1e-10));
  CHECK(g.uncertainty == Approx(1.25 * 0.7 * std::pow(0.4, order)).epsilon(1e-9));
}

TEST_CASE("GCI: absolute values survive a phi of zero", "[convergence]") {
  const GciResult g = grid_convergence_index({4.0, 2.0, 1.0}, {15.0, 3.0, 0.0}, 2.0);  // h^2 - 1
  CHECK(g.extrapolated == Approx(-1.0).epsilon(1e-12));
  CHECK(g.uncertainty == Approx(1.25).epsilon(1e-12));
  CHECK(std::isnan(g.gci_fine));
  CHECK(std::isnan(g.relative_error));
  CHECK(std::isnan(g.asymptotic_ratio));
  CHECK(g.gci_coarse == Approx(5.0 / 3.0).epsilon(1e-12));
}

TEST_CASE("GCI: no uncertainty is claimed without convergence", "[convergence]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Ladder steps{4.0, 2.0, 1.0};
  const auto claims_nothing = [](const GciResult& g) {
    return std::isnan(g.uncertainty) && std::isnan(g.gci_fine) && std::isnan(g.extrapolated) &&
           std::isnan(g.safety_factor) && std::isnan(g.used_order);
  };
  const GciResult divergent = grid_convergence_index(steps, {1.0, 2.0, 4.0}, 2.0);
  CHECK(divergent.convergence == Convergence::Divergent);
  CHECK(divergent.observed_order == Approx(-1.0).epsilon(1e-10));
  CHECK(claims_nothing(divergent));
  const GciResult constant = grid_convergence_index(steps, {1.0, 1.0, 1.0}, 2.0);
  CHECK(constant.convergence == Convergence::Floor);
  CHECK(std::isnan(constant.observed_order));
  CHECK(claims_nothing(constant));
  const GciResult invalid = grid_convergence_index(steps, {1.0, nan, 0.5}, 2.0);
  CHECK(invalid.convergence == Convergence::Invalid);
  CHECK(std::isnan(invalid.observed_order));
  CHECK(claims_nothing(invalid));
}

TEST_CASE("four grids: successive orders agree only in the asymptotic range", "[convergence]") {
  const Ladder uneven{1.0, 0.5, 0.3, 0.15, 0.05};
  const OrderSequence pure = observed_orders(uneven, power_law(uneven, 2.0, 1.0, 2.0));
  REQUIRE(pure.orders.size() == 3);
  CHECK(pure.drift < 1e-10);

  // h + 10 h^2 on halved steps: the differences are 8, 2.125, 0.59375 and 0.1796875. The order is on its way
  // from 2 to 1, while the three-grid ratio of the finest triplet is 1 within a per cent.
  const Ladder steps{1.0, 0.5, 0.25, 0.125, 0.0625};
  Ladder mixed;
  for (double h : steps) mixed.push_back(2.0 + h + 10.0 * h * h);
  const OrderSequence drifting = observed_orders(steps, mixed);
  REQUIRE(drifting.orders.size() == 3);
  CHECK(drifting.orders[0] == Approx(std::log2(8.0 / 2.125)).epsilon(1e-10));
  CHECK(drifting.orders[1] == Approx(std::log2(2.125 / 0.59375)).epsilon(1e-10));
  CHECK(drifting.orders[2] == Approx(std::log2(0.59375 / 0.1796875)).epsilon(1e-10));
  CHECK(drifting.drift ==
        Approx((drifting.orders[1] - drifting.orders[2]) / drifting.orders[2]).epsilon(1e-10));
  CHECK(drifting.drift > 0.05);
  Ladder large = mixed;  // the same error on a larger phi
  for (double& phi : large) phi += 100.0;
  const GciResult finest = grid_convergence_index({steps[2], steps[3], steps[4]},
                                                  {large[2], large[3], large[4]}, 2.0, SafetyRule::Celik2008);
  CHECK(finest.asymptotic_ratio == Approx(1.0).epsilon(0.01));

  const OrderSequence broken = observed_orders(uneven, {5.0, 3.0, 2.0, 1.5, 0.2});
  CHECK(std::isnan(broken.drift));
  // Also if only the coarsest triplet fails and the rest agree.
  Ladder coarse_broken = power_law(uneven, 2.0, 1.0, 2.0);
  coarse_broken[0] = coarse_broken[1];
  const OrderSequence late = observed_orders(uneven, coarse_broken);
  CHECK(std::isnan(late.orders[0]));
  CHECK(late.orders[2] == Approx(2.0).epsilon(1e-10));
  CHECK(std::isnan(late.drift));
}

TEST_CASE("GCI refuses bad arguments", "[convergence]") {
  const Ladder phi{3.0, 2.0, 1.5};
  CHECK_THROWS_WITH(grid_convergence_index({2.0, 1.0}, {2.0, 1.0}, 2.0), contains("at least 3"));
  CHECK_THROWS_WITH(grid_convergence_index({4.0, 3.0, 2.0, 1.0}, {4.0, 3.0, 2.0, 1.0}, 2.0),
                    contains("exactly"));
  CHECK_THROWS_WITH(grid_convergence_index({1.0, 2.0, 4.0}, phi, 2.0), contains("decrease"));
  CHECK_THROWS_WITH(grid_convergence_index({4.0, 2.0, 1.0}, phi, 0.0), contains("formal order"));
  CHECK_THROWS_WITH(observed_orders({4.0, 2.0, 1.0}, phi), contains("at least 4"));
  CHECK_THROWS_WITH(observed_orders({8.0, 4.0, 2.0, 1.0}, phi), contains("one value"));
}

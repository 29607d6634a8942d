#include "verification/convergence/floor_fit.hpp"

#include <cmath>
#include <limits>

#include "tests/catch.hpp"
#include "verification/convergence/order_remark.hpp"

using namespace verification;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The order of errors a h^p + floor on grids that halve from h = 1/8, and its levels.
struct Made {
  reports::OrderRecord order;
  std::vector<reports::LevelRecord> levels;
};

Made made(double p, double floor, int count, double observed, const char* kind = "monotone") {
  Made made;
  made.order.axis = "space";
  made.order.theoretical = 2;
  made.order.observed = observed;
  made.order.classification = kind;
  made.order.levels = made.order.levels_used = count;
  for (int k = 0; k < count; ++k) {
    const double h = std::ldexp(1.0, -3 - k);
    made.levels.push_back({"s", "", "space", "grid", "l2", 1, h, std::pow(h, p) + floor, true});
  }
  return made;
}

std::string remark(const Made& made) {
  return order_remark(made.order, made.levels);
}

}  // namespace

TEST_CASE("coefficient and floor of made errors are found again", "[floor]") {
  const auto fit = fit_floor({0.2, 0.1, 0.05, 0.025},
                             {3 * 0.04 + 1e-3, 3 * 0.01 + 1e-3, 3 * 0.0025 + 1e-3, 3 * 6.25e-4 + 1e-3}, 2);
  REQUIRE(fit);
  CHECK_THAT(fit->coefficient, Catch::Matchers::WithinRel(3.0, 1e-9));
  CHECK_THAT(fit->floor, Catch::Matchers::WithinRel(1e-3, 1e-9));
  CHECK(fit->misfit < 1e-9);
  CHECK_FALSE(fit_floor({0.2, 0.1}, {1, 0.5}, 2));
  CHECK_FALSE(fit_floor({0.2, 0.1, 0.05}, {1, not_a_number, 0.5}, 2));
  CHECK_FALSE(fit_floor({0.2, 0.1, 0.05}, {1, 0, 0.5}, 2));
}

TEST_CASE("an order carries a remark where its number does not say enough", "[floor]") {
  CHECK(remark(made(2, 0, 4, 2.0)).empty());
  CHECK_THAT(remark(made(2, 4e-4, 4, 1.5)), contains("order 2 on a floor of 0.0004"));
  CHECK(remark(made(1, 0, 4, 1.0)).empty());      // first order is no floor
  CHECK(remark(made(2, 1e-6, 4, 1.95)).empty());  // neither is what shows in no digit
  CHECK_THAT(remark(made(0.07, 0, 3, 0.07)), contains("stalled") && contains("p = 0.07"));
  CHECK_THAT(remark(made(2, 0, 2, 2.0)), contains("two levels"));
  CHECK_THAT(remark(made(-1, 0, 3, -1, "divergent")), contains("the ladder is divergent"));
  CHECK(unit_of(made(2, 0, 3, 2).order, 2.0) == "1");
  CHECK(unit_of(made(2, 0, 3, not_a_number, "invalid").order, not_a_number) == "(invalid)");
  CHECK(unit_of(made(2, 0, 3, not_a_number, "floor").order, not_a_number) == "(floor)");
}

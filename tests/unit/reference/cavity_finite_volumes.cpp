#include "reference/cavity/cavity_finite_volumes.hpp"

#include <algorithm>
#include <cmath>

#include "tests/catch.hpp"

using namespace reference;

TEST_CASE("finite volumes of the cavity meet the published table, well within their own uncertainty",
          "[cavity]") {
  const auto lines = cavity_centre_lines([](double) { return 0.01; }, 12);
  const auto table = marchi_2009(100);
  REQUIRE(lines.size() == table.size());
  double squares = 0, uncertain = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const CavityPoint& point = lines[i].point;
    REQUIRE(point.component == table[i].component);
    CHECK(point.x == table[i].x);
    CHECK(point.y == table[i].y);
    squares += std::pow(point.value - table[i].value, 2);
    uncertain += std::pow(lines[i].uncertainty, 2);
  }
  CHECK(std::sqrt(squares / 30) < 1e-3);
  CHECK(squares < uncertain);
}

TEST_CASE("finite volumes of the cavity are of second order where the viscosity varies", "[cavity]") {
  const auto nu = [](double w) { return 0.1 * std::pow(w, 0.25); };
  const CavityFiniteVolumes a(nu, 16), b(nu, 32, &a), c(nu, 64, &b);
  double first = 0, second = 0;
  for (int k = 1; k < 16; ++k) {
    const double y = k / 16.0;
    first += std::pow(b.velocity(0, 0.5, y) - a.velocity(0, 0.5, y), 2);
    second += std::pow(c.velocity(0, 0.5, y) - b.velocity(0, 0.5, y), 2);
  }
  CHECK(0.5 * std::log2(first / second) == Approx(2).margin(0.2));
  // Mass: what crosses a line from wall to wall is nothing.
  double flux = 0;
  for (int j = 0; j < 64; ++j) flux += c.velocity(0, 0.5, (j + 0.5) / 64) / 64;
  CHECK(std::abs(flux) < 1e-9);
}

#include "reference/transient/spectral_line.hpp"

#include <cmath>
#include <numeric>

#include "tests/catch.hpp"

using namespace reference;

TEST_CASE("spectral line: exact for the polynomials it promises") {
  for (int p : {2, 5, 12}) {
    const GaussLobatto gl(p);
    for (int degree = 0; degree < 2 * p; ++degree) {
      double sum = 0.0;
      for (int i = 0; i <= p; ++i) sum += gl.weights[i] * std::pow(gl.nodes[i], degree);
      CHECK(std::abs(sum - (degree % 2 == 0 ? 2.0 / (degree + 1) : 0.0)) < 1e-14);
    }
    const SpectralLine line({0.3, 0.7, 1.5}, p);
    CHECK(line.size() == 3 * p + 1);
    CHECK(line.length() == Approx(2.5).epsilon(1e-15));
    CHECK(std::accumulate(line.mass().begin(), line.mass().end(), 0.0) == Approx(2.5).epsilon(1e-14));
    // x^p on every element: value, derivative and running integral.
    for (double s : {0.0, 0.1, 0.3, 0.6, 1.7, 2.5}) {
      const auto [e, xi] = line.locate(s);
      std::vector<double> values;
      for (int a = 0; a <= p; ++a) values.push_back(std::pow(line.nodes()[e * p + a], p));
      const double left = line.nodes()[e * p], scale = std::pow(2.5, p + 1);
      CHECK(std::abs(line.interpolate(values.data(), xi) - std::pow(s, p)) < 1e-14 * scale);
      CHECK(std::abs(line.integrate(values.data(), xi, line.element_size(e)) -
                     (std::pow(s, p + 1) - std::pow(left, p + 1)) / (p + 1)) < 1e-14 * scale);
      for (int a = 0; a <= p; ++a) {
        double slope = 0.0;
        for (int b = 0; b <= p; ++b) slope += gl.derivative[a * (p + 1) + b] * values[b];
        CHECK(std::abs(slope * 2 / line.element_size(e) - p * std::pow(line.nodes()[e * p + a], p - 1)) <
              1e-13 * p * p * scale);  // differentiation multiplies round-off by p^2
      }
    }
  }
}

TEST_CASE("spectral line: graded sizes fill the line and grow from the smallest") {
  const std::vector<double> sizes = graded_sizes(1.0, 1e-8, 0.1, 2.0);
  CHECK(std::accumulate(sizes.begin(), sizes.end(), 0.0) == Approx(1.0).epsilon(1e-14));
  CHECK(sizes.front() <= 1e-8);
  CHECK(sizes.front() > 0.9e-8);  // stretched by no more than one element in ten
  for (std::size_t i = 1; i < sizes.size(); ++i) CHECK(sizes[i] <= 2.0 * sizes[i - 1] * (1 + 1e-14));
  CHECK(*std::max_element(sizes.begin(), sizes.end()) <= 0.1);
  CHECK_THROWS_AS(SpectralLine({1.0}, 1), std::invalid_argument);
  CHECK_THROWS_AS(SpectralLine({1.0, 0.0}, 4), std::invalid_argument);
}

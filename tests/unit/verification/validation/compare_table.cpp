#include "verification/validation/compare_table.hpp"

#include <cmath>

#include "tests/catch.hpp"
#include "verification/config/config_error.hpp"

using namespace verification;

namespace {

/// Samples of u = F/(2 nu) y (1 - y) + error at t = 1 on `cells` cells of a channel of height and F of 1, and
/// v = x^3 on three lines x.
std::vector<reports::ProfileRow> channel(int cells, double nu, double error = 0) {
  std::vector<reports::ProfileRow> rows;
  for (int j = 0; j <= cells; ++j)
    for (const double x : {0.0, 0.5, 1.0, 1.5}) {
      const double y = static_cast<double>(j) / cells;
      rows.push_back({1, "grid", x, y, (0.5 / nu + error) * y * (1 - y), x * x * x, NAN, NAN});
    }
  return rows;
}

Measurement row(const std::string& quantity, double y, double value, double uncertainty) {
  return {quantity, 1, NAN, y, value, uncertainty, 0, "m/s", "", 7};
}

MeasurementTable table(std::vector<Measurement> rows) {
  MeasurementTable table;
  table.file = "data.csv";
  table.rows = std::move(rows);
  return table;
}

}  // namespace

TEST_CASE("Quantities between samples: cubic, exact for a cubic field", "[validation]") {
  const auto samples = channel(5, 1);
  const RunFiles run{&samples, nullptr, nullptr};
  const auto of = [&](const char* name, double x, double y) {
    return find_validated_quantity(name)->of(run, {1, x, y});
  };
  CHECK(of("u", NAN, 0.33) == Approx(0.5 * 0.33 * 0.67).epsilon(1e-13));
  CHECK(of("v", 0.7, 0.33) == Approx(0.343).epsilon(1e-13));
  CHECK(of("flow-rate", NAN, NAN) == Approx(1.0 / 12).epsilon(1e-13));
  CHECK(of("mean-velocity", NAN, NAN) == Approx(1.0 / 12).epsilon(1e-13));
  CHECK(of("wall-shear-rate", NAN, NAN) == Approx(0.5).epsilon(1e-13));
  CHECK_THROWS_WITH(of("u", NAN, 1.01), contains("nothing is extrapolated"));
  CHECK_THROWS_WITH(find_validated_quantity("u")->of(run, {2, NAN, 0.5}), contains("no output time"));
  CHECK_THROWS_WITH(of("u", NAN, -0.01),
                    contains("y = -0.01 m lies outside of the run's samples (0 to 1 m)"));
  CHECK_THROWS_WITH(of("v", 1.6, 0.5), contains("x = 1.6 m lies outside of the run's samples (0 to 1.5 m)"));
  CHECK_THROWS_WITH(find_validated_quantity("probe")->of(run, {1, NAN, NAN}), contains("no history"));
  CHECK(find_validated_quantity("front-page") == nullptr);
}

TEST_CASE("A table beside a ladder: the three parts of u_val, the verdict, the joint distance",
          "[validation]") {
  // Second-order errors of 0.4 h^2 in the factor of u; nu known to 1 %.
  std::vector<std::vector<reports::ProfileRow>> levels;
  ComparedRuns runs;
  for (const int cells : {4, 8, 16, 32}) {
    levels.push_back(channel(cells, 1, 0.4 / cells / cells));
    runs.steps.push_back(1.0 / cells);
  }
  for (const auto& level : levels) runs.levels.push_back({&level, nullptr});
  const auto minus = channel(8, 0.99), plus = channel(8, 1.01);
  runs.sensitivities.emplace_back(RunFiles{&minus, nullptr, nullptr}, RunFiles{&plus, nullptr, nullptr});
  ComparisonRules rules;
  rules.bears["u"] = {0.01, "test"};

  const auto compared = compare_table(table({row("u", 0.5, 0.126, 1e-3), row("u", 0.25, 0.2, 1e-3)}), runs,
                                      rules, Missing::Refuse);
  REQUIRE(compared.points.size() == 2);
  const reports::ValidationRecord& near = compared.points[0];
  CHECK(near.u_input == Approx(0.125 * 0.01).epsilon(1e-3));
  // Eca-Hoekstra: Fs = 1.25 times the error left on the finest grid, over 2.
  CHECK(near.u_num == Approx(0.5 * 1.25 * 0.1 / 1024).epsilon(1e-3));
  CHECK(near.u_val == Approx(std::hypot(near.u_num, near.u_input, 1e-3)));
  CHECK(near.verdict == "agrees within u_val");
  CHECK(near.borne);
  const reports::ValidationRecord& far = compared.points[1];  // 0.094 simulated, 0.2 measured
  CHECK(far.verdict == "model error");
  CHECK_FALSE(far.borne);
  REQUIRE(compared.joint.size() == 1);
  CHECK(compared.joint[0].points == 2);
  CHECK(compared.joint[0].p_value < 1e-6);

  rules.bears["u"].largest = 1e-3;  // less than the noise
  const auto noisy = compare_table(table({row("u", 0.5, 0.126, 1e-3)}), runs, rules, Missing::Refuse);
  CHECK(noisy.points[0].verdict == "inconclusive");
  CHECK_FALSE(noisy.points[0].borne);

  runs.levels.resize(2);  // two levels say nothing of u_num
  runs.steps.resize(2);
  rules.bears["u"].largest = 1;
  const auto unknown = compare_table(table({row("u", 0.5, 0.126, 1e-3)}), runs, rules, Missing::Refuse);
  CHECK(std::isnan(unknown.points[0].u_num));
  CHECK(unknown.points[0].verdict == "inconclusive");
  CHECK_FALSE(unknown.points[0].borne);
}

TEST_CASE("A right model agrees, one with a viscosity 5 % off is seen", "[validation]") {
  const auto right = channel(16, 1), wrong = channel(16, 1.05);
  ComparisonRules rules;
  rules.bears["u"] = {2.5e-3, "2 % of the largest velocity"};
  rules.stated_u_num = 1e-4;
  rules.stated_u_input = 2e-3;
  std::vector<Measurement> rows;
  for (int j = 1; j < 10; ++j) rows.push_back(row("u", 0.1 * j, 0.05 * j * (1 - 0.1 * j), 5e-4));
  const auto judged = [&](const std::vector<reports::ProfileRow>& samples) {
    ComparedRuns runs;
    runs.levels = {{&samples, nullptr}};
    return compare_table(table(rows), runs, rules, Missing::Refuse);
  };
  for (const auto& point : judged(right).points) CHECK(point.verdict == "agrees within u_val");
  const auto off = judged(wrong);
  CHECK(off.joint[0].p_value < 1e-6);
  CHECK(off.joint[0].bias == Approx(1 / 1.05).epsilon(1e-3));
  CHECK(off.points[4].verdict == "model error");  // 6e-3 against 1.1e-3
  CHECK_FALSE(off.points[4].borne);
}

TEST_CASE("Samples of the inputs carry their correlation into the joint distance", "[validation]") {
  std::vector<std::vector<reports::ProfileRow>> samples;
  for (const double nu : {0.98, 0.99, 1.0, 1.01, 1.02}) samples.push_back(channel(8, nu));
  ComparedRuns runs;
  const auto right = channel(16, 1);
  runs.levels = {{&right, nullptr}};
  for (const auto& sample : samples) runs.samples.push_back({&sample, nullptr});
  ComparisonRules rules;
  rules.bears["u"] = {0.1, "test"};
  rules.stated_u_num = 0;
  // Both values 3 % high, as a viscosity off by two of its deviations makes them: one surprise of two sigma.
  const auto compared = compare_table(table({row("u", 0.5, 0.12125, 1e-5), row("u", 0.25, 0.0909375, 1e-5)}),
                                      runs, rules, Missing::Refuse);
  const double deviation = 0.125 * std::sqrt(2.5e-4);
  CHECK(compared.points[0].u_input == Approx(deviation).epsilon(1e-2));
  CHECK(compared.joint[0].distance_squared == Approx(std::pow(0.00375 / deviation, 2)).epsilon(0.02));
}

TEST_CASE("What a run cannot deliver is refused, or recorded as inconclusive", "[validation]") {
  const auto samples = channel(8, 1);
  ComparedRuns runs;
  runs.levels = {{&samples, nullptr}};
  ComparisonRules rules;
  rules.bears["u"] = {0.1, "test"};
  rules.stated_u_num = 0;
  const auto outside = table({row("u", 2.0, 0.1, 1e-3)});
  CHECK_THROWS_WITH(compare_table(outside, runs, rules, Missing::Refuse),
                    contains("data.csv:7") && contains("nothing is extrapolated"));
  const auto recorded = compare_table(outside, runs, rules, Missing::Record);
  CHECK(recorded.points[0].verdict == "inconclusive");
  CHECK_FALSE(recorded.points[0].borne);
  CHECK_THAT(recorded.points[0].note, contains("nothing is extrapolated"));
}

#include "reports/compare/compare.hpp"

#include <limits>

#include "reports/files/io_error.hpp"
#include "tests/catch.hpp"
#include "tests/scratch_directory.hpp"

using namespace reports;

namespace {

/// Verdict on the only change of two small files of the same name; Same if there is none.
Verdict verdict_on(const std::string& before, const std::string& after, double tolerance = 1e-9) {
  const ScratchDirectory scratch;
  const auto result =
      compare_results(scratch.write("a.csv", before), scratch.write("b.csv", after), {tolerance});
  REQUIRE(result.size() == 1);
  if (result.front().changes.empty()) return Verdict::Same;
  REQUIRE(result.front().changes.size() == 1);
  return result.front().changes.front().verdict;
}

std::string errors_with(const std::string& l2) {
  return "run,t,location,l1,l2,linf\nr,0.1,grid,0.5," + l2 + ",0.5\n";
}
std::string order_with(const std::string& observed, const std::string& theoretical = "2") {
  return "study,variant,axis,location,norm,t,theoretical,observed,classification\ns,v,space,grid,l2,0.1," +
         theoretical + "," + observed + ",monotone\n";
}
std::string timing_with(const std::string& wall, const std::string& spread) {
  return "run,wall_s,particle_steps_per_s,repetitions,spread,source\nr," + wall + ",1,5," + spread +
         ",measured\n";
}
std::string bench_with(const std::string& value, const std::string& unit,
                       const std::string& spread = "0.01") {
  return "benchmark,quantity,value,unit,spread\nstep,speed," + value + "," + unit + "," + spread + "\n";
}
std::string check_with(const std::string& observed, const std::string& verdict) {
  return "study,check,observed,lower,upper,unit,verdict,reason\ns,c," + observed + ",0,1,1," + verdict +
         ",r\n";
}

}  // namespace

TEST_CASE("errors: worse beyond round-off, NaN worst of all") {
  CHECK(verdict_on(errors_with("1e-3"), errors_with("1e-3")) == Verdict::Same);
  CHECK(verdict_on(errors_with("1e-3"), errors_with("1.0000000001e-3")) == Verdict::Same);
  CHECK(verdict_on(errors_with("1e-3"), errors_with("1.00000001e-3")) == Verdict::Worse);
  CHECK(verdict_on(errors_with("1e-3"), errors_with("1.00000001e-3"), 1e-6) == Verdict::Same);
  CHECK(verdict_on(errors_with("1e-3"), errors_with("9e-4")) == Verdict::Better);
  CHECK(verdict_on(errors_with("1e-15"), errors_with("9e-15")) == Verdict::Same);  // below the floor
  CHECK(verdict_on(errors_with("1e-3"), errors_with("nan")) == Verdict::Worse);
  CHECK(verdict_on(errors_with("nan"), errors_with("1e-3")) == Verdict::Better);
  CHECK(verdict_on(errors_with("nan"), errors_with("nan")) == Verdict::Same);
  CHECK(verdict_on(errors_with("1e-3"), errors_with("inf")) == Verdict::Worse);
}

TEST_CASE("orders: further from theory on either side is worse") {
  CHECK(verdict_on(order_with("2.01"), order_with("2.02")) == Verdict::Worse);
  CHECK(verdict_on(order_with("2.01"), order_with("1.98")) == Verdict::Worse);
  CHECK(verdict_on(order_with("2.02"), order_with("1.99")) == Verdict::Better);
  CHECK(verdict_on(order_with("2.01"), order_with("1.99")) == Verdict::Changed);  // as far, to round-off
  CHECK(verdict_on(order_with("1.5", "nan"), order_with("1.1", "nan")) == Verdict::Changed);
  CHECK(verdict_on(order_with("2.01"), order_with("nan")) == Verdict::Worse);
}

TEST_CASE("times: beyond three spreads of both and five percent") {
  CHECK(verdict_on(timing_with("1", "0.001"), timing_with("1.04", "0.001")) == Verdict::Same);
  CHECK(verdict_on(timing_with("1", "0.001"), timing_with("1.06", "0.001")) == Verdict::Worse);
  CHECK(verdict_on(timing_with("1", "0.001"), timing_with("0.9", "0.001")) == Verdict::Better);
  // 3 sqrt(0.03^2 + 0.04^2) = 0.15
  CHECK(verdict_on(timing_with("1", "0.03"), timing_with("1.14", "0.04")) == Verdict::Same);
  CHECK(verdict_on(timing_with("1", "0.03"), timing_with("1.16", "0.04")) == Verdict::Worse);
  CHECK(verdict_on(timing_with("1", "nan"), timing_with("9", "0.01")) == Verdict::Changed);
  // files of earlier versions know no spread
  CHECK(verdict_on("run,wall_s,particle_steps_per_s\nr,1,1\n", timing_with("9", "0.01")) == Verdict::Changed);
}

TEST_CASE("times measured once are counted, not listed unless all is asked for") {
  const ScratchDirectory scratch;
  const auto result = compare_results(scratch.write("a.csv", timing_with("1", "nan")),
                                      scratch.write("b.csv", timing_with("9", "nan")), {});
  CHECK_THAT(comparison_text(result, false, false), contains("1 measured once: their noise is not known"));
  CHECK(comparison_text(result, false, false).find("r, wall time") == std::string::npos);
  CHECK_THAT(comparison_text(result, true, false), contains("r, wall time: 1 s -> 9 s (x 9)"));
}

TEST_CASE("benchmarks: the unit says which way is better") {
  CHECK(verdict_on(bench_with("100", "particle-steps/s"), bench_with("90", "particle-steps/s")) ==
        Verdict::Worse);
  CHECK(verdict_on(bench_with("100", "1/s"), bench_with("120", "1/s")) == Verdict::Better);
  CHECK(verdict_on(bench_with("100", "ns"), bench_with("120", "ns")) == Verdict::Worse);
  CHECK(verdict_on(bench_with("100", "MB"), bench_with("104", "MB")) == Verdict::Same);
  CHECK(verdict_on(bench_with("100", "furlongs"), bench_with("120", "furlongs")) == Verdict::Changed);
  CHECK(verdict_on(bench_with("100", "ns", "0.1"), bench_with("120", "ns", "0.1")) == Verdict::Same);
}

TEST_CASE("checks: red is worse, whether it was green or was not there") {
  CHECK(verdict_on(check_with("0.5", "pass"), check_with("2", "fail")) == Verdict::Worse);
  CHECK(verdict_on(check_with("2", "fail"), check_with("0.5", "pass")) == Verdict::Better);
  CHECK(verdict_on(check_with("0.5", "pass"), check_with("0.6", "pass")) == Verdict::Same);
  CHECK(verdict_on(check_with("0.5", "pass"), check_with("nan", "pass")) == Verdict::Worse);
  const std::string none = "study,check,observed,lower,upper,unit,verdict,reason\n";
  CHECK(verdict_on(none, check_with("0.5", "pass")) == Verdict::New);
  CHECK(verdict_on(none, check_with("2", "fail")) == Verdict::Worse);
  CHECK(verdict_on(check_with("0.5", "pass"), none) == Verdict::Missing);
}

TEST_CASE("what has gone is a regression, and two kinds of file are no pair") {
  const ScratchDirectory scratch;
  const std::string header = "study,check,observed,lower,upper,unit,verdict,reason\n";
  const auto result =
      compare_results(scratch.write("a.csv", check_with("0.5", "pass")), scratch.write("b.csv", header), {});
  CHECK(result.front().regressed());
  CHECK_THAT(comparison_text(result, false, false),
             contains("1 regressions, 1 of them numbers that have gone"));
  CHECK_THROWS_WITH(compare_results(scratch.path() / "a.csv", scratch.write("e.csv", errors_with("1")), {}),
                    contains("compare two files of the same kind"));
}

TEST_CASE("a run that no longer completes is worse; the text says so") {
  const ScratchDirectory scratch;
  const auto result =
      compare_results(scratch.write("a.csv", "run,status\nr,completed\nq,completed\n"),
                      scratch.write("b.csv", "run,status\nr,diverged at t = 1 s\nq,completed\n"), {});
  const std::string text = comparison_text(result, false, false);
  CHECK_THAT(text, contains("WORSE   r, completed: yes -> no"));
  CHECK_THAT(text, contains("1 same, 1 WORSE"));
  CHECK_THAT(text, contains("1 regressions"));
}

TEST_CASE("what cannot be compared is refused by name") {
  const ScratchDirectory scratch;
  const auto other = scratch.write("other.csv", "a,b\n1,2\n"),
             good = scratch.write("e.csv", errors_with("1"));
  std::filesystem::create_directory(scratch.path() / "empty");
  CHECK_THROWS_WITH(compare_results(other, good, {}), contains("other.csv"));
  CHECK_THROWS_WITH(compare_results(scratch.path() / "empty", good, {}), contains("two result directories"));
  CHECK_THROWS_WITH(compare_results(scratch.path() / "empty", scratch.path() / "empty", {}),
                    contains("no result files"));
  CHECK_THROWS_WITH(compare_results(scratch.path() / "absent.csv", good, {}), contains("absent.csv"));
}

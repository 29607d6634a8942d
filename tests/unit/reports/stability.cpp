#include "reports/pages/sections/stability.hpp"

#include <cmath>
#include <limits>

#include "reports/figures/figures.hpp"
#include "reports/records/directory/result_files.hpp"
#include "tests/catch.hpp"
#include "tests/scratch_directory.hpp"
#include "tests/unit/reports/sample.hpp"

using namespace reports;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

StabilityRecord limit(const std::string& stepping, const std::string& motion, double r, double cfl) {
  StabilityRecord record;
  record.study = "limits";
  record.basis = "linear";
  record.transfer = "flip";
  record.stepping = stepping;
  record.waves = "longitudinal";
  record.motion = motion;
  record.lattice = "1 x 2 even";
  record.kind = "measured";
  record.r_predicted = r;
  record.cfl_predicted = cfl;
  record.r_measured = 1.01 * r;
  record.cfl_measured = 1.01 * cfl;
  record.r_tested = cfl > 0 && r == 0 ? 0 : 40;
  record.cfl_tested = cfl > 0 ? 40 : 0;
  record.theta_y = 1.91;
  record.steps = 600;
  record.crossing = motion == "streaming" ? "stable" : "";
  return record;
}

Results limits() {
  Results results;
  results.stability = {limit("usf", "rest", 1.12, 0), limit("usf", "streaming", 0, 1.4142),
                       limit("usf", "rest", 0.8525, 0.8525), limit("implicit-euler", "rest", nan, 0)};
  results.stability[3].cfl_predicted = results.stability[3].cfl_measured = nan;
  StabilityRecord boundary = limit("usf", "rest", 1.0, 0.5);
  boundary.kind = "boundary";
  boundary.r_measured = boundary.cfl_measured = nan;
  results.stability.push_back(boundary);
  return results;
}

}  // namespace

TEST_CASE("stability limits survive writing and reading", "[reports]") {
  const ScratchDirectory dir;
  const Results written = limits();
  write_results(dir.path(), written);
  const Results read = read_results(dir.path());
  REQUIRE(read.stability.size() == written.stability.size());
  for (std::size_t i = 0; i < read.stability.size(); ++i) {
    const StabilityRecord &a = read.stability[i], &b = written.stability[i];
    CHECK(a.stepping == b.stepping);
    CHECK(a.crossing == b.crossing);
    CHECK(a.steps == b.steps);
    CHECK(a.theta_y == b.theta_y);
    CHECK((a.r_predicted == b.r_predicted || (std::isnan(a.r_predicted) && std::isnan(b.r_predicted))));
    CHECK(a.cfl_tested == b.cfl_tested);
  }
}

TEST_CASE("the table of limits says what was measured and what theory gives", "[reports]") {
  const std::string page = html_stability(limits().stability), text = markdown_stability(limits().stability);
  CHECK_THAT(page, contains("<b>1.1312</b>"));  // 1.01 times 1.12
  CHECK_THAT(page, contains("theory 1.1200"));
  CHECK_THAT(page, contains("<b>0.8610; 0.8610</b>"));
  CHECK_THAT(page, contains("theory none"));
  CHECK_THAT(page, contains("not run"));
  CHECK_THAT(text, contains(" 1.4283 (1.4142) |"));
  CHECK_THAT(text, contains(" none (none) |"));
  CHECK(html_stability({}).empty());
  CHECK(markdown_stability({}).empty());
}

TEST_CASE("a stability map draws boundaries as lines and measurements as points", "[reports]") {
  FigureRecord record;
  record.figure = "map";
  record.study = "limits";
  record.kind = "stability-map";
  record.title = "A claim";
  record.runs = "linear_flip_usf;linear_flip_implicit-euler";
  record.across = "longitudinal";
  record.location = "rest;streaming";
  const Figure figure = build_figure("", record, limits());
  CHECK_THAT(figure.script, contains("1 0.5\n"));            // boundary
  CHECK_THAT(figure.script, contains("0.861025 0.861025"));  // measured
  CHECK_THAT(figure.script, contains("linear flip usf, rest"));
  record.across = "plane";
  CHECK(build_figure("", record, limits()).script.empty());
}

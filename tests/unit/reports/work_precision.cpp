#include "reports/summaries/work_precision.hpp"

#include <cmath>
#include <limits>

#include "reports/figures/figures.hpp"
#include "reports/files/csv.hpp"
#include "tests/catch.hpp"

using namespace reports;

namespace {

/// Four timed runs of one flow: a coarse and a fine one of two schemes, and one that diverged.
Results timed_results() {
  Results r;
  r.studies = {{"w", "W", "claim", "full"}};
  const auto add = [&](const std::string& run, const char* basis, long cells, long steps, double wall,
                       double early, double late, const char* status) {
    r.runs.push_back(
        {run, "w", "poiseuille", "newtonian", basis, "flip", "usf", cells, 2 * cells, 0.1, steps, status});
    r.errors.push_back({run, 0.1, "grid", early, early, early});
    r.errors.push_back({run, 1.0, "grid", late, late, late});
    r.timings.push_back({run, wall, 1, 3, 0.01, timing_measured});
  };
  add("a1", "linear", 10, 100, 1.0, 8e-3, 2e-3, "completed");
  add("a2", "linear", 20, 400, 8.0, 2e-3, 5e-4, "completed");
  add("b1", "cubic", 10, 100, 2.0, 5e-4, 1e-5, "completed");
  add("b2", "cubic", 20, 400, 9.0, 5e-6, 1e-7, "completed");
  add("c", "quadratic", 10, 50, 0.1, 1e-9, 1e-9, "diverged at t = 0.2 s: why");
  return r;
}

}  // namespace

TEST_CASE("the cheapest way counts the worst time, and completed runs only") {
  const Results r = timed_results();
  const auto tables = cheapest_runs(r);
  REQUIRE(tables.size() == 1);
  REQUIRE(tables[0].runs.size() == 5);
  CHECK(tables[0].runs[0].run->run == "a1");  // 8e-3 <= 1e-2
  CHECK(tables[0].runs[1].run->run == "b1");  // 5e-4 <= 1e-3 for 2 s
  CHECK(tables[0].runs[2].run->run == "b2");  // 5e-6 <= 1e-4
  CHECK(tables[0].runs[3].run->run == "b2");
  CHECK(tables[0].runs[4].run == nullptr);  // nothing reaches 1e-6 at all times
  CHECK(tables[0].runs[1].wall == 2.0);
  CHECK(tables[0].runs[1].particle_steps == 2000);
  CHECK_THAT(markdown_cheapest(r),
             contains("2 s: cubic, flip, usf, 10 cells, dt 0.1 s, 2e+03 particle-steps"));
  CHECK_THAT(html_cheapest(r), contains("id=\"cheapest\""));
}

TEST_CASE("runs timed once, beside others, are in no table of costs") {
  Results r = timed_results();
  for (TimingRecord& timing : r.timings) timing.repetitions = 1;
  CHECK(cheapest_runs(r).empty());
  CHECK(html_cheapest(r).empty());
  CHECK(markdown_cheapest(r).empty());
}

TEST_CASE("another solver has a row of its own, with who measured its time, where its study times ours") {
  Results r = timed_results();
  const auto add = [&](const std::string& run, const std::string& study, double wall, const char* clock) {
    r.runs.push_back({run, study, "poiseuille", "newtonian", foreign_scheme, foreign_scheme, foreign_scheme,
                      64, unknown_count, 0.1, unknown_count, "completed"});
    r.runs.back().method = "OpenFOAM 1912";
    r.errors.push_back({run, 1.0, "grid", 5e-3, 5e-3, 5e-3});
    r.timings.push_back({run, wall, 1, 1, std::nan(""), timing_measured, clock});
  };
  add("theirs", "w", 0.5, clock_solver);
  add("beside-others", "elsewhere", 0.1, clock_process);  // of a study whose runs share the machine
  const auto tables = cheapest_runs(r);
  REQUIRE(tables.size() == 2);
  CHECK(tables[0].runs[0].run->run == "a1");  // ours stands as before, though theirs is faster
  CHECK(tables[1].solver == "OpenFOAM 1912");
  CHECK(tables[1].runs[0].run->run == "theirs");
  CHECK(tables[1].runs[1].run == nullptr);
  CHECK_THAT(markdown_cheapest(r),
             contains("| poiseuille, newtonian, OpenFOAM 1912 | 0.5 s: 64 cells, dt 0.1 s; "
                      "time as the solver says itself | - |"));
  for (TimingRecord& timing : r.timings) timing.clock = clock_process;
  CHECK_THAT(markdown_cheapest(r), contains("time of its whole process"));
}

TEST_CASE("errors of a run: one time, the largest, and none for what did not complete") {
  const Results r = timed_results();
  const double all = std::numeric_limits<double>::quiet_NaN();
  CHECK(error_of(r.runs[0], r, "grid", "l2", 1.0) == 2e-3);
  CHECK(error_of(r.runs[0], r, "grid", "l2", all) == 8e-3);
  CHECK(std::isnan(error_of(r.runs[0], r, "particles", "l2", all)));
  CHECK(std::isnan(error_of(r.runs[4], r, "grid", "l2", all)));
}

TEST_CASE("the front holds what no other run beats in both cost and error") {
  const Results r = timed_results();
  std::vector<CostPoint> points;
  for (std::size_t i = 0; i < r.runs.size(); ++i)
    points.push_back({&r.runs[i], r.timings[i].wall_s, 100.0 * static_cast<double>(i),
                      error_of(r.runs[i], r, "grid", "l2", 0.1)});
  const auto front = best_front(points, true);
  REQUIRE(front.size() == 3);
  CHECK(front[0].run->run == "a1");
  CHECK(front[1].run->run == "b1");
  CHECK(front[2].run->run == "b2");
}

TEST_CASE("the diagram has a panel a time and one for the largest, and crosses for failed runs") {
  const Results r = timed_results();
  FigureRecord record;
  record.figure = "w-cost";
  record.study = "w";
  record.kind = "work-precision";
  record.location = "grid";
  record.norm = "l2";
  const Figure wall = work_precision_figure(record, r);
  for (const char* part : {"t = 0.1 s", "t = 1 s", "largest of all output times", "front of the best",
                           "set multiplot layout 1,3", "wall time of a run [s]", "failed: diverged"})
    CHECK_THAT(wall.script, contains(part));
  CHECK_THAT(wall.caption, contains("fastest of up to 3 repetitions"));
  record.across = "particle-steps";
  CHECK_THAT(work_precision_figure(record, r).script, contains("particle-steps [-]"));
}

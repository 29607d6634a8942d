#include <cmath>
#include <limits>

#include "reports/figures/figures.hpp"
#include "reports/files/io_error.hpp"
#include "reports/records/directory/run_files.hpp"
#include "tests/catch.hpp"
#include "tests/scratch_directory.hpp"

using namespace reports;

namespace {

/// Two meshes by three regularisations, errors 1/(m cells), and a path.
Results plane() {
  Results results;
  const auto add = [&](long cells, double m, const std::string& name) {
    RunRecord run;
    run.run = name;
    run.study = "s";
    run.cells = cells;
    run.status = "completed";
    results.runs.push_back(run);
    ErrorRecord error;
    error.run = name;
    error.location = "grid";
    error.l1 = error.linf = 1;
    error.l2 = 1 / (m * static_cast<double>(cells));
    results.errors.push_back(error);
  };
  for (const long cells : {10, 40})
    for (const int m : {10, 100, 1000}) add(cells, m, "r" + std::to_string(cells) + "-" + std::to_string(m));
  add(10, 50, "p10");
  add(40, 800, "p40");
  return results;
}

FigureRecord plane_record() {
  FigureRecord record;
  record.figure = "plane";
  record.study = "s";
  record.kind = "regularisation";
  record.title = "A claim";
  record.labels = "10;100;1000;10;100;1000;50;800";
  record.across = "p10;p40";
  record.location = "grid";
  record.norm = "l2";
  return record;
}

}  // namespace

TEST_CASE("the plane of mesh and regularisation is coloured by error, and the path lies in it", "[reports]") {
  const Figure figure = build_figure("", plane_record(), plane());
  // Errors from 1/40000 to 1/100.
  CHECK_THAT(figure.script, contains("2e-05 to 5e-05"));
  CHECK_THAT(figure.script, contains("5e-03 to 1e-02"));
  CHECK_THAT(figure.script, !contains("1e-02 to 2e-02"));
  CHECK_THAT(figure.script, !contains("1e-05 to 2e-05"));
  CHECK_THAT(figure.script, contains("10 50\n40 800\n"));  // the path
  CHECK_THAT(figure.caption, contains("from 0.002 to 3.1e-05"));
  FigureRecord record = plane_record();
  record.norm = "linf";  // one everywhere: one colour
  CHECK_THAT(build_figure("", record, plane()).script, contains("1e+00 to 2e+00"));
}

TEST_CASE("a pair of mesh and regularisation that failed leaves a hole in the plane", "[reports]") {
  Results results = plane();
  for (ErrorRecord& error : results.errors)
    if (error.run == "r40-1000") error.l2 = std::numeric_limits<double>::quiet_NaN();
  const Figure figure = build_figure("", plane_record(), results);
  CHECK_THAT(figure.script, !contains("2e-05 to 5e-05"));
  CHECK_THAT(figure.script, contains("5e-03 to 1e-02"));
}

TEST_CASE("the map of a cavity is grey where shear rates are below the yielding one", "[reports]") {
  const ScratchDirectory dir;
  std::filesystem::create_directories(dir / "profiles");
  // u = y^2/2: the shear rate is y, and the stream function y^3/6.
  std::vector<ProfileRow> rows;
  for (int j = 0; j <= 4; ++j)
    for (int i = 0; i <= 4; ++i) rows.push_back({1.0, "grid", i / 4.0, j / 4.0, j * j / 32.0, 0, 0, 0});
  rows.push_back({1.0, "particles", 0.3, 0.3, 5, 5, 0, 0});
  write_profile(dir.path(), "r", rows);
  Results results;
  RunRecord run;
  run.run = "r";
  run.study = "s";
  run.status = "completed";
  results.runs = {run};
  FigureRecord record;
  record.figure = "map";
  record.study = "s";
  record.kind = "yielded";
  record.title = "A claim";
  record.runs = "r";
  record.labels = "Bn = 1";
  record.component = "0.5";
  record.location = "grid";
  record.t = 1;
  const Figure figure = build_figure(dir.path(), record, results);
  // Rates at the middles of the four rows: 1/8, 3/8, 5/8, 7/8.
  CHECK_THAT(figure.script, contains("0 0\n1 0\n1 0.25\n0 0.25\n"));
  CHECK_THAT(figure.script, contains("0 0.25\n1 0.25\n1 0.5\n0 0.5\n"));
  CHECK_THAT(figure.script, !contains("1 0.75\n0 0.75\n"));
  CHECK_THAT(figure.script, contains("Bn = 1"));
  CHECK_THAT(figure.script, contains("stream lines"));
  record.t = 2;
  CHECK_THROWS_AS(build_figure(dir.path(), record, results), IoError);
}

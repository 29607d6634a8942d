#include <fmt/format.h>
#include <sys/resource.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <limits>

#include "reports/files/atomic_file.hpp"
#include "reports/files/io_error.hpp"
#include "reports/records/directory/result_files.hpp"
#include "reports/records/directory/run_files.hpp"
#include "tests/catch.hpp"
#include "tests/scratch_directory.hpp"
#include "tests/unit/reports/sample.hpp"

using namespace reports;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

// Bit for bit, so that -0.0 and 0.0 differ; every NaN is the same.
bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

long files_in(const std::filesystem::path& dir) {
  return std::distance(std::filesystem::directory_iterator(dir), std::filesystem::directory_iterator());
}

// Limits the size of files that this process may write, while it lives: writing then fails as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = SIG_DFL;
};

}  // namespace

TEST_CASE("every table survives writing and reading", "[reports]") {
  ScratchDirectory dir;
  const double third = 0.1 + 0.2, tiny = std::numeric_limits<double>::denorm_min();
  Results out;
  out.studies = {{"s", "a \"quoted\", title", " outer blanks ", "line one\nline two\r\n\"three\""},
                 {"", "", "", ""}};
  out.runs = {
      {"a=1.b_c-d", "s", "scene, with comma", "f", "b", "t", "usf", 20, 1600, 5e-6, 200000, "completed"}};
  out.errors = {{"a", third, "grid", tiny, -0.0, infinity},
                {"a", not_a_number, "particles", -infinity, -tiny, 1e308}};
  out.levels = {{"s", "v;w", "space", "grid", "l2", 1, 5e-5, third, true},
                {"s", "v", "time", "grid", "l2", 2, 1e-300, not_a_number, false}};
  out.orders = {{"s", "v", "space", "grid", "linf", 0.05, 2, 2.0000000000000004, 1.9, 2.1, 3, 4, "monotone",
                 "2;2.1;nan", 1e-3, 1.25, not_a_number, "u(H/2)"}};
  out.checks = {{"s", "c", not_a_number, -infinity, 1, "m/s", "fail", "because,\n\"so\""}};
  out.timings = {{"a", 1.5, 2.5e7}};
  out.figures = {
      {"fig", "s", "history", "title; with 'semicolon'", "a;b", "A;B", "y", "u", "grid;particles", "l2"}};
  out.scores = {{"s", "a, case", "linear_flip_usf", "linear", "flip", "usf", "diverged", "diverged", "pass",
                 third, not_a_number, tiny, 0.1, 0.5, infinity, "grid", "diverged at t = 1 s: \"why\"",
                 "because", "so"}};
  write_results(dir.path(), out);
  const Results in = read_results(dir.path());

  REQUIRE(in.studies.size() == 2);
  CHECK(in.studies[0].title == out.studies[0].title);
  CHECK(in.studies[0].claim == out.studies[0].claim);
  CHECK(in.studies[0].suite == out.studies[0].suite);
  CHECK(in.studies[1].study.empty());
  REQUIRE(in.runs.size() == 1);
  CHECK(in.runs[0].run == "a=1.b_c-d");
  CHECK(in.runs[0].scene == "scene, with comma");
  CHECK(in.runs[0].cells == 20);
  CHECK(in.runs[0].particles == 1600);
  CHECK(in.runs[0].steps == 200000);
  CHECK(same(in.runs[0].dt, 5e-6));
  CHECK(in.runs[0].status == "completed");
  REQUIRE(in.errors.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(same(in.errors[i].t, out.errors[i].t));
    CHECK(same(in.errors[i].l1, out.errors[i].l1));
    CHECK(same(in.errors[i].l2, out.errors[i].l2));
    CHECK(same(in.errors[i].linf, out.errors[i].linf));
  }
  REQUIRE(in.levels.size() == 2);
  CHECK(in.levels[0].used);
  CHECK_FALSE(in.levels[1].used);
  CHECK(same(in.levels[0].value, third));
  CHECK(same(in.levels[1].step, 1e-300));
  REQUIRE(in.orders.size() == 1);
  CHECK(same(in.orders[0].observed, out.orders[0].observed));
  CHECK(in.orders[0].levels_used == 3);
  CHECK(in.orders[0].levels == 4);
  CHECK(in.orders[0].pairwise == "2;2.1;nan");
  CHECK(in.orders[0].quantity == "u(H/2)");
  CHECK(std::isnan(in.orders[0].uncertainty));
  REQUIRE(in.checks.size() == 1);
  CHECK(same(in.checks[0].lower, -infinity));
  CHECK(in.checks[0].reason == out.checks[0].reason);
  REQUIRE(in.timings.size() == 1);
  CHECK(in.timings[0].wall_s == 1.5);
  REQUIRE(in.figures.size() == 1);
  CHECK(in.figures[0].title == out.figures[0].title);
  CHECK(in.figures[0].norm == "l2");

  REQUIRE(in.scores.size() == 1);
  CHECK(in.scores[0].hard_case == "a, case");
  CHECK(same(in.scores[0].t_diverged, third));
  CHECK(std::isnan(in.scores[0].error));
  CHECK(in.scores[0].thresholds == "so");

  // Every field, also those not named above: a second round must give the same bytes.
  ScratchDirectory again;
  write_results(again.path(), in);
  for (const char* name :
       {"studies", "runs", "errors", "levels", "orders", "checks", "timing", "figures", "scoreboard"}) {
    const std::string file = std::string(name) + ".csv";
    CHECK(read_file(dir / file) == read_file(again / file));
  }
}

TEST_CASE("profiles and histories survive writing and reading", "[reports]") {
  ScratchDirectory dir;
  write_profile(dir.path(), "r", {{0.1, "exact", 1, 2, not_a_number, -0.0, 1.0 / 3, 4}});
  const auto profile = read_profile(dir.path(), "r");
  REQUIRE(profile.size() == 1);
  CHECK(profile[0].location == "exact");
  CHECK(std::isnan(profile[0].u));
  CHECK(same(profile[0].v, -0.0));
  CHECK(same(profile[0].u_exact, 1.0 / 3));
  CHECK(profile[0].v_exact == 4);
  write_state(dir.path(), "r", {{1, "particles", 2, 3, 4, 5, 6, 7}});
  const auto state = read_state(dir.path(), "r");
  REQUIRE(state.size() == 1);
  CHECK(state[0].y == 3);
  CHECK(state[0].density_exact == 5);
  CHECK(state[0].pressure == 6);
  write_history(dir.path(), "r", {{1, 2, 3, 4, 5, 6, 7, 8, 9}});
  const auto history = read_history(dir.path(), "r");
  REQUIRE(history.size() == 1);
  CHECK(history[0].probe == 2);
  CHECK(history[0].impulse_y == 8);
  CHECK(history[0].kinetic_energy == 9);
}

TEST_CASE("the columns are those that the README names", "[reports]") {
  ScratchDirectory dir;
  write_results(dir.path(), {});
  CHECK(read_file(dir / "runs.csv") ==
        "run,study,scene,fluid,method,basis,transfer,stepping,reset,cells,particles,dt,steps,status\n");
  CHECK(read_file(dir / "errors.csv") == "run,t,location,l1,l2,linf,scale,exact_max\n");
  CHECK(read_file(dir / "checks.csv") == "study,check,observed,lower,upper,unit,verdict,reason\n");
  CHECK(read_file(dir / "timing.csv") == "run,wall_s,particle_steps_per_s,repetitions,spread,source,clock\n");
  write_profile(dir.path(), "r", {});
  CHECK(read_file(dir / "profiles/r.csv") == "t,location,x,y,u,v,u_exact,v_exact\n");
}

TEST_CASE("columns may come in any order and there may be more of them", "[reports]") {
  ScratchDirectory dir;
  write_results(dir.path(), {});
  write_file(dir / "timing.csv",
             "machine,wall_s,run,repetitions,source,clock,spread,particle_steps_per_s\r\n"
             "\"x,\"\"y\"\"\",+2.5 , r ,3,cache,simulation,nan,1e400\r\n");
  CHECK_THROWS_WITH(read_results(dir.path()),
                    contains("timing.csv:2: column 'particle_steps_per_s': '1e400'"));
  write_file(dir / "timing.csv",
             "machine,wall_s,run,repetitions,source,clock,spread,particle_steps_per_s\r\n"
             "\"x,\"\"y\"\"\",+2.5 , r ,3,cache,simulation,nan,1e4\r\n");
  const Results results = read_results(dir.path());
  REQUIRE(results.timings.size() == 1);
  CHECK(results.timings[0].run == "r");
  CHECK(results.timings[0].wall_s == 2.5);
}

TEST_CASE("a bad file is named with line and column", "[reports]") {
  ScratchDirectory dir;
  write_results(dir.path(), sample_results());
  const std::string header = "study,check,observed,lower,upper,unit,verdict,reason\n";
  const auto reading = [&](const std::string& content) {
    write_file(dir / "checks.csv", content);
    return read_results(dir.path());
  };
  CHECK_THROWS_AS(reading(""), IoError);
  CHECK_THROWS_WITH(reading(""), contains("checks.csv:1: the header is missing"));
  CHECK_THROWS_WITH(reading("study,check,observed,lower,upper,unit,verdict\n"),
                    contains("checks.csv:1: column 'reason' is missing"));
  // The line is that of the file even after a text of two lines.
  CHECK_THROWS_WITH(reading(header + "s,\"two\nlines\",1,0,2,m,pass,r\ns,c,1.5x,0,2,m,pass,r\n"),
                    contains("checks.csv:4: column 'observed': '1.5x' is not a number"));
  CHECK_THROWS_WITH(reading(header + "s,c,,0,2,m,pass,r\n"),
                    contains("column 'observed': '' is not a number"));
  CHECK_THROWS_WITH(reading(header + "s,c,1,0\n"), contains("checks.csv:2: fewer fields"));
  CHECK_THROWS_WITH(reading(header + "s,c,1,0,2,m,pass,r,more\n"), contains("checks.csv:2: more fields"));
  CHECK_THROWS_WITH(reading(header + "s,\"c,1,0,2,m,pass,r\n"),
                    contains("checks.csv:2: a quoted text is not closed"));
  CHECK_THROWS_WITH(reading(header + std::string("s\0", 2)), contains("checks.csv:2: a zero byte"));
  write_file(dir / "runs.csv",
             "run,study,scene,fluid,method,basis,transfer,stepping,reset,cells,particles,dt,steps,status\n"
             "r,s,s,f,m,b,t,u,never,2.5,1,1,1,completed\n");
  CHECK_THROWS_WITH(read_results(dir.path()),
                    contains("runs.csv:2: column 'cells': '2.5' is not a whole number"));
  std::filesystem::remove(dir / "runs.csv");
  CHECK_THROWS_WITH(read_results(dir.path()), contains("runs.csv: No such file"));
}

TEST_CASE("names that would lead out of the directory are refused", "[reports]") {
  ScratchDirectory dir;
  for (const char* name :
       {"", ".", "..", "../x", "a/b", "/etc/passwd", "a b", "x.history", "x.state", "a\nb", "ü", ".hidden"}) {
    CHECK_FALSE(is_plain_name(name));
    CHECK_THROWS_AS(write_profile(dir.path(), name, {}), IoError);
    CHECK_THROWS_AS(read_history(dir.path(), name), IoError);
    Results results;
    results.figures = {{name, "s", "history", "", "", "", "", "", "", ""}};
    CHECK_THROWS_WITH(write_results(dir.path(), results), contains("figure name"));
  }
  CHECK(is_plain_name("study.cells=20_dt=5e-06"));
  CHECK_FALSE(is_plain_name(std::string(201, 'a')));
}

TEST_CASE("a file is written whole or not at all", "[reports]") {
  ScratchDirectory dir;
  SECTION("over an old one") {
    write_file(dir / "f", "old");
    write_file(dir / "f", "new");
    CHECK(read_file(dir / "f") == "new");
    CHECK(files_in(dir.path()) == 1);
  }
  SECTION("no directory") {
    CHECK_THROWS_AS(write_file(dir / "none/f", "x"), IoError);
    CHECK_THROWS_WITH(write_file(dir / "none/f", "x"), contains("none/f: No such file or directory; make"));
    CHECK(files_in(dir.path()) == 0);
  }
  SECTION("the name is taken by a directory") {
    std::filesystem::create_directory(dir / "d");
    CHECK_THROWS_AS(write_file(dir / "d", "x"), IoError);
    CHECK(files_in(dir.path()) == 1);
  }
  SECTION("no room: the old file stays, no part of the new one is left") {
    write_file(dir / "f", "old");
    {
      const FileSizeLimit limit(4096);
      CHECK_THROWS_WITH(write_file(dir / "f", std::string(100000, 'x')), contains("free some space"));
    }
    CHECK(read_file(dir / "f") == "old");
    CHECK(files_in(dir.path()) == 1);
  }
}

TEST_CASE("a directory that cannot be made is named", "[reports]") {
  ScratchDirectory dir;
  ensure_directory(dir / "a/b/c");
  ensure_directory(dir / "a/b/c");
  CHECK(std::filesystem::is_directory(dir / "a/b/c"));
  write_file(dir / "file", "x");
  CHECK_THROWS_AS(ensure_directory(dir / "file"), IoError);
  CHECK_THROWS_WITH(ensure_directory(dir / "file"), contains("choose another --out DIR"));
  CHECK_THROWS_WITH(ensure_directory(dir / "file/below"), contains("choose another --out DIR"));
  // Not even root can make a directory there.
  CHECK_THROWS_WITH(ensure_directory("/proc/mpm-verify"), contains("/proc/mpm-verify"));
}

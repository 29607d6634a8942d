#include "tests/catch.hpp"
#include "tests/e2e/program.hpp"
#include "tests/study_text.hpp"

namespace {

const std::string good_scene = R"([scene]
flow = "poiseuille"
height = 1e-3
body_acceleration = 8e-3
[fluid]
kinematic_viscosity = 1e-6
pressure = false
[discretisation]
cells = 10
[time]
dt = 1e-3
end = 0.01
)";

std::string with(const std::string& from, const std::string& to) {
  return replaced(good_scene, from, to);
}

/// One line, exit code 2, naming what it must.
void check_refused(const Ended& ended, const std::string& names) {
  INFO(ended.output);
  CHECK(ended.code == 2);
  CHECK(std::count(ended.output.begin(), ended.output.end(), '\n') == 1);
  CHECK_THAT(ended.output, contains(names));
}

}  // namespace

TEST_CASE("a scene that cannot be meant is refused with file, key and remedy") {
  const ScratchDirectory scratch;
  const std::string out = " --out " + (scratch.path() / "out").string();
  const auto solve = [&](const std::string& scene) {
    return run_program("solve " + scratch.write("scene.toml", scene) + out);
  };
  check_refused(solve(with("dt = 1e-3", "dt = -1e-3")), "'time.dt'");
  check_refused(solve(with("dt = 1e-3", "dt = nan")), "'time.dt'");
  check_refused(solve(with("cells = 10", "cells = 0")), "'discretisation.cells'");
  check_refused(solve(with("cells = 10", "cells = 10.5")), "'discretisation.cells'");
  check_refused(solve(with("height", "hieght")), "did you mean 'height'?");
  check_refused(solve(with("pressure", "presure")), "'fluid.presure'");
  check_refused(solve(with("\"poiseuille\"", "\"poisuille\"")), "poiseuille");
  check_refused(solve(with("= 1e-6", "= ")), "scene.toml:6");
  check_refused(solve(with("1e-6", "-1e-6")), "'fluid.kinematic_viscosity'");
  check_refused(solve(with("end = 0.01", "outputs = [0.02, 0.01]")), "'time.outputs'");
  check_refused(solve(good_scene + "[scheme]\nstepping = \"ufs\"\n"), "usf, usl, musl");
  check_refused(run_program("solve " + (scratch.path() / "absent.toml").string() + out), "absent.toml");
  check_refused(solve(with("cells = 10", "cells = 1000000000")), "'discretisation.cells'");
  check_refused(solve(with("height = 1e-3", "height = 1e308")), "'scene.height'");
  check_refused(solve(with("= 1e-6", "= 1e300")), "'fluid.kinematic_viscosity'");
  check_refused(solve(with("end = 0.01", "outputs = [5e-324]")), "'time.outputs'");
  check_refused(solve(good_scene + std::string("[\xc3\xa9]\n")), "beyond ASCII");
  std::filesystem::create_directory(scratch / "dir.toml");
  check_refused(run_program("run " + (scratch / "dir.toml").string()), "is a directory");
  check_refused(run_program("run " + scratch.write("-e.toml", good_scene)), "dash");
  std::string deep = "a";
  for (int i = 0; i < 40000; ++i) deep += ".a";
  check_refused(solve(deep + " = 1\n"), "nested");
  CHECK_FALSE(std::filesystem::exists(scratch.path() / "out"));
}

TEST_CASE("a result directory that cannot be used is refused") {
  const ScratchDirectory scratch;
  const std::string scene = scratch.write("scene.toml", good_scene);
  const std::string file = scratch.write("occupied", "a file");
  check_refused(run_program("solve " + scene + " --out " + file), "occupied");
  check_refused(run_program("solve " + scene + " --out /proc/nowhere"), "/proc/nowhere");
  check_refused(run_program("report " + (scratch.path() / "absent").string()), "absent");
}

TEST_CASE("usage errors exit with 2") {
  CHECK(run_program("").code == 2);
  CHECK(run_program("frobnicate").code == 2);
  CHECK(run_program("run --jobs 0").code == 2);
  CHECK(run_program("run --suite nightly").code == 2);
  CHECK(run_program("run no-such-study").code == 2);
  CHECK(run_program("--help").code == 0);
}

TEST_CASE("cavities that have no table are refused by name") {
  const ScratchDirectory scratch;
  const std::string out = " --out " + (scratch.path() / "out").string();
  check_refused(run_program("cavity-tables honey" + out), "choose some of: newtonian, power-law-0.5");
  check_refused(run_program("cavity-profile " + scratch.write("scene.toml", good_scene) + out),
                "must be a lid-driven-cavity");
}

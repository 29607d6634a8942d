#include "verification/reading/study_reader.hpp"

#include <cmath>
#include <limits>

#include "tests/study_text.hpp"
#include "tests/unit/verification/read_text.hpp"
#include "verification/checks/check_reader.hpp"
#include "verification/config/config_error.hpp"

using namespace verification;

namespace {

const std::string good =
    study_text("T", "C", couette_scene("cells = 8", "dt = 1e-3\noutputs = [0.01, 0.02]") + R"([ladder]
axis = "space"
cells = [8, 16]
theoretical = 2
[[variant]]
name = "a"
[[variant]]
name = "b"
scheme.stepping = "musl"
[[check]]
kind = "order"
lower = 1.9
upper = 2.1
reason = "theory"
)",
               "suite = \"quick\"\n");

std::string with(const std::string& from, const std::string& to) {
  return replaced(good, from, to);
}

Study read(const std::string& text) {
  return read_study_text(text, "reader-test");
}

}  // namespace

TEST_CASE("a study expands to its variants times its ladder, the step shrinking with the square of h") {
  const Study study = read(good);
  REQUIRE(study.runs.size() == 4);
  CHECK(study.runs[0].run == "reader-test.a.n8");
  CHECK(study.runs[3].run == "reader-test.b.n16");
  CHECK(study.runs[1].scene.time_step.dt == 1e-3 / 4);
  CHECK(study.runs[3].scene.scheme.stepping == mpm::Scheme::Stepping::Musl);
  CHECK(study.runs[1].step == 1e-3 / 16);
  CHECK(study.checks.front().times == std::vector<double>{0.01, 0.02});
}

TEST_CASE("a variant takes keys of the scene away, and only those that are there") {
  const Study study = read(with("name = \"b\"", "name = \"b\"\nwithout = [\"scheme.stepping\"]"));
  CHECK(study.runs[3].scene.scheme.stepping == mpm::Scheme::Stepping::Usf);
  CHECK_THROWS_WITH(read(with("name = \"b\"", "name = \"b\"\nwithout = [\"time.nothing\"]")),
                    contains("'time.nothing' is no key of the scene"));
  CHECK_THROWS_WITH(read(with("name = \"b\"", "name = \"b\"\nwithout = [\"nothing.dt\"]")),
                    contains("'nothing.dt' is no key of the scene"));
}

TEST_CASE("a scene's text reproduces it") {
  const Study study = read(good);
  const SceneConfig again = read_scene_config(TomlTable::from_text(study.runs[3].scene.toml, "printed"));
  CHECK(again.discretisation.cells == 16);
  CHECK(again.time_step.dt == study.runs[3].scene.time_step.dt);
  CHECK(again.scheme.stepping == mpm::Scheme::Stepping::Musl);
  CHECK(again.outputs == study.runs[3].scene.outputs);
}

TEST_CASE("studies that prove nothing, or say what nobody reads, are refused with file and key") {
  const auto refused = [](const std::string& text, const std::string& names) {
    CHECK_THROWS_AS(read(text), ConfigError);
    CHECK_THROWS_WITH(read(text), contains("reader-test.toml"));
    CHECK_THROWS_WITH(read(text), contains(names));
  };
  refused(with("reason = \"theory\"", ""), "reason");
  refused(with("reason = \"theory\"", "reason = \" \""), "reason");
  refused(good.substr(0, good.find("[[check]]")), "proves nothing");
  refused(with("upper = 2.1", "uper = 2.1"), "uper");
  refused(with("upper = 2.1", ""), "upper");
  refused(with("upper = 2.1", "upper = nan"), "upper");
  refused(with("lower = 1.9", "lower = 2.2"), "lower");
  refused(with("kind = \"order\"", "kind = \"ordre\""), "order");
  refused(with("cells = [8, 16]", "cells = [16, 8]"), "ladder.cells");
  refused(with("suite = \"quick\"", "suite = \"fast\""), "suite");
  refused(with("scheme.stepping", "scheme.steping"), "steping");
  refused(with("name = \"b\"", "name = \"a\""), "twice");
  refused(with("title = \"T\"", "titel = \"T\""), "title");
  refused(with("reason = \"theory\"", "reason = \"theory\"\ntimes = [0.015]"), "no output time");
  refused(with("suite = \"quick\"", "compare_with = \"discrete\"\nsuite = \"quick\"\nextra = 1"), "extra");
  refused(with("dt = 1e-3", "dt = 1e-3\ncfl_viscous = 0.1"), "cfl_viscous");
}

TEST_CASE("a NaN never passes, whatever the bounds") {
  const Study study = read(good);
  StudyData data;
  data.study = &study;
  CheckSpec spec;
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(judge(spec, data, "any", std::nan(""), "1").verdict == "fail");
  CHECK(judge(spec, data, "any", 1, "1").verdict == "pass");
  spec.lower = 1.9;
  spec.upper = 2.1;
  CHECK(judge(spec, data, "two-sided", 2.2, "1").verdict == "fail");
  CHECK(judge(spec, data, "two-sided", 1.8, "1").verdict == "fail");
  CHECK(judge(spec, data, "two-sided", 2.0, "1").verdict == "pass");
  CHECK(judge(spec, data, "two-sided", infinity, "1").verdict == "fail");
}

TEST_CASE("a ladder in the Mach number sets the speed of sound") {
  const std::string scene = R"(title = "T"
claim = "C"
[scene]
flow = "taylor-green"
period = 1.0
amplitude = 2.0
[fluid]
kinematic_viscosity = 0.01
density = 900
[discretisation]
cells = 8
[scheme]
reset_every = 7
[time]
end = 0.01
[ladder]
axis = "mach"
mach = [0.2, 0.05]
theoretical = 2
[[check]]
kind = "order"
lower = 1.9
upper = 2.1
reason = "theory"
)";
  const Study study = read(scene);
  REQUIRE(study.runs.size() == 2);
  CHECK(study.runs[0].scene.scene.fluid.sound_speed() == Approx(10));
  CHECK(study.runs[1].scene.scene.fluid.sound_speed() == Approx(40));
  CHECK(study.runs[1].step == 0.05);
  CHECK(study.runs[0].run.ends_with(".ma0.2"));
  CHECK(study.runs[0].scene.scheme.reset_every == 7);
  // The unit of errors decays with the flow: U/sqrt(2) exp(-2 nu k^2 t).
  const Flow& flow = *study.runs[0].scene.flow;
  CHECK(flow.velocity_scale_at(1) == Approx(std::sqrt(2.0) * std::exp(-0.02 * 39.47841760435743)));

  const auto changed = [&](const std::string& from, const std::string& to) {
    return replaced(scene, from, to);
  };
  CHECK_THROWS_WITH(read(changed("[0.2, 0.05]", "[0.05, 0.2]")), contains("coarse to fine"));
  CHECK_THROWS_WITH(read(changed("[0.2, 0.05]", "[0.7, 0.2]")), contains("half the speed of sound"));
  CHECK_THROWS_WITH(read(changed("reset_every = 7", "reset_every = -1")), contains("scheme.reset_every"));
  CHECK_THROWS_WITH(read(changed("reset_every = 7", "reset_strain = 0")), contains("scheme.reset_strain"));
  CHECK_THROWS_WITH(read(changed("end = 0.01", "end = 0.01\nstart = 0.005")), contains("time.start"));
  CHECK_THROWS_WITH(read(changed("density = 900", "pressure = false")), contains("pressure"));
}

TEST_CASE("runs of two studies that would write the same files are refused") {
  const Study one = read_study_text(with("name = \"a\"", "name = \"q.b\""), "s");
  const Study two = read_study_text(with("name = \"a\"", "name = \"c\""), "s.q");
  CHECK_NOTHROW(require_distinct_runs({one}));
  CHECK_THROWS_WITH(require_distinct_runs({one, two}), contains("same files"));
}

TEST_CASE("a level of a ladder in time that would not be taken as asked is refused") {
  const std::string time =
      with("axis = \"space\"\ncells = [8, 16]", "axis = \"time\"\ndt = [1e-3, 5e-4, 2.5e-4]");
  CHECK_NOTHROW(read(time));
  CHECK_THROWS_WITH(read(replaced(time, "dt = [1e-3, 5e-4", "dt = [3e-3, 5e-4")), contains("divide"));
}

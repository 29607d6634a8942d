#include "verification/runs/pilot/pilot.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include "tests/study_text.hpp"
#include "tests/unit/verification/read_text.hpp"
#include "verification/config/config_error.hpp"

using namespace verification;

namespace {

constexpr double scale = 1e-4;  // plate_velocity of the scene [m/s]

auto about(double value, double relative) {
  return Catch::Matchers::WithinRel(value, relative);
}

/// Couette flow on 8, 16 and 32 cells whose steps are to be chosen. Implicit: no limit bounds them.
Study study_of(const std::string& stepping, const std::string& more = "") {
  return read_study_text(
      study_text("T", "C",
                 couette_scene("cells = 8", "dt = \"auto\"\noutputs = [0.1, 0.2]\n" + more) +
                     "[scheme]\ntransfer = \"full-mass\"\nstepping = \"" + stepping +
                     "\"\n[ladder]\naxis = \"space\"\ncells = [8, 16, 32]\ntheoretical = 2\n[[check]]\nkind "
                     "= \"error\"\n"
                     "upper = 1\nreason = \"any\"\n"));
}

using Errors = std::function<double(double h, double dt)>;

/// Runs that say on one point of the grid what `errors` has, relative to the scale; NaN: diverged.
PilotRunner runs_with(const Errors& errors) {
  return [errors](const Study& study, const PlannedRun& plan) {
    const double dt = plan.scene.segments.front().dt, error = errors(plan.scene.cell_size(), dt);
    RunData data;
    data.plan = &plan;
    data.record = describe_run(study, plan, plan.scene.steps(),
                               std::isnan(error) ? "diverged at t = 0.1 s" : "completed");
    for (const double t : {0.1, 0.2})
      data.profile.push_back({t, "grid", 0, 5e-4, scale * (0.5 + error), 0, scale * 0.5, 0});
    return data;
  };
}

PilotOutcome chosen(const Study& study, const Errors& errors) {
  return choose_steps(study, "", runs_with(errors));
}

std::vector<std::string> bounds(const PilotOutcome& outcome) {
  std::vector<std::string> found;
  for (const auto& step : outcome.steps) found.push_back(step.bound);
  return found;
}

const double no_value = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("known laws of the errors give the step of every level", "[pilot]") {
  // e = 4 dt^2 + 2e5 h^2: at 8 cells h = 1.25e-4 m, error in space 3.125e-3
  const auto outcome =
      chosen(study_of("implicit-sdirk2"), [](double h, double dt) { return 4 * dt * dt + 2e5 * h * h; });
  REQUIRE(outcome.steps.size() == 3);
  CHECK(bounds(outcome) == std::vector<std::string>{"error", "error", "error"});
  for (const auto& step : outcome.steps) {
    CHECK_THAT(step.time_coefficient, about(4, 1e-9));
    CHECK_THAT(step.time_order, about(2, 1e-9));
    CHECK_THAT(step.space_coefficient, about(2e5, 1e-6));
    CHECK_THAT(step.space_order, about(2, 1e-9));
    const double wanted = std::sqrt(0.1 * 2e5 * step.h * step.h / 4), parts = std::ceil(0.1 / wanted - 1e-9);
    CHECK_THAT(step.dt, about(0.1 / parts, 1e-9));
    CHECK_THAT(step.time_error, about(4 * step.dt * step.dt, 1e-9));
  }
  for (const auto& run : outcome.runs) CHECK(run.status == "completed");
}

TEST_CASE("the fraction is what the error in time is held to", "[pilot]") {
  const Errors errors = [](double h, double dt) { return 4 * dt * dt + 2e5 * h * h; };
  const auto tenth = chosen(study_of("implicit-sdirk2"), errors);
  const auto half = chosen(study_of("implicit-sdirk2", "time_error_fraction = 0.5"), errors);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(half.steps[i].fraction == 0.5);
    CHECK(half.steps[i].time_error <= 0.5 * half.steps[i].space_error * (1 + 1e-9));
    // sqrt(0.5/0.1) = 2.24, but for the whole number of steps
    CHECK(half.steps[i].dt > 1.9 * tenth.steps[i].dt);
  }
}

TEST_CASE("limits of an explicit scheme bound its step", "[pilot]") {
  // An error in time so small that stability is all that counts.
  const auto outcome = chosen(study_of("usf"), [](double h, double dt) { return 1e-6 * dt + 2e5 * h * h; });
  CHECK(bounds(outcome) == std::vector<std::string>{"stability", "stability", "stability"});
  for (const auto& step : outcome.steps) {
    CHECK(step.dt <= step.stable * (1 + 1e-9));
    CHECK(step.dt > 0.9 * step.stable);
  }
}

TEST_CASE("errors in time that are round-off leave the limits", "[pilot]") {
  const auto outcome =
      chosen(study_of("usf"), [](double h, double dt) { return 2e5 * h * h + 1e-14 * std::sin(1e6 * dt); });
  CHECK(bounds(outcome) == std::vector<std::string>{"stability", "stability", "stability"});
  CHECK_THAT(outcome.steps.front().remark, contains("round-off"));
  const auto implicit = chosen(study_of("implicit-sdirk2"), [](double h, double) { return 2e5 * h * h; });
  CHECK(bounds(implicit) == std::vector<std::string>{"outputs", "outputs", "outputs"});
}

TEST_CASE("a pilot that diverges is recorded, and no longer step is chosen", "[pilot]") {
  const auto outcome = chosen(study_of("implicit-sdirk2"), [](double h, double dt) {
    return dt > 0.03 ? no_value : 1e-3 * dt * dt + 2e5 * h * h;
  });
  CHECK(outcome.steps.front().bound == "pilot");
  CHECK_THAT(outcome.steps.front().dt, about(0.025, 1e-9));
  CHECK_THAT(outcome.steps.front().remark, contains("1 of"));
  CHECK(outcome.steps.back().dt <= 0.025 / 4 * (1 + 1e-9));  // falls with h
  const auto diverged = [](const reports::PilotRecord& run) { return run.status != "completed"; };
  CHECK(std::ranges::count_if(outcome.runs, diverged) == 1);
  const auto none = chosen(study_of("implicit-sdirk2"), [](double, double) { return no_value; });
  CHECK(bounds(none) == std::vector<std::string>{"none", "none", "none"});
  CHECK_THAT(none.steps.front().remark, contains("every pilot run diverged"));
}

TEST_CASE("an error in time without an order: the fraction itself decides, or nothing does", "[pilot]") {
  // Noise of a thousandth of the error in space: any step will do, the longest is taken.
  const auto noise = [](double size) {
    return [size](double h, double dt) {
      return 2e5 * h * h *
             (1 + size * (std::lround(0.1 / dt) % 3 == 0   ? 1
                          : std::lround(0.1 / dt) % 3 == 1 ? -1
                                                           : 0));
    };
  };
  const auto small = chosen(study_of("implicit-sdirk2"), noise(1e-3));
  CHECK(small.steps.front().bound == "outputs");
  CHECK_THAT(small.steps.front().remark, contains("no order in time"));
  CHECK(small.steps.back().dt < small.steps.front().dt / 3);
  const auto large = chosen(study_of("implicit-sdirk2"), noise(0.5));
  CHECK(bounds(large) == std::vector<std::string>{"none", "none", "none"});
  CHECK_THAT(large.steps.front().remark, contains("show no order"));
  CHECK(large.steps.front().dt > 0);
}

TEST_CASE("no step makes the error in time a part of none in space, nor one of a million steps", "[pilot]") {
  const auto exact = chosen(study_of("implicit-sdirk2"), [](double, double dt) { return 4 * dt * dt; });
  CHECK(exact.steps.front().bound == "none");
  CHECK_THAT(exact.steps.front().remark, contains("round-off"));
  const auto dear =
      chosen(study_of("implicit-euler"), [](double h, double dt) { return 40 * dt + 1e-3 * h; });
  CHECK(dear.steps.front().bound == "none");
  CHECK_THAT(dear.steps.front().remark, contains("steps, and 1e+06 are the most"));
}

TEST_CASE("without a solution the next level measures the error in space", "[pilot]") {
  const std::string text =
      study_text("T", "C", couette_scene("cells = 8", "dt = \"auto\"\noutputs = [0.1, 0.2]"),
                 "compare_with = \"finest\"\n") +
      "[scheme]\ntransfer = \"full-mass\"\nstepping = \"implicit-sdirk2\"\n[ladder]\naxis = \"space\"\ncells "
      "= [8, 16, 32]\n"
      "theoretical = 2\n[[check]]\nkind = \"error\"\nlevel = \"coarsest\"\nupper = 1\nreason = \"any\"\n";
  const Study study = read_study_text(text);
  // Of either sign beside the error in space, and so large that the first steps hide it.
  const double in_time = GENERATE(4.0, -4.0, 1000.0, -1000.0);
  CAPTURE(in_time);
  const PilotRunner run = [in_time](const Study& of, const PlannedRun& plan) {
    const double dt = plan.scene.segments.front().dt, h = plan.scene.cell_size();
    RunData data;
    data.plan = &plan;
    data.record = describe_run(of, plan, plan.scene.steps(), "completed");
    // Linear across, so that interpolation is exact, and off by the made error.
    for (const double t : {0.1, 0.2})
      for (int j = 0; j <= plan.scene.discretisation.cells; ++j)
        data.profile.push_back({t, "grid", 0, j * h, scale * (j * h / 1e-3 + in_time * dt * dt + 2e5 * h * h),
                                0, no_value, no_value});
    return data;
  };
  const auto outcome = choose_steps(study, "", run);
  CHECK(bounds(outcome) == std::vector<std::string>{"error", "error", "error"});
  for (const auto& step : outcome.steps) {
    // Cautious by twice the error in time that the second level's run has: a few per cent of this or, where
    // that is large, a tenth at most, of three quarters of this: 1 - 0.2/0.75.
    CHECK(step.space_error <= 2e5 * step.h * step.h * (1 + 1e-9));
    CHECK(step.space_error >= (std::abs(in_time) > 4 ? 0.73 : 0.95) * 2e5 * step.h * step.h);
    CHECK(step.time_error <= 0.1 * step.space_error * (1 + 1e-9));
  }
}

TEST_CASE("dt = \"auto\" is refused, with a remedy, where no error could be measured", "[pilot]") {
  const std::string any = "[[check]]\nkind = \"error\"\nupper = 1\nreason = \"any\"\n";
  const auto refusal = [&](const std::string& head, const std::string& tables,
                           const std::string& time = "dt = \"auto\"\noutputs = [0.1, 0.2]") -> std::string {
    try {
      (void)read_study_text(study_text("T", "C", couette_scene("cells = 8", time) + tables + any, head));
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  const std::string ladder = "[ladder]\naxis = \"space\"\ncells = [8, 16]\ntheoretical = 2\n";
  CHECK(refusal("", ladder).empty());
  CHECK(refusal("", "").empty());
  CHECK_THAT(refusal("", "[ladder]\naxis = \"time\"\ndt = [4e-3, 2e-3, 1e-3]\ntheoretical = 1\n"),
             contains("'time.dt'") && contains("refines dt itself"));
  CHECK_THAT(refusal("", "[solver]\ncommand = [\"true\"]\nlocations = [\"grid\"]\n"),
             contains("'time.dt'") && contains("built-in solver"));
  CHECK_THAT(refusal("", "[scheme]\ntransfer = \"pic\"\n"),
             contains("'time.dt'") && contains("order in time"));
  CHECK_THAT(refusal("compare_with = \"discrete\"\n", ""), contains("'time.dt'") && contains("discrete"));
  CHECK_THAT(refusal("compare_with = \"finest\"\n", ""), contains("'time.dt'") && contains("[ladder]"));
  CHECK_THAT(refusal("", ladder, "dt = \"automatic\"\noutputs = [0.1]"),
             contains("'time.dt'") && contains("or \"auto\""));
  CHECK_THAT(refusal("", ladder, "dt = 1e-3\ntime_error_fraction = 0.1\noutputs = [0.1]"),
             contains("'time.time_error_fraction'"));
  CHECK_THAT(refusal("", ladder, "dt = \"auto\"\ntime_error_fraction = 2\noutputs = [0.1]"),
             contains("'time.time_error_fraction'"));
  CHECK_THAT(refusal("", "[scheme]\nstepping = \"ufs\"\n"), contains("usf, usl, musl"));
}

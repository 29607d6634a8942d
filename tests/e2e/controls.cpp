#include "tests/e2e/program.hpp"
#include "tests/study_text.hpp"

// Negative controls as studies: a fault that is seen is green, one that is not turns the suite red.
namespace {

/// The built-in solver, whose error of about 1e-2 on eight cells the check bears or not.
std::string control_with(const std::string& upper, const std::string& demand) {
  return study_text(
      "Control", "A planted fault is seen",
      couette_scene() + "[[check]]\nkind = \"error\"\nlocations = [\"grid\"]\ntimes = [0.2]\nupper = " +
          upper + "\nreason = \"any\"\n[control]\nplanted = \"a bound <below> the error\"\n" + demand);
}

const std::string red = "[[control.must_fail]]\ncheck = \"l2 error\"\n";

}  // namespace

TEST_CASE("a control whose fault is seen passes; its red checks count nowhere", "[control]") {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("seen.toml", control_with("1e-9", red));
  const auto out = scratch.path() / "out";
  const Ended ended = run_program("run " + file + " --out " + out.string());
  INFO(ended.output);
  CHECK(ended.code == 0);
  CHECK_THAT(ended.output, contains("PASS: 9 of 9 checks hold"));
  CHECK(count(content_of(out / "checks.csv"), ",fail,") == 0);
  CHECK(count(content_of(out / "junit.xml"), "<failure ") == 0);
  CHECK_THAT(content_of(out / "controls.csv"), contains(",true"));
  for (const char* file_name : {"report.html", "report.md", "summary.md"})
    CHECK_THAT(content_of(out / file_name), contains("Negative controls: 1 of 1 planted faults were seen"));
  CHECK_THAT(content_of(out / "report.html"), contains("a bound &lt;below&gt; the error"));
  // What the page links to is the control's own report, and that is red.
  CHECK_THAT(content_of(out / "controls" / "seen" / "report.html"), contains("banner fail"));
  CHECK(count(content_of(out / "controls" / "seen" / "checks.csv"), ",fail,") == 1);

  // By hand the same study is what it is: red.
  CHECK(run_program("run " + file + " --plain --out " + (scratch.path() / "plain").string()).code == 1);

  // Tables alone give the same page.
  const std::string page = content_of(out / "report.html");
  REQUIRE(run_program("report " + out.string()).code == 0);
  CHECK(content_of(out / "report.html") == page);

  // Without controls an old list of them does not stay behind.
  const std::string plain =
      scratch.write("plain.toml", study_text("P", "C", couette_scene()) +
                                      "[[check]]\nkind = \"error\"\nupper = 1\nreason = \"any\"\n");
  REQUIRE(run_program("run " + plain + " --out " + out.string()).code == 0);
  CHECK_FALSE(std::filesystem::exists(out / "controls.csv"));
}

TEST_CASE("a control that passes turns the suite red, and so does one that fails for another reason",
          "[control]") {
  const ScratchDirectory scratch;
  const auto out = scratch.path() / "out";
  struct Case {
    const char *upper, *demand, *red;
  };
  for (const auto& [upper, demand, said] :
       {Case{"1", "[[control.must_fail]]\ncheck = \"l2 error\"\n", "exit code"},
        {"1e-9", "[[control.must_fail]]\ncheck = \"l2 error\"\nbecause = \"the moon\"\n",
         "red for it: l2 error"},
        {"1e-9", "[[control.must_fail]]\ncheck = \"l2 error\"\ncount = 2\n", "red for it: l2 error"},
        {"1e-9", "[[control.must_fail]]\ncheck = \"space order\"\n", "red without cause"},
        {"1e-9", "exit_code = 0\n", "exit code"}}) {
    INFO(demand << upper);
    const Ended ended = run_program("run " + scratch.write("unseen.toml", control_with(upper, demand)) +
                                    " --out " + out.string());
    INFO(ended.output);
    CHECK(ended.code == 1);
    CHECK_THAT(ended.output, contains("FAIL  unseen  " + std::string(said)));
    CHECK_THAT(content_of(out / "report.html"), contains("NOT SEEN"));
    CHECK_THAT(content_of(out / "report.md"), contains("NOT SEEN"));
    CHECK_THAT(content_of(out / "controls.csv"), contains(",false"));
  }
}

TEST_CASE("a control that cannot be judged is red; one that is badly said is refused", "[control]") {
  const ScratchDirectory scratch;
  const std::string good = control_with("1e-9", red);
  const auto code = [&](const std::string& text) {
    const Ended ended =
        run_program("run " + scratch.write("c.toml", text) + " --out " + (scratch.path() / "out").string());
    INFO(ended.output);
    return ended.code;
  };
  CHECK(code(good) == 0);
  CHECK(code(control_with("1e-9", "")) == 2);
  CHECK(code(control_with("1e-9", "exit_code = 0\n" + red)) == 2);
  CHECK(code(control_with("1e-9", "exit_code = 2\n" + red)) == 2);
  CHECK(code(control_with("1e-9", "claims_refused = 1\n" + red)) == 2);
  CHECK(code(replaced(good, "a bound <below> the error", " ")) == 2);
  CHECK(code(replaced(good, "check = \"l2 error\"", "check = \"l2 error\"\nreason = \"any\"")) == 2);
  CHECK(code(good + "[[figure]]\nkind = \"profiles\"\ntitle = \"any\"\n") == 2);
}

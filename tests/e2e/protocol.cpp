#include <algorithm>

#include "tests/e2e/program.hpp"
#include "tests/study_text.hpp"

// What the protocol promises a solver and asks of it: docs/protocol.md.
namespace {

/// Writes the steady Couette profile times `factor`, and a line into ../started for every run of it.
const char* const solver_script = R"SH(
scene=$1 out=$2 factor=$(sed -n 's/^factor = //p' "$1")
echo "$out" >> started
awk -v n="$3" -v f="${factor:-1}" -v by="$(cat data)" 'BEGIN {
  print "# a comment"
  print "t,location,x,y,u"
  for (k = 1; k <= 2; ++k) for (j = 0; j <= n; ++j)
    printf "%.17g,grid,0,%.17g,%.17g\n", 10 * k, 1e-3 * j / n, f * by * 1e-4 * j / n
}' > "$out/profile.csv"
)SH";

std::string study_with(const std::string& solver, const std::string& more = "") {
  return study_text("Foreign", "The steady profile",
                    couette_scene("cells = 8", "outputs = [10, 20]") + R"([solver]
name = "line"
locations = ["grid"]
command = ["sh", "solver.sh", "{scene}", "{out}", "{cells}"]
)" + solver + R"(
[[check]]
kind = "error"
locations = ["grid"]
upper = 1e-6
reason = "the profile is written down as it is; what is left of the start is below 1e-40"
)" + more);
}

struct Bench {
  ScratchDirectory scratch;
  Bench() {
    scratch.write("solver.sh", solver_script);
    scratch.write("data", "1\n");
    scratch.write("started", "");
  }
  Ended run(const std::string& study, const std::string& out = "out") const {
    return run_program("run " + scratch.write("s.toml", study) + " --out " + (scratch / out).string(),
                       "MPM_GNUPLOT=none MPM_CACHE=" + (scratch / "cache").string());
  }
  [[nodiscard]] std::size_t started() const { return count(content_of(scratch / "started"), "\n"); }
  [[nodiscard]] std::string table(const std::string& name, const std::string& out = "out") const {
    return content_of(scratch / out / name);
  }
};

}  // namespace

TEST_CASE("a foreign scene is handed over whole: version, defaults, coordinates, options") {
  const Bench bench;
  const Ended ended = bench.run(study_with("[solver.options]\nfactor = 1\nscheme = \"upwind\"\n"));
  INFO(ended.output);
  REQUIRE(ended.code == 0);
  const std::string scene = bench.table("scenes/s.toml");
  for (const char* part :
       {"[protocol]\nversion = 1\n", "[solver.options]\nfactor = 1\nscheme = \"upwind\"\n",
        "density = 1000.0", "particles_across = 2", "model = \"newtonian\"", "origin = \"lower left corner",
        "height = 0.001", "across = \"y\"", "the upper plate moves with plate_velocity from t = 0"})
    CHECK_THAT(scene, contains(part));
  // It gave no time step, and the solver says nothing of steps and particles: nothing is invented.
  CHECK_THAT(bench.table("runs.csv"), contains(",8,,nan,,completed\n"));
  // What was handed over reads back as a scene of ours.
  CHECK(run_program("reference " + (bench.scratch / "out/scenes/s.toml").string() + " --out " +
                    (bench.scratch / "reference").string())
            .code == 0);
}

TEST_CASE("foreign runs are kept by what decides them: scene, options, inputs, version") {
  const Bench bench;
  const std::string kept = "inputs = [\"data\"]\nversion = [\"cat\", \"version\"]\n";
  const std::string variants =
      "[[variant]]\nname = \"one\"\n[[variant]]\nname = \"two\"\n[variant.solver.options]\nfactor = 1.0\n";
  bench.scratch.write("version", "\nline 3.1\n");
  const std::string study = study_with(kept, variants);
  REQUIRE(bench.run(study).code == 0);
  CHECK(bench.started() == 2);
  const std::string runs = bench.table("runs.csv"), errors = bench.table("errors.csv");
  CHECK_THAT(runs, contains(",line line 3.1"));

  CHECK(bench.run(study, "again").code == 0);
  CHECK(bench.started() == 2);  // none of them ran again
  CHECK(bench.table("runs.csv", "again") == runs);
  CHECK(bench.table("errors.csv", "again") == errors);
  CHECK(count(bench.table("timing.csv", "again"), ",cache") == 2);

  const Ended changed = bench.run(replaced(study, "factor = 1.0", "factor = 2.0"));
  CHECK(changed.code == 1);
  CHECK(bench.started() == 3);  // the one whose option it is

  bench.scratch.write("version", "line 3.2\n");
  REQUIRE(bench.run(study).code == 0);
  CHECK(bench.started() == 5);
  bench.scratch.write("data", "1.01\n");
  CHECK(bench.run(study).code == 1);
  CHECK(bench.started() == 7);
  bench.scratch.write("solver.sh", std::string(solver_script) + "exit 5\n");  // the command names it
  CHECK(bench.run(study).code == 3);
  CHECK(bench.started() == 9);
}

TEST_CASE("a foreign solver of which nobody says what decides it is run every time") {
  const Bench bench;
  REQUIRE(bench.run(study_with("")).code == 0);
  REQUIRE(bench.run(study_with("")).code == 0);
  CHECK(bench.started() == 2);
}

TEST_CASE("results that are there already are judged without running anything") {
  const Bench bench;
  const std::string there =
      replaced(study_with(""), "command = [\"sh\", \"solver.sh\", \"{scene}\", \"{out}\", \"{cells}\"]",
               "results = \"theirs/{run}\"");
  const Ended missing = bench.run(there);
  CHECK(missing.code == 3);
  CHECK_THAT(missing.output, contains("theirs/s: put profile.csv there"));
  REQUIRE(bench.run(study_with("")).code == 0);
  std::filesystem::create_directories(bench.scratch / "theirs");
  std::filesystem::copy(bench.scratch / "out/external/s", bench.scratch / "theirs/s");
  const Ended judged = bench.run(there, "judged");
  INFO(judged.output);
  CHECK(judged.code == 0);
  CHECK(bench.started() == 1);
  CHECK(bench.table("errors.csv", "judged") == bench.table("errors.csv"));
  bench.scratch.write("theirs/s/run.json", R"({"status": "failed", "message": "no convergence"})");
  CHECK_THAT(bench.run(there).output, contains("no convergence"));
}

TEST_CASE("shear rates and states of a foreign solver are judged, and demanded whole") {
  const Bench bench;
  const std::string shear = R"(
awk 'BEGIN { print "t,place,shear_rate"; for (k = 1; k <= 2; ++k) for (j = 0; j < 8; ++j)
  printf "%g,%.17g,0.1\n", 10 * k, (j + 0.5) * 1e-3 / 8 }' > "$out/shear.csv"
)";
  const std::string study = study_with("delivers = [\"profile\", \"shear\"]\n", R"([[figure]]
kind = "shear-rate"
title = "The shear rate"
t = 20
)");
  CHECK_THAT(bench.run(study).output, contains("it left no shear.csv"));
  bench.scratch.write("solver.sh", solver_script + shear);
  const Ended ended = bench.run(study);
  INFO(ended.output);
  CHECK(ended.code == 0);
  CHECK_THAT(bench.table("profiles/s.shear.csv"), contains("20,cells,6.25e-05,0.1,1\n"));
  bench.scratch.write("solver.sh", solver_script + replaced(shear, "j < 8", "j < 7"));
  CHECK_THAT(bench.run(study).output, contains("shear.csv has 7 rows at t = 10; expected at least 8"));
}

TEST_CASE("keys that only our solver needs are not asked of others; what they ask for must be there") {
  const Bench bench;
  const std::string incompressible = replaced(study_with(""), "pressure = false", "pressure = true");
  CHECK(bench.run(incompressible).code == 0);
  CHECK_THAT(bench.run(replaced(study_with(""), "\"{cells}\"", "\"{cells}\", \"{dt}\"")).output,
             contains("time.dt': is missing"));
  CHECK_THAT(bench.run(study_with("inputs = [\"gone\"]\n")).output, contains("gone' is not there"));
  CHECK_THAT(bench.run(study_with("results = \"theirs/{run}\"\n")).output, contains("cannot stand beside"));
}

TEST_CASE("a new study and a new solver in each language run as they are") {
  const ScratchDirectory scratch;
  const std::string here = "cd " + scratch.path().string() + " && ", quiet = " > /dev/null 2>&1";
  const std::string program = "MPM_GNUPLOT=none " MPM_VERIFY_PROGRAM " ";
  const auto runs = [&](const std::string& command) {
    return std::system((here + command + quiet).c_str()) == 0;
  };
  CHECK(runs(program + "new study mine && " + program + "run mine.toml --no-cache --out results"));
  CHECK_FALSE(runs(program + "new study mine"));  // it is there
  for (const auto& [language, needs, build] :
       {std::tuple{"sh", "true", "true"},
        {"python", "python3 -c 'import tomllib'", "true"},
        {"cpp", "g++ --version", "g++ -std=c++17 -O2 -o solver solver.cpp"}}) {
    INFO(language);
    if (!runs(needs)) continue;  // not on every machine
    const std::string name = std::string("by-") + language;
    CHECK(runs(program + "new solver " + name + " --language " + language + " && cd " + name + " && " +
               build + " && " + program + "run " + name + ".toml --no-cache --out results"));
    CHECK_THAT(content_of(scratch / name / "results/runs.csv"), contains("," + name + " 0.1,"));
  }
}

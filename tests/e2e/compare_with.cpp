#include <sstream>

#include "tests/catch.hpp"
#include "tests/e2e/program.hpp"
#include "tests/study_text.hpp"

// References that a study brings with it, and a ladder that is its own.
namespace {

std::string ladder(const std::string& head, const std::string& more = "") {
  return study_text("Ladder", "Second order",
                    couette_scene("cells = 8", "dt = 4e-3\noutputs = [0.1]") + R"([ladder]
axis = "space"
cells = [8, 16, 32, 64]
theoretical = 2
[[check]]
kind = "order"
locations = ["grid"]
lower = 1.85
upper = 2.15
reason = "theory: h^2, dt ~ h^2"
)" + more,
                    head);
}

Ended run(const ScratchDirectory& scratch, const std::string& study, const std::string& out) {
  return run_program("run " + scratch.write("s.toml", study) + " --out " + (scratch / out).string(),
                     "MPM_GNUPLOT=none MPM_CACHE=" + (scratch / "cache").string());
}

/// The exact solution on the lines of a table, as `reference` writes it.
std::string table_of(const ScratchDirectory& scratch, const std::string& factor) {
  REQUIRE(run_program("reference " + scratch.write("scene.toml", couette_scene()) + " --out " +
                      (scratch / "reference").string())
              .code == 0);
  std::istringstream in(content_of(scratch / "reference/profiles/scene.csv"));
  std::string text = "t,x,y,u,v\n", line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::vector<std::string> f;
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) f.push_back(field);
    text += f[0] + "," + f[2] + "," + f[3] + "," + std::to_string(std::stod(f[6]) * std::stod(factor) * 1e9) +
            "e-9,0\n";
  }
  return text;
}

}  // namespace

TEST_CASE("a ladder compares with its own finest level, and shows the order of the scheme") {
  const ScratchDirectory scratch;
  const Ended ended = run(scratch, ladder("compare_with = \"finest\"\n", R"([[check]]
kind = "error"
locations = ["grid"]
level = "n16"
upper = 2e-3
reason = "against the finest"
)"),
                          "out");
  INFO(ended.output);
  CHECK(ended.code == 0);
  CHECK(count(ended.output, "space order, grid") == 1);
  CHECK_THAT(content_of(scratch / "out/errors.csv"), contains("s.n32,"));
  CHECK(content_of(scratch / "out/errors.csv").find("s.n64,") == std::string::npos);  // it has no error
  // The same by somebody else's solver.
  const Ended theirs = run(scratch, ladder("compare_with = \"finest\"\n", R"([solver]
name = "theirs"
command = ["{mpm-verify}", "solve", "{scene}", "--out", "{out}", "--no-figures"]
)"),
                           "theirs");
  INFO(theirs.output);
  CHECK(theirs.code == 0);
  CHECK(content_of(scratch / "out/orders.csv") == content_of(scratch / "theirs/orders.csv"));

  const std::string finest_error =
      "[[check]]\nkind = \"error\"\nlevel = \"finest\"\nupper = 1\nreason = \"x\"\n";
  CHECK_THAT(run(scratch, ladder("compare_with = \"finest\"\n", finest_error), "x").output,
             contains("has nothing to be compared with"));
}

TEST_CASE("a table is a reference, as good as it says") {
  const ScratchDirectory scratch;
  const std::string head = "compare_with = \"table.csv\"\n", keys = "[compare_table]\nuncertainty = 1e-5\n",
                    error = R"([[check]]
kind = "error"
locations = ["grid"]
level = "finest"
upper = 1e-4
reason = "falls with h^2"
)";
  scratch.write("table.csv", table_of(scratch, "1"));
  const Ended ended = run(scratch, ladder(head, error + keys), "out");
  INFO(ended.output);
  CHECK(ended.code == 0);
  // Another table is another verdict: nothing is taken from the cache.
  scratch.write("table.csv", table_of(scratch, "1.01"));
  CHECK(run(scratch, ladder(head, error + keys), "out").code == 1);

  CHECK_THAT(run(scratch, ladder(head, error + "[compare_table]\nuncertainty = 1e-3\n"), "x").output,
             contains("cannot be shown by a table"));
  CHECK_THAT(run(scratch, ladder(head, error), "x").output,
             contains("compare_table.uncertainty' : is missing") ||
                 contains("'compare_table.uncertainty': is missing"));
  CHECK_THAT(run(scratch, replaced(ladder(head, error + keys), "[0.1]", "[0.1, 0.3]"), "x").output,
             contains("no rows at t = 0.3 s"));
  scratch.write("table.csv", "t,x,y,u,v\n0.1,0,0,0,0\n");
  CHECK_THAT(run(scratch, ladder(head, error + keys), "x").output, contains("fewer than two points"));
}

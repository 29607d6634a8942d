#include <algorithm>

#include "tests/catch.hpp"
#include "tests/study_text.hpp"
#include "tests/unit/verification/read_text.hpp"
#include "verification/config/config_error.hpp"
#include "verification/runs/foreign/delivery.hpp"
#include "verification/runs/foreign/pairing.hpp"

using namespace verification;

namespace {

const std::string check = R"([[check]]
kind = "error"
upper = 1
reason = "a bound"
)";

std::string with_solver(const std::string& solver, const std::string& more = "",
                        const std::string& head = "") {
  return study_text("Foreign", "Theirs", couette_scene() + "[solver]\n" + solver + "\n" + check + more, head);
}

const std::string plain = "command = [\"true\"]\nlocations = [\"grid\"]";

/// Nine nodes across the gap at both outputs.
std::vector<reports::ProfileRow> whole(const SceneConfig& scene) {
  std::vector<reports::ProfileRow> rows;
  for (const double t : scene.outputs)
    for (int j = 0; j <= 8; ++j)
      rows.push_back({t, "grid", 0, scene.scene.size.y() * j / 8, 1e-5 * j, 0, 0, 0});
  return rows;
}

void check_refused(const std::string& text, const std::string& because) {
  INFO(text);
  CHECK_THROWS_MATCHES(read_study_text(text), ConfigError,
                       Catch::Matchers::Predicate<ConfigError>([&](const auto& e) {
                         return std::string(e.what()).find(because) != std::string::npos;
                       }));
}

}  // namespace

TEST_CASE("a foreign profile must be whole, and what it lacks is named") {
  const Study study = read_study_text(with_solver(plain));
  const PlannedRun& plan = study.runs.front();
  const auto rows = whole(plan.scene);
  const auto lacks = [&](const std::vector<reports::ProfileRow>& these) {
    const auto all = shortcomings(these, plan, *study.solver);
    return all.empty() ? std::string() : all.front();
  };
  CHECK(lacks(rows).empty());

  auto late = rows;  // one time is missing
  std::erase_if(late, [](const auto& row) { return row.t == 0.2; });
  CHECK(lacks(late) == "found t = 0.1; expected 0.1, 0.2");
  CHECK(lacks({}) == "found no rows; expected t = 0.1, 0.2");

  auto single = rows;  // nearly the time that was meant, as single precision writes it
  for (auto& row : single) row.t = static_cast<float>(row.t);
  CHECK(lacks(single).empty());
  auto off = rows;
  for (auto& row : off) row.t *= 1 + 1e-4;
  CHECK_THAT(lacks(off), contains("expected 0.1, 0.2"));

  auto walls = rows;
  std::erase_if(walls, [](const auto& row) { return row.u > 0 && row.u < 7.5e-5; });
  CHECK_THAT(lacks(walls), contains("found 2 points; expected at least 8"));

  auto half = rows;  // enough points, all in the lower half
  for (auto& row : half) row.y /= 2;
  CHECK_THAT(lacks(half), contains("no gap wider than two cells"));

  auto twice = rows;
  twice.push_back(rows[3]);
  CHECK_THAT(lacks(twice), contains("is there twice"));
  auto outside = rows;
  outside[2].y = -1e-4;
  CHECK_THAT(lacks(outside), contains("lies outside the domain"));
  auto broken = rows;
  broken[2].u = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(lacks(broken), contains("is not finite"));
  auto named = rows;
  for (auto& row : named) row.location = "Grid";
  CHECK_THAT(lacks(named), contains("found location 'Grid'; expected grid"));
}

TEST_CASE("a solver's table is read with care: no empty command, no misspelt placeholder, no silent key") {
  CHECK(read_study_text(with_solver(plain)).solver->name == "true");
  CHECK(read_study_text(with_solver("command = \"true '{out} x'\"")).solver->command ==
        std::vector<std::string>{"true", "{out} x"});
  check_refused(with_solver("command = \"\""), "is empty");
  check_refused(with_solver("command = []"), "command");
  check_refused(with_solver("command = \"solve {output}\""),
                "'{output}' is no placeholder; there are {scene} {out}");
  // What a placeholder's name cannot be is somebody else's: an argument of a shell, a brace that stays open.
  for (const char* other : {"{1}", "{_}", "{-x}", "{}", "{out", "{a,b}", "{a b}"}) {
    INFO(other);
    CHECK_NOTHROW(read_study_text(with_solver("command = [\"solve\", \"" + std::string(other) + "\"]")));
  }
  check_refused(with_solver("command = \"solve {{output}\""), "'{output}' is no placeholder");
  check_refused(with_solver("command = \"a > b\""), "asks for a shell");
  check_refused(with_solver(plain, "", "repetitions = 2\n"), "a foreign solver is run once");
  check_refused(with_solver(plain + "\npoints_across = 4"), "points_reason");
  check_refused(with_solver(plain + "\ntimeout = -1"), "timeout");
  check_refused(with_solver(plain + "\ndelivers = [\"history\"]"), "must hold \"profile\"");
}

TEST_CASE("what a check or a figure reads must be delivered") {
  const std::string mass =
      "[[check]]\nkind = \"conservation\"\nquantity = \"mass\"\nupper = 1\nreason = \"x\"\n";
  check_refused(with_solver(plain, mass),
                "reads the history of a run, which the study's solver does not deliver");
  CHECK_NOTHROW(read_study_text(with_solver(plain + "\ndelivers = [\"profile\", \"history\"]", mass)));
  check_refused(
      with_solver(plain,
                  "[[check]]\nkind = \"scalar\"\nquantity = \"energy-error\"\nupper = 1\nreason = \"x\"\n"),
      "reads the history");
  check_refused(with_solver(plain, "[[figure]]\nkind = \"history\"\ntitle = \"x\"\n"),
                "a figure of kind \"history\"");
  // Locations default to what the solver delivers, and no others can be asked for.
  CHECK(read_study_text(with_solver(plain)).checks.front().locations ==
        std::vector<Location>{Location::Grid});
  check_refused(replaced(with_solver(plain), "upper = 1\n", "upper = 1\nlocations = [\"particles\"]\n"),
                "is not what the study's solver delivers");
}

TEST_CASE("rows of two files are paired by place, whatever their order") {
  std::vector<reports::ProfileRow> rows, others;
  for (int i = 0; i < 20; ++i)
    rows.push_back({0.1, "grid", 0.1 * (i % 5), 0.1 * (i / 5), double(i), 0, 0, 0});
  others = rows;
  std::ranges::rotate(others, others.begin() + 7);
  std::swap(others[2], others[11]);
  const auto pointers = [](const auto& list) {
    std::vector<const reports::ProfileRow*> found;
    for (const auto& row : list) found.push_back(&row);
    return found;
  };
  const auto paired = paired_by_place(pointers(rows), pointers(others), 1e-7);
  REQUIRE(paired.size() == rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) CHECK(paired[i]->u == rows[i].u);

  others[4].x += 1e-3;  // another place: no counterpart
  CHECK(paired_by_place(pointers(rows), pointers(others), 1e-7).empty());
  others.pop_back();
  CHECK(paired_by_place(pointers(rows), pointers(others), 1e-7).empty());
}

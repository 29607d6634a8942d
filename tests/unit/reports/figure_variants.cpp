#include <algorithm>

#include "reports/figures/figures.hpp"
#include "tests/catch.hpp"
#include "tests/study_text.hpp"
#include "tests/unit/verification/read_text.hpp"
#include "verification/config/config_error.hpp"

using namespace reports;

namespace {

/// Ladders of two variants.
Results ladders() {
  Results results;
  for (const char* variant : {"splines", "volumes"})
    for (const double h : {0.1, 0.05, 0.025})
      results.levels.push_back({"s", variant, "space", "grid", "l2", 1, h, h * h, true});
  return results;
}

const std::string two_variants = study_text("T", "C", couette_scene() + R"([ladder]
axis = "space"
cells = [4, 8, 16]
theoretical = 2
[[variant]]
name = "a"
[[variant]]
name = "b"
scheme.stepping = "musl"
[[check]]
kind = "order"
lower = 1
upper = 3
reason = "r"
[[figure]]
title = "F"
)");

FigureRecord figure_of(const std::string& keys) {
  return read_study_text(two_variants + keys).figures.front();
}

}  // namespace

TEST_CASE("a convergence figure draws the variants that it names", "[reports]") {
  FigureRecord record;
  record.figure = "f";
  record.study = "s";
  record.kind = "convergence";
  record.title = "A claim";
  record.location = "grid";
  record.norm = "l2";
  const std::string both = build_figure("", record, ladders()).script;
  CHECK_THAT(both, contains("splines"));
  CHECK_THAT(both, contains("volumes"));
  record.labels = "volumes";
  const std::string one = build_figure("", record, ladders()).script;
  CHECK_THAT(one, !contains("splines"));
  CHECK(one != both);
}

TEST_CASE("the variants of a figure are taken from its study, whatever its kind", "[reports]") {
  CHECK(figure_of("kind = \"convergence\"\n").labels.empty());
  CHECK(figure_of("kind = \"convergence\"\nvariants = [\"b\"]\n").labels == "b");
  CHECK(figure_of("kind = \"work-precision\"\n").runs.empty());
  CHECK(figure_of("kind = \"work-precision\"\nvariants = [\"b\"]\n").runs.find(".a.") == std::string::npos);
  const auto labelled =
      figure_of("kind = \"work-precision\"\nvariants = [\"b\"]\nlabels = [\"the second\"]\n");
  CHECK(std::ranges::count(labelled.labels, ';') == std::ranges::count(labelled.runs, ';'));
  CHECK(labelled.labels.starts_with("the second"));
  CHECK_THROWS_AS(figure_of("kind = \"work-precision\"\nlabels = [\"of two\"]\n"), verification::ConfigError);
  const std::string runs = figure_of("kind = \"work-precision\"\nvariants = [\"b\"]\n").runs;
  CHECK(std::count(runs.begin(), runs.end(), ';') == 2);  // all three levels
}

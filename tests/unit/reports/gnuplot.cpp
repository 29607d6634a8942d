#include "reports/figures/drawing/gnuplot.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include "reports/figures/drawing/figure_script.hpp"
#include "reports/files/atomic_file.hpp"
#include "tests/catch.hpp"
#include "tests/scratch_directory.hpp"
#include "tests/unit/reports/sample.hpp"

using namespace reports;

TEST_CASE("text cannot leave its quotes in a gnuplot script", "[reports]") {
  CHECK(gnuplot_text("it's `x` \\n @m") == "\"it\\047s \\140x\\140 \\134n \\100m\"");
  CHECK(gnuplot_text("a\nb\t\"") == "\"a\\nb \\042\"");
  if (!Gnuplot().available()) return;
  ScratchDirectory dir;
  for (const std::string evil :
       {"'; system('touch pwned'); print '`touch pwned`$(touch pwned)\"",
        "\"; system(\"touch pwned\"); print \"", "`touch pwned`", "\\\"; !touch pwned",
        "a\n!touch pwned\nsystem 'touch pwned'", "\\", "%s %d {/Symbol a"}) {
    FigureScript script(evil, evil, evil);
    script.line({{0, 0}, {1, 1}}, curve_colour(0), evil);
    INFO(evil);
    CHECK(Gnuplot().draw(dir.path(), {"f", script.text("f")}) == "");
    REQUIRE(std::filesystem::exists(dir / "f.svg"));
    CHECK_FALSE(std::filesystem::exists(dir / "pwned"));
    // It stands in the image as it was given: nothing of it was interpreted.
    CHECK_THAT(read_file(dir / "f.svg"), contains(evil.substr(0, evil.find('\n'))));
  }
}

TEST_CASE("drawn together or alone, figures are the same; one that fails takes none with it", "[reports]") {
  if (!Gnuplot().available()) return;
  std::vector<Drawing> drawings;
  for (const std::string name : {"a", "b", "c", "d", "e"}) {
    FigureScript script(name, "x", "y");
    script.line({{0, 0}, {1, 1}}, curve_colour(0), name);
    drawings.push_back({name, script.text(name)});
  }
  ScratchDirectory alone, together, flawed;
  for (const Drawing& drawing : drawings) CHECK(Gnuplot().draw(alone.path(), drawing) == "");
  CHECK(Gnuplot().draw(together.path(), drawings, 2) == std::vector<std::string>(5));
  drawings[1].script = "this is no command\n" + drawings[1].script;
  drawings[2].script.clear();
  const std::vector<std::string> said = Gnuplot().draw(flawed.path(), drawings, 2);
  CHECK_THAT(said[1], contains("b.gp") && contains("invalid command"));
  for (const std::size_t i : {0, 2, 3, 4}) CHECK(said[i] == "");
  for (const char* image : {".svg", ".png"}) {
    for (const std::string name : {"a", "b", "c", "d", "e"}) {
      const std::string bytes = read_file(alone / (name + image));
      CHECK(read_file(together / (name + image)) == bytes);
      const bool lost = name == "b" || name == "c";
      CHECK(std::filesystem::exists(flawed / (name + image)) != lost);
      if (!lost) CHECK(read_file(flawed / (name + image)) == bytes);
    }
  }
}

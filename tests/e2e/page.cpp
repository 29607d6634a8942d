#include <algorithm>
#include <regex>
#include <set>

#include "reports/files/program.hpp"
#include "reports/pages/browser.hpp"
#include "tests/catch.hpp"
#include "tests/e2e/program.hpp"
#include "tests/study_text.hpp"

namespace {

/// A browser's view of a page: what its elements are after the scripts have run, and what the console said.
struct Seen {
  std::string dom, console;
};

Seen look_at(const std::string& url, const ScratchDirectory& scratch) {
  const std::filesystem::path dom = scratch / "dom.html", log = scratch / "console.txt";
  const std::string sandbox = geteuid() == 0 ? "--no-sandbox " : "";
  const std::string command = "timeout 120 " + reports::browser() + " --headless " + sandbox +
                              "--disable-gpu --no-first-run --disable-background-networking "
                              "--disable-component-update --disable-sync --enable-logging=stderr --v=0 "
                              "--user-data-dir=" +
                              (scratch / "profile").string() + " --dump-dom '" + url + "' > " + dom.string() +
                              " 2> " + log.string();
  REQUIRE(std::system(command.c_str()) == 0);
  Seen seen{content_of(dom), ""};
  const std::string said = content_of(log);
  const std::regex line("[^\n]*CONSOLE[^\n]*");
  for (std::sregex_iterator it(said.begin(), said.end(), line), end; it != end; ++it)
    seen.console += it->str() + "\n";
  return seen;
}

/// Start tags of studies as the page shows them.
std::vector<std::string> studies(const std::string& dom) {
  std::vector<std::string> tags;
  const std::regex tag("<section class=\"study [^>]*>");
  for (std::sregex_iterator it(dom.begin(), dom.end(), tag), end; it != end; ++it) tags.push_back(it->str());
  return tags;
}

std::size_t visible(const std::string& dom) {
  return static_cast<std::size_t>(std::ranges::count_if(
      studies(dom), [](const std::string& tag) { return tag.find(" hidden") == tag.npos; }));
}

std::string study(const std::string& title, double lower, const std::string& transfer) {
  return study_text(title, "It converges", couette_scene() + R"([scheme]
transfer = ")" + transfer + R"("
[ladder]
axis = "space"
cells = [8, 16, 32]
theoretical = 2
[[check]]
kind = "order"
lower = )" + std::to_string(lower) + R"(
upper = 2.2
reason = "theory; coarse meshes"
[[figure]]
kind = "convergence"
title = "Second order"
[[figure]]
kind = "profiles"
title = "Profiles"
)");
}

}  // namespace

TEST_CASE("the page in a browser: no error, no figure missing, filters and links work") {
  if (reports::browser().empty()) {
    WARN("no browser is installed: the page was not looked at");
    return;
  }
  const ScratchDirectory scratch;
  std::filesystem::create_directories(scratch / "studies/good");
  std::filesystem::create_directories(scratch / "studies/bad");
  scratch.write("studies/good/one.toml", study("Primus", 1.8, "flip"));
  scratch.write("studies/good/two.toml", study("Secundus", 1.8, "apic"));
  scratch.write("studies/bad/three.toml", study("Tertius", 2.19, "flip"));
  const auto out = scratch / "out";
  const Ended ended = run_program("run --suite full --pdf --studies " + (scratch / "studies").string() +
                                  " --out " + out.string());
  INFO(ended.output);
  REQUIRE(ended.code == 1);
  // What failed is there to be looked into, and the report can be signed.
  CHECK(std::filesystem::exists(out / "profiles/three.n8.csv"));
  CHECK(content_of(out / "report.pdf").starts_with("%PDF"));

  const std::string url = "file://" + (out / "report.html").string();
  const Seen all = look_at(url, scratch);
  INFO(all.console);
  CHECK(all.console.empty());
  CHECK_THAT(all.dom, contains("data-ready=\"true\""));
  CHECK(visible(all.dom) == 3);
  CHECK_THAT(all.dom, contains("3 of 3 studies"));
  // The single failing study stands on the first screen and in the contents, and is open.
  CHECK(all.dom.find("id=\"failures\"") < all.dom.find("class=\"chapter\""));
  CHECK(count(all.dom, "class=\"study fail\"") == 1);
  CHECK(count(all.dom, "<b class=\"fail\">FAIL</b>") == 1);

  if (!reports::find_program("gnuplot").empty()) {
    CHECK(count(all.dom, "<svg id=\"fig-") == 6);
    CHECK(count(all.dom, "not-drawn") == 0);
    // Whatever a figure or a thumbnail refers to is in the page.
    const std::regex use("href=\"#([^\"]+)\"");
    std::set<std::string> wanted;
    for (std::sregex_iterator it(all.dom.begin(), all.dom.end(), use), end; it != end; ++it)
      wanted.insert((*it)[1]);
    for (const std::string& id : wanted) {
      INFO(id);
      CHECK(count(all.dom, "id=\"" + id + "\"") == 1);
    }
  }

  CHECK(visible(look_at(url + "?status=fail", scratch).dom) == 1);
  CHECK(visible(look_at(url + "?topic=Good", scratch).dom) == 2);
  CHECK(visible(look_at(url + "?scheme=apic", scratch).dom) == 1);
  CHECK(visible(look_at(url + "?q=secundus", scratch).dom) == 1);
  // A link to a study opens it, even where a filter would hide it.
  const Seen linked = look_at(url + "?status=fail#study-one", scratch);
  CHECK(visible(linked.dom) == 3);
  const std::size_t at = linked.dom.find("id=\"study-one\"");
  CHECK(linked.dom.find("<details open", at) < linked.dom.find("</section>", at));
}

TEST_CASE("without a browser a report that was to be printed says so") {
  const ScratchDirectory scratch;
  const std::string file = scratch.write("one.toml", study("One", 1.8, "flip"));
  const auto out = scratch / "out";
  const Ended ended =
      run_program("run " + file + " --pdf --out " + out.string(), "MPM_BROWSER=/nowhere/browser");
  INFO(ended.output);
  CHECK(ended.code == 0);
  CHECK_THAT(ended.output, contains("report.pdf not made: no browser"));
  CHECK_FALSE(std::filesystem::exists(out / "report.pdf"));
}

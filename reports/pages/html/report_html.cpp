#include "reports/pages/html/report_html.hpp"

#include <fmt/format.h>

#include "reports/pages/html/chapter.hpp"
#include "reports/pages/html/first_screen.hpp"
#include "reports/pages/html/inline_svg.hpp"
#include "reports/pages/html/page.hpp"
#include "reports/pages/html/svg_marks.hpp"
#include "reports/records/chapters.hpp"

namespace reports {
namespace {

/// Verdict, what made it, a place to sign, and the contents.
std::string title_page(const ReportData& data, const std::vector<Chapter>& chapters) {
  std::string text = fmt::format(
      "<section class=\"title-page\">\n<h1>Verification report</h1>\n<p><b class=\"{}\">{}</b></p>\n{}"
      "<p>Reviewed by ______________________________ on ____________________ Signature "
      "______________________________</p>\n<h3>Contents</h3>\n<ol>\n",
      passed(data.results) ? "pass" : "fail", html_text(verdict_line(data.results)),
      provenance_table(data.provenance));
  for (const Chapter& chapter : chapters)
    text += fmt::format("<li><a href=\"#{}\">{}</a>, {} studies</li>\n", chapter_anchor(chapter),
                        html_text(chapter.title), chapter.studies.size());
  return text + "</ol>\n</section>\n<h2>Verdict and scope</h2>\n";
}

}  // namespace

std::string html_report(const std::filesystem::path& dir, const ReportData& data, Medium medium) {
  const std::vector<Chapter> chapters = chapters_of(data);
  PageFigures figures(dir, data.figures);
  std::string main;
  if (medium == Medium::Paper) main += title_page(data, chapters);
  main += first_screen(data, chapters, figures);
  for (const Chapter& chapter : chapters) main += html_chapter(data, chapter, figures, medium);
  if (medium == Medium::Screen)
    main += "<section>\n<h2 id=\"provenance\">Provenance</h2>\n" + provenance_table(data.provenance) +
            "</section>\n";
  // Nobody unfolds paper.
  if (medium == Medium::Paper)
    for (std::size_t at = 0; (at = main.find("<details>", at)) != std::string::npos;)
      main.insert(at + 8, " open");
  return html_page(verdict_line(data.results), "<a class=\"skip\" href=\"#main\">Skip to the verdict</a>\n" +
                                                   svg_marks() + "<div class=\"layout\">\n" +
                                                   side_column(data, chapters) + "<main id=\"main\">\n" +
                                                   main + "</main>\n</div>\n");
}

}  // namespace reports

#include "reports/pages/html/figure.hpp"

#include <fmt/format.h>

#include "reports/files/atomic_file.hpp"
#include "reports/pages/html/inline_svg.hpp"
#include "reports/pages/html/page.hpp"

namespace reports {

PageFigures::PageFigures(const std::filesystem::path& dir, const std::vector<ReportFigure>& figures) {
  for (const ReportFigure& shown : figures) {
    const Figure& figure = shown.figure;
    Entry entry{&shown, "", "", false};
    if (shown.drawn) {
      entry.svg = inline_svg(read_file(dir / "figures" / (figure.name + ".svg")),
                             figure.title + ". " + figure.caption);
      const std::size_t box = entry.svg.find("viewBox=\"") + 9;
      if (!entry.svg.empty()) {
        entry.viewbox = entry.svg.substr(box, entry.svg.find('"', box) - box);
        entry.svg.insert(4, fmt::format(" id=\"fig-{}\"", html_text(figure.name)));
      }
    }
    order_.push_back(figure.name);
    entries_[figure.name] = std::move(entry);
  }
}

std::string PageFigures::shown(const std::string& name) {
  const auto found = entries_.find(name);
  if (found == entries_.end()) return "";
  Entry& entry = found->second;
  const Figure& figure = entry.figure->figure;
  if (entry.placed)
    return fmt::format("<p>Figure: <a href=\"#fig-{}\">{}</a></p>\n", html_text(name),
                       html_text(figure.title));
  entry.placed = true;
  std::string image = entry.svg;
  if (image.empty())
    image = fmt::format("<p class=\"faint not-drawn\">Not drawn: {}</p>",
                        figure.script.empty()
                            ? "there is nothing finite to draw."
                            : "see the warnings; the script is figures/" + html_text(name) + ".gp.");
  return fmt::format(
      "<figure>{}<figcaption><b>{}</b> {} <span class=\"faint\">({})</span></figcaption></figure>\n", image,
      html_text(figure.title), html_text(figure.caption), html_text(name));
}

std::string PageFigures::thumbnail(const std::string& name) const {
  const auto found = entries_.find(name);
  if (found == entries_.end() || found->second.svg.empty()) return "";
  return fmt::format(
      "<figure><a href=\"#fig-{0}\"><svg role=\"img\" aria-label=\"{1}\" viewBox=\"{2}\"><use "
      "href=\"#fig-{0}\"/></svg></a></figure>",
      html_text(name), html_text(found->second.figure->figure.title), found->second.viewbox);
}

std::vector<std::string> PageFigures::of_study(const std::string& study) const {
  std::vector<std::string> names;
  for (const std::string& name : order_)
    if (entries_.at(name).figure->figure.study == study) names.push_back(name);
  return names;
}

}  // namespace reports

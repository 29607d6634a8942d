#include "reports/pages/html/svg_marks.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <optional>
#include <string_view>

namespace reports {
namespace {

struct SvgMark {
  std::string shape, colour;
  double x = 0, y = 0, scale = 0;
};

/// The text between `before` and `after`, from `at` on; `at` moves behind it.
std::optional<std::string_view> between(std::string_view text, std::string_view before,
                                        std::string_view after, std::size_t& at) {
  if (text.substr(at, before.size()) != before) return std::nullopt;
  const std::size_t begin = at + before.size(), end = text.find(after, begin);
  if (end == text.npos) return std::nullopt;
  at = end + after.size();
  return text.substr(begin, end - begin);
}

/// The mark that begins at `at`, which then moves behind it; nothing for any other element.
std::optional<SvgMark> read_mark(std::string_view svg, std::size_t& at) {
  std::size_t end = at;
  const auto shape = between(svg, "<use href=\"", "\"", end);
  if (!shape) return std::nullopt;
  const auto x = between(svg, " transform=\"translate(", ",", end);
  const auto y = x ? between(svg, "", ")", end) : std::nullopt;
  const auto scale = y ? between(svg, "scale(", ")\"", end) : std::nullopt;
  const auto colour = scale ? between(svg, " color=\"", "\"/>", end) : std::nullopt;
  if (!colour) return std::nullopt;
  const auto number = [](std::string_view text) { return std::strtod(std::string(text).c_str(), nullptr); };
  SvgMark mark{std::string(*shape), std::string(*colour), number(*x), number(*y), number(*scale)};
  if (!(mark.scale > 0)) return std::nullopt;
  at = end;
  return mark;
}

bool alike(const SvgMark& a, const SvgMark& b) {
  return a.shape == b.shape && a.colour == b.colour && a.scale == b.scale;
}

}  // namespace

std::string gathered_marks(const std::string& svg) {
  std::string result;
  for (std::size_t at = 0; at < svg.size();) {
    const std::size_t next = svg.find("<use ", at);
    result += svg.substr(at, next - at);
    if (next == svg.npos) break;
    at = next;
    std::optional<SvgMark> mark = read_mark(svg, at);
    if (!mark) {
      result += svg[at++];
      continue;
    }
    const SvgMark first = *mark;
    result += fmt::format("<g transform=\"scale({:g})\" color=\"{}\">", first.scale, first.colour);
    while (mark && alike(*mark, first)) {
      result += fmt::format("<use href=\"{}\" x=\"{:.4g}\" y=\"{:.4g}\"/>", mark->shape,
                            mark->x / mark->scale, mark->y / mark->scale);
      const std::size_t before = at;
      mark = read_mark(svg, at);
      if (mark && !alike(*mark, first)) at = before;
    }
    result += "</g>";
  }
  return result;
}

std::string svg_marks() {
  // gnuplot 5.4 to 6.0, terminal svg, at the line width of figure_script.cpp.
  constexpr const char* stroke = "stroke-width=\"0.178\" stroke=\"currentColor\"";
  std::string marks = "<svg width=\"0\" height=\"0\" aria-hidden=\"true\" class=\"marks\"><defs>";
  const auto add = [&](const char* shape) { marks += fmt::format(fmt::runtime(shape), stroke); };
  marks += "<circle id=\"Dot\" r=\"0.5\" stroke-width=\"0.5\" stroke=\"currentColor\"/>";
  add("<path id=\"Pt0\" {} d=\"M-1,0 h2 M0,-1 v2\"/>");
  add("<path id=\"Pt1\" {} d=\"M-1,-1 L1,1 M1,-1 L-1,1\"/>");
  add("<path id=\"Pt2\" {} d=\"M-1,0 L1,0 M0,-1 L0,1 M-1,-1 L1,1 M-1,1 L1,-1\"/>");
  add("<rect id=\"Pt3\" {} x=\"-1\" y=\"-1\" width=\"2\" height=\"2\"/>");
  add("<rect id=\"Pt4\" {} fill=\"currentColor\" x=\"-1\" y=\"-1\" width=\"2\" height=\"2\"/>");
  add("<circle id=\"Pt5\" {} cx=\"0\" cy=\"0\" r=\"1\"/>");
  marks += "<use href=\"#Pt5\" id=\"Pt6\" fill=\"currentColor\" stroke=\"none\"/>";
  add("<path id=\"Pt7\" {} d=\"M0,-1.33 L-1.33,0.67 L1.33,0.67 z\"/>");
  marks +=
      "<use href=\"#Pt7\" id=\"Pt8\" fill=\"currentColor\" stroke=\"none\"/>"
      "<use href=\"#Pt7\" id=\"Pt9\" stroke=\"currentColor\" transform=\"rotate(180)\"/>"
      "<use href=\"#Pt9\" id=\"Pt10\" fill=\"currentColor\" stroke=\"none\"/>"
      "<use href=\"#Pt3\" id=\"Pt11\" stroke=\"currentColor\" transform=\"rotate(45)\"/>"
      "<use href=\"#Pt11\" id=\"Pt12\" fill=\"currentColor\" stroke=\"none\"/>";
  add("<path id=\"Pt13\" {} d=\"M0,1.330 L1.265,0.411 L0.782,-1.067 L-0.782,-1.076 L-1.265,0.411 z\"/>");
  marks += "<use href=\"#Pt13\" id=\"Pt14\" fill=\"currentColor\" stroke=\"none\"/>";
  return marks + "</defs></svg>\n";
}

}  // namespace reports

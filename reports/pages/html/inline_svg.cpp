#include "reports/pages/html/inline_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <string_view>
#include <utility>
#include <vector>

#include "reports/pages/html/page.hpp"
#include "reports/pages/html/svg_marks.hpp"

namespace reports {
namespace {

using Attributes = std::vector<std::pair<std::string, std::string>>;

// What nearly every group says again; the outermost element says it once.
const Attributes inherited = {{"fill", "none"},           {"stroke", "currentColor"},
                              {"stroke-linecap", "butt"}, {"stroke-linejoin", "miter"},
                              {"stroke-width", "1"},      {"font-family", "Helvetica,Arial,sans-serif"}};

/// "428.90" to "428.9", "12.00" to "12".
std::string shortened(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

/// Every number of a path or a list rounded, blanks gathered.
std::string rounded(std::string_view text, int decimals) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (std::isdigit(static_cast<unsigned char>(c)) || c == '-' || c == '.') {
      double value = 0;
      const auto [end, error] = std::from_chars(text.data() + i, text.data() + text.size(), value);
      if (error == std::errc()) {
        result += shortened(value, decimals);
        i = static_cast<std::size_t>(end - text.data());
        continue;
      }
    }
    const bool blank = std::isspace(static_cast<unsigned char>(c));
    if (!blank)
      result += c;
    else if (!result.empty() && result.back() != ' ')
      result += ' ';
    ++i;
  }
  while (!result.empty() && result.back() == ' ') result.pop_back();
  return result;
}

/// The path of gnuplot, lines between absolute points, with horizontals and verticals said by one number.
/// Anything else stays as rounded() has it.
std::string path(std::string_view text) {
  const std::string plain = rounded(text, 1);
  std::string result, x, y;
  std::size_t at = 0;
  while (at < plain.size()) {
    if (plain[at] == ' ') {
      ++at;
      continue;
    }
    const char command = plain[at];
    if (command == 'Z' || command == 'z') {
      result += command;
      ++at;
      continue;
    }
    const std::size_t comma = plain.find(',', at);
    if ((command != 'M' && command != 'L') || comma == plain.npos) return plain;
    const std::size_t end = std::min(plain.find(' ', comma), plain.size());
    const std::string to_x = plain.substr(at + 1, comma - at - 1),
                      to_y = plain.substr(comma + 1, end - comma - 1);
    if (command == 'L' && to_y == y)
      result += "H" + to_x;
    else if (command == 'L' && to_x == x)
      result += "V" + to_y;
    else
      result += command + to_x + "," + to_y;
    x = to_x;
    y = to_y;
    at = end;
  }
  return result;
}

/// "rgb(  0, 114, 178)" to "#0072b2".
std::string colour(const std::string& value) {
  if (!value.starts_with("rgb(")) return value;
  std::array<int, 3> part{};
  std::size_t at = 4;
  for (int& p : part) {
    while (at < value.size() && !std::isdigit(static_cast<unsigned char>(value[at]))) ++at;
    const auto [end, error] = std::from_chars(value.data() + at, value.data() + value.size(), p);
    if (error != std::errc()) return value;
    at = static_cast<std::size_t>(end - value.data());
  }
  return fmt::format("#{:02x}{:02x}{:02x}", part[0], part[1], part[2]);
}

Attributes attributes_of(std::string_view tag) {
  Attributes found;
  for (std::size_t at = tag.find('='); at != tag.npos; at = tag.find('=', at)) {
    std::size_t begin = at;
    while (begin > 0 && !std::isspace(static_cast<unsigned char>(tag[begin - 1]))) --begin;
    const std::size_t open = at + 1;
    if (open >= tag.size() || (tag[open] != '"' && tag[open] != '\'')) {
      ++at;
      continue;
    }
    const std::size_t close = tag.find(tag[open], open + 1);
    if (close == tag.npos) break;
    found.emplace_back(tag.substr(begin, at - begin), tag.substr(open + 1, close - open - 1));
    at = close;
  }
  return found;
}

std::string transform(const std::string& value) {
  std::string text;
  for (std::size_t at = 0; at < value.size();) {
    const std::size_t close = value.find(')', at);
    if (close == value.npos) break;
    const std::string part = value.substr(at, close + 1 - at);
    text += rounded(part, part.find("scale") != part.npos || part.find("matrix") != part.npos ? 3 : 1);
    at = close + 1;
  }
  return text;
}

/// One start tag, said again in fewer words.
std::string slim(const std::string& name, const Attributes& attributes, bool outer_group) {
  std::string text = "<" + name;
  for (auto [key, value] : attributes) {
    if (key == "id" || key == "class" || key == "xml:space") continue;
    if (key == "xlink:href") {
      key = "href";
      if (value.starts_with("#gp")) value = "#" + value.substr(3);  // as svg_marks() has them
    }
    if (key == "d")
      value = path(value);
    else if (key == "points")
      value = rounded(value, 1);
    else if (key == "transform")
      value = transform(value);
    else if (key == "stroke" || key == "fill" || key == "color")
      value = colour(value);
    else if (key == "stroke-width" || key == "font-size")
      value = rounded(value, 2);
    if (key == "color" && outer_group && value == "black") continue;
    if ((outer_group || key == "font-family") && std::ranges::count(inherited, std::pair{key, value}) > 0)
      continue;
    text += " " + key + "=\"" + value + "\"";
  }
  return text;
}

}  // namespace

std::string inline_svg(const std::string& svg, const std::string& label) {
  const std::size_t start = svg.find("<svg");
  if (start == svg.npos) return "";
  const std::size_t head = svg.find('>', start);
  std::string box;
  for (const auto& [key, value] : attributes_of(std::string_view(svg).substr(start, head - start)))
    if (key == "viewBox") box = value;
  if (box.empty()) return "";
  std::string result = fmt::format("<svg role=\"img\" aria-label=\"{}\" viewBox=\"{}\" color=\"black\"",
                                   html_text(label), box);
  for (const auto& [key, value] : inherited) result += " " + key + "=\"" + value + "\"";
  result += ">";

  // Where each open element begins in the result, and where its content does: an empty group is taken back.
  struct Open {
    std::string name;
    std::size_t begin, content;
  };
  std::vector<Open> open;
  std::size_t depth_of_groups = 0;
  for (std::size_t at = head + 1; at < svg.size();) {
    const std::size_t tag = svg.find('<', at);
    if (tag == svg.npos) break;
    const bool in_text = !open.empty() && (open.back().name == "text" || open.back().name == "tspan");
    if (in_text) result += svg.substr(at, tag - at);
    const std::size_t end = svg.find('>', tag);
    if (end == svg.npos) return "";
    at = end + 1;
    if (svg[tag + 1] == '/') {
      const std::string name = svg.substr(tag + 2, end - tag - 2);
      if (name == "svg") return gathered_marks(result) + "</svg>";
      if (open.empty() || open.back().name != name) return "";
      const bool empty = result.size() == open.back().content;
      depth_of_groups -= name == "g";
      if (empty && (name == "g" || name == "tspan"))
        result.erase(open.back().begin);
      else if (open.back().content > open.back().begin)
        result += "</" + name + ">";
      open.pop_back();
      continue;
    }
    const std::size_t name_end = svg.find_first_of(" \n\t/>", tag + 1);
    const std::string name = svg.substr(tag + 1, name_end - tag - 1);
    // Marks are shared, and a tooltip says no more than the legend.
    if (name == "defs" || name == "title" || name == "desc") {
      const std::string closing = "</" + name + ">";
      const std::size_t stop = svg.find(closing, end);
      if (stop == svg.npos) return "";
      at = stop + closing.size();
      continue;
    }
    const bool closed = svg[end - 1] == '/';
    const Attributes attributes =
        attributes_of(std::string_view(svg).substr(name_end, end - name_end - closed));
    if (name == "rect" &&
        std::ranges::count(attributes, std::pair<std::string, std::string>{"fill", "#ffffff"}) > 0)
      continue;  // the background: the page paints it, and its outline would be drawn
    const std::string slimmed = slim(name, attributes, name == "g" && depth_of_groups <= 2);
    if (closed) {
      result += slimmed + "/>";
      continue;
    }
    // A group that says nothing is no group.
    const std::string tag_text = slimmed == "<g" ? "" : slimmed + ">";
    open.push_back({name, result.size(), result.size() + tag_text.size()});
    depth_of_groups += name == "g";
    result += tag_text;
  }
  return "";
}

}  // namespace reports

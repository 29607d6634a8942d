#pragma once

#include <string>

namespace reports {

/// A figure of gnuplot's SVG terminal as an element that can stand in an HTML page: a third of the size, no
/// identifiers that would clash with other figures', marks taken from svg_marks(), coordinates to a tenth of
/// a pixel. `label` is what a screen reader says. "" for a text that is no such SVG.
std::string inline_svg(const std::string& svg, const std::string& label);

}  // namespace reports

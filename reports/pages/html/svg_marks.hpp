#pragma once

#include <string>

namespace reports {

/// gnuplot's marks, which the inlined figures of a page share: stands once, before the first of them.
std::string svg_marks();

/// Runs of one mark in one size and colour, `<use href transform="translate(x,y)scale(s)" color/>`, said as a
/// group of places: half of a figure with many points. Everything else stays as it is.
std::string gathered_marks(const std::string& svg);

}  // namespace reports

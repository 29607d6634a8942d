#include "reports/figures/drawing/figure_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "reports/figures/drawing/gnuplot.hpp"

namespace reports {

const char* curve_colour(std::size_t index) {
  static constexpr const char* colours[colour_count] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                        "#E69F00", "#56B4E9", "#000000"};
  return colours[index % colour_count];
}

Mark curve_mark(std::size_t index) {
  static constexpr Mark marks[] = {{7, 6}, {9, 8}, {5, 4}, {13, 12}, {11, 10}};
  return marks[index % std::size(marks)];
}

namespace {

/// Pixels of a PNG to one of its SVG: sharp on a page, and a third less to compress than with 1.5.
constexpr double png_scale = 1.25;

// Characters, not bytes: continuation bytes of UTF-8 take no room.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

}  // namespace

std::string wrap(const std::string& text, std::size_t width) {
  std::string lines, line, word;
  const auto take_word = [&] {
    if (word.empty()) return;
    if (!line.empty() && width_of(line) + 1 + width_of(word) > width) {
      lines += line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
    word.clear();
  };
  for (const char c : text) {
    if (c == ' ' || c == '\n') {
      take_word();
    } else {
      word += c;
    }
  }
  take_word();
  return lines + line;
}

Curve thinned(const Curve& curve, std::size_t count) {
  if (curve.size() <= count || count < 2) return curve;
  Curve few;
  for (std::size_t i = 0; i < count; ++i) few.push_back(curve[i * (curve.size() - 1) / (count - 1)]);
  return few;
}

FigureScript::FigureScript(std::string title, std::string x_label, std::string y_label)
    : title_(std::move(title)), x_label_(std::move(x_label)), y_label_(std::move(y_label)) {}

void FigureScript::x_range(double lower, double upper) {
  statement(fmt::format("set xrange [{:.6g}:{:.6g}]", lower, upper));
}

void FigureScript::y_range(double lower, double upper) {
  statement(fmt::format("set yrange [{:.6g}:{:.6g}]", lower, upper));
}

std::string FigureScript::add_data(const Curve& curve) {
  std::string block;
  for (const auto& [x, y] : curve) {
    if (!std::isfinite(x) || !std::isfinite(y) || (log_x_ && x <= 0) || (log_y_ && y <= 0)) {
      if (!block.empty()) block += "\n";  // a gap in a line, so that it does not bridge what is not there
      continue;
    }
    fmt::format_to(std::back_inserter(block), "{:.7g} {:.7g}\n", x, y);
  }
  if (block.empty()) return "";
  ++drawn_curves_;
  const std::string name = fmt::format("$curve_{}", ++data_blocks_);
  data_ += name + " << END\n" + block + "END\n";
  return name;
}

void FigureScript::add_plot(const std::string& data, const std::string& style, const std::string& legend) {
  if (data.empty()) return;
  if (!legend.empty()) {
    ++legend_entries_;
    longest_legend_ = std::max(longest_legend_, width_of(legend));
  }
  plots_.push_back(fmt::format("{} {} {}", data, style,
                               legend.empty() ? "notitle" : "title " + gnuplot_text(legend) + " noenhanced"));
}

void FigureScript::line(const Curve& curve, const std::string& colour, const std::string& legend,
                        double width, const std::string& dash) {
  add_plot(add_data(curve), fmt::format("with lines lw {} dt {} lc rgb '{}'", width, dash, colour), legend);
}

void FigureScript::points(const Curve& curve, const std::string& colour, int mark, const std::string& legend,
                          double size) {
  add_plot(add_data(curve),
           fmt::format("with points pt {} ps {}*mark_size lw 1.5 lc rgb '{}'", mark, size, colour), legend);
}

void FigureScript::line_and_points(const Curve& curve, const std::string& colour, int mark,
                                   const std::string& legend) {
  add_plot(add_data(curve),
           fmt::format("with linespoints lw 1.5 pt {} ps mark_size lc rgb '{}'", mark, colour), legend);
}

void FigureScript::error_bars(const std::vector<ErrorBar>& bars, const std::string& colour,
                              const std::string& legend) {
  Curve values;
  for (const ErrorBar& bar : bars) {
    values.emplace_back(bar.x, bar.y);
    line({{bar.x, bar.y - bar.half_height}, {bar.x, bar.y + bar.half_height}}, colour, "", 1.2);
  }
  points(values, colour, 7, legend, 0.7);
}

void FigureScript::band(const Curve& lower, const Curve& upper, const std::string& colour) {
  // A polygon: along the upper edge and back along the lower one. One that is not finite has no area.
  Curve outline = upper;
  outline.insert(outline.end(), lower.rbegin(), lower.rend());
  const bool finite = std::all_of(outline.begin(), outline.end(), [](const auto& p) {
    return std::isfinite(p.first) && std::isfinite(p.second);
  });
  if (!finite || lower.size() < 2) return;
  add_plot(add_data(outline),
           fmt::format("with filledcurves closed fs transparent solid 0.25 noborder lc rgb '{}'", colour),
           "");
}

void FigureScript::areas(const Curve& polygons, const std::string& colour, const std::string& legend) {
  add_plot(add_data(polygons),
           fmt::format("with filledcurves closed fs solid 1 noborder lc rgb '{}'", colour), legend);
}

void FigureScript::boxes(const Curve& tops, const std::string& colour, const std::string& legend) {
  // A width of its own: gnuplot takes it from the distance of neighbours, and draws nothing for a box alone.
  const std::string width = "set boxwidth 0.8 absolute";
  if (statements_.find(width) == std::string::npos) statement(width);
  add_plot(add_data(tops), fmt::format("with boxes fs solid 0.8 noborder lc rgb '{}'", colour), legend);
}

void FigureScript::legend_line(const std::string& colour, const std::string& legend, double width,
                               const std::string& dash) {
  add_plot("NaN", fmt::format("with lines lw {} dt {} lc rgb '{}'", width, dash, colour), legend);
}

void FigureScript::legend_mark(const std::string& colour, int mark, const std::string& legend) {
  add_plot("NaN", fmt::format("with points pt {} ps mark_size lw 1.5 lc rgb '{}'", mark, colour), legend);
}

std::string FigureScript::text(const std::string& name) const {
  // The legend stands below the diagram, in as many columns as its longest entry allows; the canvas grows
  // with it.
  const std::size_t columns = longest_legend_ <= 22   ? 4
                              : longest_legend_ <= 34 ? 3
                              : longest_legend_ <= 52 ? 2
                                                      : 1;
  const std::size_t rows = (legend_entries_ + columns - 1) / columns;
  const std::string title = wrap(title_, 88);
  const std::size_t title_rows = 1 + static_cast<std::size_t>(std::count(title.begin(), title.end(), '\n'));
  const std::size_t width = 960, height = 560 + 24 * rows + 22 * title_rows;

  std::string script = fmt::format(
      "# Draws {0}.svg and {0}.png here: gnuplot {0}.gp\n"
      "if (!exists('part')) part = ''\n"
      "set encoding utf8\n"
      "set border 3 lw 1 lc rgb '#444444'\n"
      "set tics nomirror out\n"
      "set grid back lw 0.6 dt solid lc rgb '#cccccc'\n",
      name);
  script += fmt::format("set title ({}) noenhanced\n", gnuplot_text(title));
  script += fmt::format("set xlabel ({}) noenhanced\nset ylabel ({}) noenhanced\n",
                        gnuplot_text(x_label_ + "\n "), gnuplot_text(y_label_));
  script += fmt::format(
      "set key outside below center horizontal maxcols {} Left reverse samplen 2 spacing 1.15\n", columns);

  if (log_x_) script += "set logscale x\n";
  if (log_y_) script += "set logscale y\nset format y '10^{%T}'\n";
  script += statements_ + data_;
  script += fmt::format(
      "set terminal svg size {},{} enhanced font 'Helvetica,Arial,sans-serif,15' background '#ffffff'\n"
      "set output '{}.svg'.part\n"
      // The two terminals draw the same point size differently.
      "mark_size = 0.6\nplot ",
      width, height, name);
  for (std::size_t i = 0; i < plots_.size(); ++i) script += (i ? ", \\\n     " : "") + plots_[i];
  script += fmt::format(
      "\nset terminal pngcairo size {:.0f},{:.0f} enhanced font 'sans,11' fontscale {} linewidth {} "
      "pointscale {} "
      "background '#ffffff'\nset output '{}.png'.part\nmark_size = 1\nreplot\nunset output\n",
      png_scale * width, png_scale * height, png_scale, png_scale, png_scale, name);
  return script;
}

std::string panels_text(const std::string& name, const std::string& title, std::vector<FigureScript>& panels,
                        std::size_t columns) {
  const FigureScript& first = panels.front();
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  const std::size_t legend_columns = std::max<std::size_t>(1, 110 / (first.longest_legend_ + 8));
  const std::size_t legend_rows = (first.legend_entries_ + legend_columns - 1) / legend_columns;
  const std::string heading = wrap(title, 100);
  const std::size_t title_rows =
      1 + static_cast<std::size_t>(std::count(heading.begin(), heading.end(), '\n'));
  const double legend_height = 24.0 * static_cast<double>(legend_rows) + 10,
               title_height = 24.0 * static_cast<double>(title_rows) + 52;
  const double width = 1120, height = 330.0 * static_cast<double>(rows) + legend_height + title_height + 66;

  std::string script = fmt::format(
      "# Draws {0}.svg and {0}.png here: gnuplot {0}.gp\n"
      "if (!exists('part')) part = ''\n"
      "set encoding utf8\n"
      "set border 3 lw 1 lc rgb '#444444'\n"
      "set tics nomirror out\n"
      "set grid back lw 0.6 dt solid lc rgb '#cccccc'\n",
      name);
  std::string drawing;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    FigureScript& panel = panels[p];
    const std::string mark = fmt::format("$panel_{}_", p);
    const auto named = [&](std::string text) {
      for (std::size_t at = 0; (at = text.find("$curve_", at)) != text.npos; at += mark.size())
        text.replace(at, 7, mark);
      return text;
    };
    script += named(panel.data_);
    drawing +=
        fmt::format("set title ({}) noenhanced\nset xlabel ({}) noenhanced\nset ylabel ({}) noenhanced\n",
                    gnuplot_text(panel.title_),
                    // Under the lowest panel of a column; the titles of the next row would cover others.
                    gnuplot_text(p + columns >= panels.size() ? panel.x_label_ : ""),
                    gnuplot_text(p % columns == 0 ? panel.y_label_ : ""));
    drawing += p == 0 ? fmt::format(
                            "set key at screen 0.5,{:.4f} center bottom vertical maxrows {} Left "
                            "reverse samplen 2 spacing 1.15 width 2\n",
                            6 / height, legend_rows)
                      : "unset key\n";
    if (panel.log_x_) drawing += "set logscale x\n";
    if (panel.log_y_) drawing += "set logscale y\nset format y '10^{%T}'\n";
    drawing += panel.statements_ + "plot ";
    for (std::size_t i = 0; i < panel.plots_.size(); ++i)
      drawing += (i ? ", \\\n     " : "") + named(panel.plots_[i]);
    drawing += "\n";
  }
  const std::string layout = fmt::format(
      "set multiplot layout {},{} title {} noenhanced margins screen 0.075,0.985,{:.4f},{:.4f} spacing "
      "screen "
      "0.055,{:.4f}\n",
      rows, columns, gnuplot_text(heading), (legend_height + 74) / height, 1 - title_height / height,
      95 / height);
  script += fmt::format(
      "set terminal svg size {:.0f},{:.0f} enhanced font 'Helvetica,Arial,sans-serif,14' background "
      "'#ffffff'\n"
      "set output '{}.svg'.part\nmark_size = 0.6\n",
      width, height, name);
  script += layout + drawing + "unset multiplot\n";
  script += fmt::format(
      "set terminal pngcairo size {:.0f},{:.0f} enhanced font 'sans,10' fontscale {} linewidth {} pointscale "
      "{} "
      "background '#ffffff'\nset output '{}.png'.part\nmark_size = 1\n",
      png_scale * width, png_scale * height, png_scale, png_scale, png_scale, name);
  return script + layout + drawing + "unset multiplot\nunset output\n";
}

}  // namespace reports

#pragma once

#include <string>
#include <utility>
#include <vector>

namespace reports {

/// Points of one curve, in the units of the axes.
using Curve = std::vector<std::pair<double, double>>;

/// A value with a symmetric uncertainty.
struct ErrorBar {
  double x, y, half_height;
};

/// Colours that stay apart for colour-blind readers (Okabe & Ito 2008); counts on from the start when
/// exhausted.
const char* curve_colour(std::size_t index);
constexpr std::size_t colour_count = 7;

/// Marks of one shape, filled and hollow; counts on from the start when exhausted.
struct Mark {
  int filled, hollow;
};
Mark curve_mark(std::size_t index);

/// `text` broken at blanks into lines of at most `width` characters where its words allow.
std::string wrap(const std::string& text, std::size_t width);

/// Every stride-th point so that at most `count` stay; first and last always among them.
Curve thinned(const Curve& curve, std::size_t count);

/// A gnuplot script with its data inline that draws one diagram as SVG and as PNG. Points that are not finite
/// (or not positive on a logarithmic axis) are left out, and break a line. Text is taken literally.
class FigureScript {
 public:
  FigureScript(std::string title, std::string x_label, std::string y_label);

  void logarithmic_x() { log_x_ = true; }
  void logarithmic_y() { log_y_ = true; }
  /// A statement of gnuplot, taken as it is: no user's text in here.
  void statement(const std::string& line) { statements_ += line + "\n"; }
  /// Fix the range of x or y.
  void x_range(double lower, double upper);
  void y_range(double lower, double upper);

  void line(const Curve& curve, const std::string& colour, const std::string& legend, double width = 2,
            const std::string& dash = "solid");
  void points(const Curve& curve, const std::string& colour, int mark, const std::string& legend,
              double size = 0.8);
  /// Marks joined by a thin line.
  void line_and_points(const Curve& curve, const std::string& colour, int mark, const std::string& legend);
  /// Points with bars from y - half_height to y + half_height.
  void error_bars(const std::vector<ErrorBar>& bars, const std::string& colour, const std::string& legend);
  /// The area between two curves over the same places, pale.
  void band(const Curve& lower, const Curve& upper, const std::string& colour);
  /// Filled polygons, each closed; a point that is not finite stands between two.
  void areas(const Curve& polygons, const std::string& colour, const std::string& legend);
  /// Bars from zero over whole numbers, nearly as wide as these lie apart.
  void boxes(const Curve& tops, const std::string& colour, const std::string& legend);
  /// A legend entry without data.
  void legend_line(const std::string& colour, const std::string& legend, double width = 2,
                   const std::string& dash = "solid");
  void legend_mark(const std::string& colour, int mark, const std::string& legend);

  bool empty() const { return drawn_curves_ == 0; }
  /// The script that draws <name>.svg and <name>.png into the directory in which gnuplot is started.
  std::string text(const std::string& name) const;

 private:
  friend std::string panels_text(const std::string&, const std::string&, std::vector<FigureScript>&,
                                 std::size_t);
  std::string add_data(const Curve& curve);
  void add_plot(const std::string& data, const std::string& style, const std::string& legend);

  std::string title_, x_label_, y_label_, statements_, data_;
  std::vector<std::string> plots_;
  std::size_t legend_entries_ = 0, longest_legend_ = 0, data_blocks_ = 0, drawn_curves_ = 0;
  bool log_x_ = false, log_y_ = false;
};

/// Like FigureScript::text() for several diagrams of one size under one title, `columns` side by side, with
/// the legend of the first for all of them.
std::string panels_text(const std::string& name, const std::string& title, std::vector<FigureScript>& panels,
                        std::size_t columns);

}  // namespace reports

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/figures/drawing/figure_script.hpp"
#include "reports/figures/figures.hpp"

namespace reports {
namespace {

std::vector<const ValidationRecord*> points_of(const FigureRecord& record, const Results& results) {
  std::vector<const ValidationRecord*> points;
  for (const ValidationRecord& r : results.validation)
    if (r.study == record.study && r.quantity == record.component) points.push_back(&r);
  return points;
}

/// What the values stand over: the coordinate that varies.
struct Abscissa {
  std::string label;
  double ValidationRecord::*member;
};

Abscissa abscissa_of(const std::vector<const ValidationRecord*>& points) {
  const std::string unit = points.front()->unit == "1" ? "1" : "m";
  for (const Abscissa& one : {Abscissa{"y [" + unit + "]", &ValidationRecord::y},
                              Abscissa{"x [" + unit + "]", &ValidationRecord::x}}) {
    const double first = points.front()->*one.member;
    if (std::ranges::any_of(points, [&](const auto* p) { return p->*one.member != first; }) &&
        !std::isnan(first))
      return one;
  }
  return {unit == "1" ? "t [1]" : "t [s]", &ValidationRecord::t};
}

std::vector<std::string> variants_of(const std::vector<const ValidationRecord*>& points) {
  std::vector<std::string> variants;
  for (const ValidationRecord* p : points)
    if (std::ranges::count(variants, p->variant) == 0) variants.push_back(p->variant);
  return variants;
}

/// Tic marks at 1, 2 and 5 times powers of ten within a range, as gnuplot lists them: on less than a few
/// decades its own, one a decade, leave an axis bare.
std::string tics_between(double lower, double upper) {
  std::string tics;
  for (int decade = static_cast<int>(std::floor(std::log10(lower))); std::pow(10, decade) <= upper; ++decade)
    for (const double mantissa : {1.0, 2.0, 5.0}) {
      const double at = mantissa * std::pow(10, decade);
      if (at >= lower && at <= upper) tics += fmt::format("{}'{:g}' {:g}", tics.empty() ? "" : ", ", at, at);
    }
  return "(" + tics + ")";
}

const char* const point_caption =
    "Black: measured, bars of k u_D. Colour: simulated, band (bar where there is one value) of "
    "k sqrt(u_num^2 + u_input^2).";

}  // namespace

Figure validation_figure(const FigureRecord& record, const Results& results) {
  Figure figure;
  const auto points = points_of(record, results);
  if (points.empty()) return figure;
  const Abscissa abscissa = abscissa_of(points);
  FigureScript script(record.title, abscissa.label,
                      fmt::format("{} [{}]", record.component, points.front()->unit));
  const auto variants = variants_of(points);
  for (std::size_t v = 0; v < variants.size(); ++v) {
    std::vector<const ValidationRecord*> mine;
    for (const ValidationRecord* p : points)
      if (p->variant == variants[v]) mine.push_back(p);
    std::ranges::stable_sort(mine, {}, [&](const auto* p) { return p->*abscissa.member; });
    Curve simulated, lower, upper;
    for (const ValidationRecord* p : mine) {
      const double at = p->*abscissa.member, half = p->coverage * std::hypot(p->u_num, p->u_input);
      simulated.emplace_back(at, p->simulated);
      lower.emplace_back(at, p->simulated - half);
      upper.emplace_back(at, p->simulated + half);
    }
    const std::string name = variants[v].empty() ? "simulated" : variants[v];
    script.band(lower, upper, curve_colour(v));
    if (simulated.size() > 1)
      script.line(simulated, curve_colour(v), name);
    else  // a band over one place has no area
      script.error_bars({{simulated[0].first, simulated[0].second, upper[0].second - simulated[0].second}},
                        curve_colour(v), name);
    if (v > 0) continue;  // every variant has the same data beside it
    std::vector<ErrorBar> bars;
    for (const ValidationRecord* p : mine)
      bars.push_back({p->*abscissa.member, p->measured, p->coverage * p->u_data});
    script.error_bars(bars, "#000000", "measured");
  }
  figure.script = script.text(record.figure);
  figure.caption = point_caption;
  return figure;
}

Figure validation_parts_figure(const FigureRecord& record, const Results& results) {
  Figure figure;
  const auto points = points_of(record, results);
  if (points.empty()) return figure;
  FigureScript script(record.title + ": where u_val comes from", "point, in the order of validation.csv",
                      "share of u_val^2 [%]");
  const char* const names[] = {"numerics (u_num)", "inputs (u_input)", "data (u_D)"};
  std::vector<Curve> tops(3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ValidationRecord& p = *points[i];
    const double parts[] = {p.u_num, p.u_input, std::isnan(p.u_data) ? 0 : p.u_data};
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      sum += p.u_val > 0 ? 100 * parts[k] * parts[k] / (p.u_val * p.u_val) : std::nan("");
      tops[k].emplace_back(static_cast<double>(i + 1), sum);
    }
  }
  // From the whole down, so that each part is drawn over what it is below.
  for (std::size_t k = 3; k-- > 0;) script.boxes(tops[k], curve_colour(k), names[k]);
  script.x_range(0.4, static_cast<double>(points.size()) + 0.6);
  script.y_range(0, 100);
  figure.script = script.text(record.figure);
  figure.caption = "The variance of E, divided among its three independent parts.";
  return figure;
}

Figure computed_measured_figure(const FigureRecord& record, const Results& results) {
  Figure figure;
  const auto bias =
      std::ranges::find(results.validation_bias, record.component, &ValidationBiasRecord::quantity);
  if (bias == results.validation_bias.end()) return figure;
  std::vector<std::string> studies;
  std::vector<Curve> clouds;
  double least = INFINITY, most = 0;
  for (const ValidationRecord& r : results.validation) {
    if (r.quantity != record.component || !(r.measured > 0 && r.simulated > 0)) continue;
    auto at = static_cast<std::size_t>(std::ranges::find(studies, r.study) - studies.begin());
    if (at == studies.size()) {
      studies.push_back(r.study);
      clouds.emplace_back();
    }
    clouds[at].emplace_back(r.measured, r.simulated);
    least = std::min({least, r.measured, r.simulated});
    most = std::max({most, r.measured, r.simulated});
  }
  if (clouds.empty()) return figure;
  FigureScript script(record.title, "measured " + record.component, "computed " + record.component);
  script.logarithmic_x();
  script.logarithmic_y();
  const double lower = least / 1.25, upper = most * 1.25;
  script.x_range(lower, upper);
  script.y_range(lower, upper);
  constexpr double few_decades = 1e3;
  if (upper < few_decades * lower)
    for (const char* axis : {"x", "y"})
      script.statement(fmt::format("set {}tics {}", axis, tics_between(lower, upper)));
  const auto ray = [&](double factor) { return Curve{{lower, factor * lower}, {upper, factor * upper}}; };
  const double spread_e = std::exp(2 * bias->data_scatter), spread_m = std::exp(2 * bias->scatter);
  script.line(ray(1), "#000000", "equal", 1.3);
  script.line(ray(spread_e), "#888888", "± 2 sigma_E", 1, "2");
  script.line(ray(1 / spread_e), "#888888", "", 1, "2");
  script.line(ray(bias->bias), curve_colour(1), "bias", 1.5);
  script.line(ray(bias->bias * spread_m), curve_colour(1), "bias ± 2 sigma_M", 1, "2");
  script.line(ray(bias->bias / spread_m), curve_colour(1), "", 1, "2");
  for (std::size_t s = 0; s < clouds.size(); ++s)
    script.points(clouds[s], curve_colour(s), curve_mark(s).filled, studies[s]);
  figure.script = script.text(record.figure);
  figure.caption = fmt::format(
      "Bias {:.4g}, scatter of the model {:.3g}, of the data {:.3g}, from {} positive values of {} studies.",
      bias->bias, bias->scatter, bias->data_scatter, bias->pairs, bias->studies);
  return figure;
}

}  // namespace reports

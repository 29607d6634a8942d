#include "tests/bench/bench_figures.hpp"

#include <fmt/format.h>

#include "reports/figures/drawing/figure_script.hpp"
#include "reports/figures/drawing/gnuplot.hpp"
#include "tests/bench/count/work_count.hpp"

namespace bench {
namespace {

using reports::Curve;
using reports::curve_colour;
using reports::curve_mark;
using reports::FigureScript;

constexpr const char* rate_label = "rate [million particle-steps/s]";

double millions(const Collector& rates, const std::string& name) {
  return rates.rate(name, "particle-steps").value / 1e6;
}

/// Rates of a benchmark over the number of particles.
Curve over_sizes(const Collector& rates, const std::string& begin, const std::string& end) {
  Curve curve;
  for (const long n : {800L, 10'000L, 100'000L, 1'000'000L}) {
    const std::string name = begin + std::to_string(n) + end;
    if (rates.has(name)) curve.emplace_back(n, millions(rates, name));
  }
  return curve;
}

std::string size_figure(const Collector& rates) {
  const Curve lanes = over_sizes(rates, "step/linear_newtonian/", "/1");
  const Curve two = over_sizes(rates, "step/linear_threads/", "/2/real_time");
  const Curve plain = over_sizes(rates, "plain_step/newtonian/", "");
  std::string title = "Rate of a step against the number of particles";
  if (!lanes.empty() && !plain.empty())
    title = fmt::format("Vector kernels: {:.1f} times the plain loop on the paper's 800 particles",
                        lanes.front().second / plain.front().second);
  FigureScript script(title, "particles", rate_label);
  script.logarithmic_x();
  script.logarithmic_y();
  script.statement("set format x '10^{%T}'");
  script.line_and_points(lanes, curve_colour(0), curve_mark(0).filled, "vector kernels, one thread");
  script.line_and_points(two, curve_colour(1), curve_mark(1).filled, "vector kernels, two threads");
  script.line_and_points(plain, curve_colour(2), curve_mark(2).filled, "plain loop");
  const auto roof = [&](const std::string& peak, const std::string& unit, double work,
                        const std::string& text, const char* dash) {
    if (!rates.has(peak)) return;
    const double height = rates.rate(peak, unit).value / work / 1e6;
    script.line({{800, height}, {1e6, height}}, "#555555", text, 1.5, dash);
  };
  roof("peak/arithmetic", "operations", kernel_operations_per_particle_step(), "peak arithmetic of one core",
       "2");
  roof("peak/bandwidth/72", "bytes", bytes_per_particle_step, "memory bandwidth of one core, of 72 MiB", "3");
  return script.empty() ? "" : script.text("bench-size");
}

std::string scheme_figure(const Collector& rates) {
  std::string title = "Rate of every basis and fluid, FLIP, 800 particles, one thread";
  const std::string linear = "step/linear_newtonian/800/1", cubic = "step/cubic_newtonian/800/1",
                    power_law = "step/linear_power_law/800/1";
  if (rates.has(linear) && rates.has(cubic) && rates.has(power_law))
    title = fmt::format(
        "Cubic splines cost {:.1f} times the linear basis, a power law {:.1f} times a Newtonian fluid (FLIP)",
        millions(rates, linear) / millions(rates, cubic),
        millions(rates, linear) / millions(rates, power_law));
  FigureScript script(title, "", rate_label);
  script.logarithmic_y();
  script.statement("set xrange [0.5:4.5]");
  script.statement("set xtics ('plain loop, linear' 1, 'linear' 2, 'quadratic' 3, 'cubic' 4)");
  std::size_t colour = 0;
  for (const std::string fluid : {"newtonian", "cross", "power_law"}) {
    Curve curve;
    const auto add = [&](double place, const std::string& name) {
      if (rates.has(name)) curve.emplace_back(place, millions(rates, name));
    };
    add(1, "plain_step/" + fluid + "/800");
    double place = 2;
    for (const std::string basis : {"linear", "quadratic", "cubic"})
      add(place++, "step/" + basis + "_" + fluid + "/800/1");
    script.points(curve, curve_colour(colour), curve_mark(colour).filled,
                  fluid == "power_law" ? "power law"
                  : fluid == "cross"   ? "Cross"
                                       : "Newtonian",
                  1.3);
    ++colour;
  }
  return script.empty() ? "" : script.text("bench-schemes");
}

}  // namespace

std::string draw_figures(const std::filesystem::path& directory, const Collector& rates) {
  const reports::Gnuplot gnuplot;
  if (!gnuplot.available()) return "no figures: " + gnuplot.wanted() + " is not there; install gnuplot-nox";
  std::string said;
  const auto draw = [&](const char* name, const std::string& script) {
    if (said.empty() && !script.empty()) said = gnuplot.draw(directory, {name, script});
  };
  draw("bench-size", size_figure(rates));
  draw("bench-schemes", scheme_figure(rates));
  return said;
}

}  // namespace bench

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "reports/figures/drawing/figure_script.hpp"
#include "reports/figures/figures.hpp"
#include "reports/files/io_error.hpp"
#include "reports/records/directory/run_files.hpp"

namespace reports {
namespace {

constexpr std::size_t most_times = 6, most_points = 60;

struct Sample {
  double across, along, value, exact;
};

std::vector<Sample> samples_of(const std::vector<ProfileRow>& rows, const FigureRecord& record, double t,
                               const std::string& location) {
  std::vector<Sample> samples;
  const bool across_x = record.across == "x", along_v = record.component == "v";
  for (const ProfileRow& row : rows) {
    if (row.t != t || row.location != location) continue;
    samples.push_back({across_x ? row.x : row.y, across_x ? row.y : row.x, along_v ? row.v : row.u,
                       along_v ? row.v_exact : row.u_exact});
  }
  return samples;
}

Curve exact_curve(std::vector<Sample> samples) {
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) { return a.across < b.across; });
  Curve curve;
  for (const Sample& s : samples) curve.emplace_back(s.across, s.exact);
  return curve;
}

// A legible cut through a field of points: those nearest to the line along = `position`, which for points on
// a lattice is one column of it, thinned evenly across.
Curve cut(std::vector<Sample> samples, double position) {
  const auto distance = [&](const Sample& s) { return std::abs(s.along - position); };
  if (samples.size() > most_points) {
    std::vector<double> distances;
    for (const Sample& s : samples) distances.push_back(distance(s));
    const auto nth = distances.begin() + (most_points - 1);
    std::nth_element(distances.begin(), nth, distances.end());
    // On a lattice the 60th nearest point lies columns away; the nearest column alone tells as much.
    const double nearest = *std::min_element(distances.begin(), nth + 1);
    double extent = 0;
    for (const Sample& s : samples) extent = std::max(extent, std::abs(s.across));
    const double same = 1e-6 * extent;
    const auto in_nearest = std::count_if(samples.begin(), samples.end(),
                                          [&](const Sample& s) { return distance(s) <= nearest + same; });
    const double reach = in_nearest >= 5 ? nearest + same : *nth;
    samples.erase(
        std::remove_if(samples.begin(), samples.end(), [&](const Sample& s) { return distance(s) > reach; }),
        samples.end());
  }
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) {
    return a.across != b.across ? a.across < b.across : a.along < b.along;
  });
  Curve curve;
  for (const Sample& s : samples) {
    const bool repeated =
        !curve.empty() && std::abs(curve.back().first - s.across) <= 1e-9 * std::abs(s.across);
    if (!repeated) curve.emplace_back(s.across, s.value);
  }
  return thinned(curve, most_points);
}

struct ProfileCurve {
  std::string location;  // "exact" for the line
  std::size_t run, time;
  Curve curve;
};

// A shape for each location, or for each run where there is but one location.
int mark_of(const std::vector<std::string>& locations, const std::string& location, std::size_t run) {
  return curve_mark(locations.size() == 1 ? run : location == "grid" ? 0 : 1).filled;
}

}  // namespace

Figure profiles_figure(const std::filesystem::path& dir, const FigureRecord& record, const Results& results) {
  if ((record.across != "x" && record.across != "y") ||
      (record.component != "u" && record.component != "v")) {
    throw IoError(
        fmt::format("figures.csv: figure '{}' needs across = x or y and component = u or v", record.figure));
  }
  const std::vector<LabelledRun> runs = runs_of(record, results);
  const std::vector<std::string> locations = locations_of(record);
  std::map<const RunRecord*, std::vector<ProfileRow>> rows_of;
  std::vector<double> all_times;
  for (const LabelledRun& run : runs) {
    std::vector<ProfileRow>& rows = rows_of[run.run] = read_profile(dir, run.run->run);
    for (const ProfileRow& row : rows) all_times.push_back(row.t);
  }
  const std::vector<double> times = chosen_times(all_times, most_times);
  // One run: a colour a time. Several: a colour a run, times told apart by the curves' order.
  const bool by_time = runs.size() <= 1;

  std::vector<ProfileCurve> curves;
  double largest_across = 0, largest_value = 0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const std::vector<ProfileRow>& rows = rows_of[runs[r].run];
    for (std::size_t i = 0; i < times.size(); ++i) {
      std::vector<Sample> exact = samples_of(rows, record, times[i], "exact");
      if (exact.empty()) exact = samples_of(rows, record, times[i], "grid");
      double position = std::numeric_limits<double>::infinity();
      for (const Sample& s : exact) position = std::min(position, s.along);
      if (!std::isfinite(position)) position = 0;
      curves.push_back({"exact", r, i, exact_curve(exact)});
      for (const std::string& location : locations) {
        curves.push_back({location, r, i, cut(samples_of(rows, record, times[i], location), position)});
      }
    }
  }
  for (const ProfileCurve& c : curves) {
    for (const auto& [across, value] : c.curve) {
      if (std::isfinite(across)) largest_across = std::max(largest_across, std::abs(across));
      if (std::isfinite(value)) largest_value = std::max(largest_value, std::abs(value));
    }
  }

  const Unit length = readable_length(largest_across), speed = readable_length(largest_value);
  FigureScript script(record.title, fmt::format("{} [{}]", record.across, length.name),
                      fmt::format("velocity {} [{}/s]", record.component, speed.name));
  bool any_exact = false, one_line = !by_time;
  for (std::size_t i = 0; i < times.size() && one_line; ++i) {
    std::vector<Curve> exact;
    for (const ProfileCurve& c : curves) {
      if (c.location == "exact" && c.time == i) exact.push_back(c.curve);
    }
    one_line = coincide(exact, largest_value);
  }
  for (ProfileCurve& c : curves) {
    for (auto& [across, value] : c.curve) {
      // Round-off below zero would make the axis reach a whole tick further down.
      if (std::abs(value) < 1e-9 * largest_value) value = 0;
      across *= length.factor;
      value *= speed.factor;
    }
    const char* colour = curve_colour(by_time ? c.time : c.run);
    if (c.location == "exact") {
      any_exact = any_exact || std::any_of(c.curve.begin(), c.curve.end(),
                                           [](const auto& p) { return std::isfinite(p.second); });
      if (!one_line || c.run == 0) script.line(c.curve, one_line ? "#000000" : colour, "", 1.3);
    } else {
      script.points(c.curve, colour, mark_of(locations, c.location, c.run), "", 0.7);
    }
  }
  Figure figure;
  if (script.empty()) return figure;
  for (std::size_t i = 0; by_time && i < times.size(); ++i) {
    script.legend_line(curve_colour(i), fmt::format("t = {:.4g} s", times[i]));
  }
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (const std::string& location : locations) {
      const std::string where = location == "grid" ? "grid nodes" : location;
      script.legend_mark(by_time ? "#555555" : curve_colour(r), mark_of(locations, location, r),
                         (by_time ? method_of(runs) : runs[r].label) + ", " + where);
    }
  }
  if (any_exact) script.legend_line(one_line ? "#000000" : "#555555", solution_name(runs), 1.3);
  figure.script = script.text(record.figure);
  figure.caption =
      any_exact
          ? fmt::format("Lines: {} solution. Marks: {}, one column of points, thinned where dense.",
                        solution_name(runs), method_of(runs))
          : fmt::format("Marks: {}, one column of points, thinned where dense; no exact solution is known.",
                        method_of(runs));
  if (!by_time) {
    figure.caption += " Times:";
    for (const double t : times) figure.caption += fmt::format(" {:.4g}", t);
    figure.caption += " s.";
  }
  if (std::count_if(all_times.begin(), all_times.end(),
                    [&](double t) { return std::find(times.begin(), times.end(), t) == times.end(); }) > 0) {
    figure.caption += fmt::format(" {} of the output times are shown.", times.size());
  }
  return figure;
}

}  // namespace reports

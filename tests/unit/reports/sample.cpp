#include "tests/unit/reports/sample.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "reports/records/directory/result_files.hpp"
#include "reports/records/directory/run_files.hpp"
#include "reports/records/provenance.hpp"

namespace {

using namespace reports;
constexpr double pi = 3.14159265358979323846;
constexpr double gap = 1e-3, viscosity = 1e-6, force = 8e-3;
constexpr double times[] = {0.05, 0.1, 0.2, 0.5, 1.0};
const double nan_value = std::numeric_limits<double>::quiet_NaN();

double poiseuille(double y, double t) {
  double u = force / (2 * viscosity) * y * (gap - y);
  for (int n = 0; n < 30; ++n) {
    const double k = (2 * n + 1) * pi;
    u -= 4 * force * gap * gap / (viscosity * k * k * k) * std::sin(k * y / gap) *
         std::exp(-k * k * viscosity * t / (gap * gap));
  }
  return u;
}

// An error of second order in h that decays in t, as a real run would have.
double relative_error(long cells, double t) {
  return (0.2 + 0.3 * std::exp(-4 * t)) / double(cells * cells);
}

std::vector<ProfileRow> profile(long cells) {
  std::vector<ProfileRow> rows;
  for (const double t : times) {
    const auto add = [&](const char* location, double x, double y, bool numerical) {
      const double exact = poiseuille(y, t);
      const double u = exact + relative_error(cells, t) * 1e-3 * std::sin(pi * y / gap);
      rows.push_back({t, location, x, y, numerical ? u : nan_value, numerical ? 0 : nan_value, exact, 0});
    };
    const double h = gap / double(cells);
    for (int i = 0; i <= 200; ++i) add("exact", 0, gap * i / 200, false);
    for (long j = 0; j <= cells; ++j) add("grid", 0, h * double(j), true);
    for (int column = 0; column < 20; ++column) {
      for (long j = 0; j < 2 * cells; ++j)
        add("particles", h * (0.25 + 0.5 * column), h * (0.25 + 0.5 * double(j)), true);
    }
  }
  return rows;
}

std::vector<HistoryRow> history(long cells) {
  std::vector<HistoryRow> rows;
  for (int i = 0; i <= 500; ++i) {
    const double t = i / 500.0, exact = poiseuille(gap / 2, t);
    rows.push_back(
        {t, exact * (1 + relative_error(cells, t)), exact, 5e-4, 1e-9 * t, 0, 1e-9 * t, 0, exact * exact});
  }
  return rows;
}

void add_ladder(Results& results, const std::string& study, const std::string& variant,
                const std::string& axis, const std::string& location, const std::string& norm, double t,
                double order, double constant) {
  const double coarsest = axis == "space" ? gap / 10 : 2e-5;
  for (int i = 0; i < 5; ++i) {
    const double step = coarsest / std::pow(2, i);
    const double wiggle = 1 + 0.02 * std::cos(3 * i + t);
    const bool floor = order > 3 && i == 4;
    const double value = constant * std::pow(step / coarsest, order) * wiggle * (floor ? 6 : 1);
    results.levels.push_back({study, variant, axis, location, norm, t, step, value, !floor});
  }
  results.orders.push_back({study, variant, axis, location, norm, t, order, order + 0.004, order - 0.021,
                            order + 0.029, order > 3 ? 4L : 5L, 5, "monotone", "1.98;2.01;2.003;2.001",
                            1.2e-4, 1.25, 1.5e-4, "velocity at mid-height"});
}

}  // namespace

Results sample_results() {
  Results r;
  r.studies = {
      {"poiseuille-space", "Poiseuille start-up, space ladder",
       "The linear scheme <usf> is second order in h, on grid & particles, at every output time of the paper",
       "quick"},
      {"poiseuille-time", "Poiseuille start-up, time ladder", "FLIP | usf is first order in dt", "full"}};
  for (const long cells : {10L, 20L, 40L, 80L}) {
    const std::string run = fmt::format("poiseuille-space.cells={}", cells);
    const double dt = 5e-6 * 400.0 / double(cells * cells);
    r.runs.push_back({run, "poiseuille-space", "poiseuille", "newtonian", "linear", "flip", "usf", cells,
                      40 * cells, dt, std::lround(1 / dt), "completed"});
    for (const double t : times) {
      const double e = relative_error(cells, t);
      r.errors.push_back({run, t, "grid", 0.8 * e, e, 1.4 * e});
      r.errors.push_back({run, t, "particles", 0.9 * e, 1.1 * e, 1.6 * e});
    }
    r.timings.push_back({run, 0.01 * std::pow(double(cells) / 10, 3.1), 2.5e7});
    const std::string cubic = fmt::format("cubic.cells={}", cells);
    r.runs.push_back(
        {cubic, "poiseuille-space", "poiseuille", "newtonian", "cubic", "full-mass", "usf", cells, 60 * cells,
         dt, cells == 80 ? 4711 : std::lround(1 / dt),
         cells == 80 ? "diverged at t = 0.0123 s: velocity > 10 V_max <|> \"boom\"" : "completed"});
    if (cells < 80)
      r.errors.push_back({cubic, 1.0, "grid", 1e-3 / std::pow(cells, 3), 2e-3 / std::pow(cells, 3), 1e-5});
    r.timings.push_back({cubic, 0.05 * std::pow(double(cells) / 10, 3.2), 0.9e7});
  }
  for (const double t : times) {
    for (const char* location : {"grid", "particles"}) {
      const double c = relative_error(10, t) * (location[0] == 'g' ? 1 : 1.1);
      add_ladder(r, "poiseuille-space", "linear", "space", location, "l2", t, 2, c);
      add_ladder(r, "poiseuille-space", "linear", "space", location, "linf", t, 2, 1.5 * c);
    }
    add_ladder(r, "poiseuille-time", "usf", "time", "grid", "l2", t, 1, 1e-4 * std::exp(-t));
    add_ladder(r, "poiseuille-time", "musl", "time", "grid", "l2", t, 1, 0.4e-4 * std::exp(-t));
    add_ladder(r, "poiseuille-time", "cubic, full mass", "time", "grid", "l2", t, 4, 2e-5 * std::exp(-t));
  }
  const double inf = std::numeric_limits<double>::infinity();
  r.checks = {{"poiseuille-space", "order of grid L2 at t = 0.05 s", 2.0042, 1.95, 2.05, "1", "pass",
               "theory: 2; issue band"},
              {"poiseuille-space", "order of particle L2 at t = 1 s", 2.050003, 1.95, 2.05, "1", "fail",
               "theory: 2, \"central\" differences & linear basis <4 nodes> | band 0.05"},
              {"poiseuille-space", "particle L2, 20 cells", 1.31e-3, -inf, 2e-3, "1", "pass",
               "prototype: 1.1e-3 to 1.9e-3"},
              {"poiseuille-time", "order of usf", 1.003, 0.95, 1.05, "1", "pass", "theory: 1"},
              {"poiseuille-time", "mass drift", nan_value, -1e-15, 1e-15, "kg/m", "fail",
               "mass is carried by particles"}};
  const std::string all = "poiseuille-space.cells=10;poiseuille-space.cells=20;poiseuille-space.cells=40";
  r.figures = {{"poiseuille-profiles", "poiseuille-space", "profiles",
                "At 20 cells the velocity profile follows the exact series at all five output times of the "
                "paper (its Fig. 2b)",
                "poiseuille-space.cells=20", "", "y", "u", "grid;particles", ""},
               {"poiseuille-history", "poiseuille-space", "history",
                "Mid-height velocity follows the exact series on every mesh", all,
                "10 cells;20 cells;40 cells", "", "", "", ""},
               {"poiseuille-order", "poiseuille-space", "convergence",
                "The linear basis is second order in h", "", "", "space", "", "grid;particles", "l2"},
               {"poiseuille-time-order", "poiseuille-time", "convergence",
                "Each stepping reaches its own order in time: it's `echo not run` @macro \\n {/Bold no} "
                "_markup_ \"here\"",
                "", "", "", "", "grid", "l2"},
               {"work-precision", "poiseuille-space", "work-precision",
                "Cubic splines reach any error sooner than linear ones", "", "", "", "", "grid", "l2"}};
  return r;
}

void write_sample(const std::filesystem::path& dir) {
  const Results results = sample_results();
  write_results(dir, results);
  for (const RunRecord& run : results.runs) {
    if (run.basis != "linear") continue;
    write_profile(dir, run.run, profile(run.cells));
    write_history(dir, run.run, history(run.cells));
  }
  Provenance provenance;
  provenance.build = {"0.1.0", "1d208e1", "GNU 12.2.0", "-O3 -DNDEBUG", "Release"};
  provenance.machine = {"Some CPU @ 2 GHz <x>", 2, 8589934592, "Some Linux 1.0"};
  provenance.command = "mpm-verify run --suite full --out \"results\"";
  provenance.started = "2026-01-02T03:04:05Z";
  write_provenance(dir, provenance);
}

EnvironmentVariable::EnvironmentVariable(const char* name, const std::string& value) : name_(name) {
  const char* before = std::getenv(name);
  was_set_ = before != nullptr;
  if (before) before_ = before;
  setenv(name, value.c_str(), 1);
}

EnvironmentVariable::~EnvironmentVariable() {
  if (was_set_) {
    setenv(name_.c_str(), before_.c_str(), 1);
  } else {
    unsetenv(name_.c_str());
  }
}

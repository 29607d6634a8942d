#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "reports/compare/compare.hpp"
#include "reports/files/csv.hpp"
#include "reports/files/io_error.hpp"
#include "reports/records/directory/bench_file.hpp"
#include "reports/records/not_a_number.hpp"
#include "reports/records/report_data.hpp"

namespace reports {
namespace {

namespace fs = std::filesystem;
/// The names in the first line of a file.
std::vector<std::string> header_of(const fs::path& file) {
  std::string content = read_file(file);
  if (content.starts_with("\xef\xbb\xbf"))
    content.erase(0, 3);  // a byte order mark, which read_csv passes over too
  std::vector<std::string> names;
  std::istringstream line(content.substr(0, content.find_first_of("\r\n")));
  for (std::string name; std::getline(line, name, ',');) names.push_back(name);
  return names;
}

template <class Columns>
bool has_columns(const std::vector<std::string>& header, const Columns& columns) {
  return std::apply(
      [&](const auto&... c) {
        return ((std::find(header.begin(), header.end(), c.name) != header.end()) && ...);
      },
      columns);
}

/// A number whose noise is known from the spread of its repetitions.
Measured timed(std::string name, double value, std::string unit, Sense sense, double spread) {
  return {std::move(name), value, std::move(unit), sense, 0, spread, 0, false};
}

std::vector<Measured> statuses(const fs::path& file) {
  constexpr auto columns =
      std::make_tuple(column("run", &RunRecord::run), column("status", &RunRecord::status));
  std::vector<Measured> found;
  for (const RunRecord& run : read_csv(file, columns))
    found.push_back(
        {run.run + ", completed", completed(run) ? 1.0 : 0.0, "", Sense::HigherIsBetter, 0, 0, 0, true});
  return found;
}

std::vector<Measured> errors(const fs::path& file, const CompareOptions& options) {
  constexpr auto columns =
      std::make_tuple(column("run", &ErrorRecord::run), column("t", &ErrorRecord::t),
                      column("location", &ErrorRecord::location), column("l1", &ErrorRecord::l1),
                      column("l2", &ErrorRecord::l2), column("linf", &ErrorRecord::linf));
  std::vector<Measured> found;
  for (const ErrorRecord& e : read_csv(file, columns))
    for (const auto& [norm, value] : {std::pair{"l1", e.l1}, {"l2", e.l2}, {"linf", e.linf}})
      found.push_back({fmt::format("{}, t = {} s, {}, {}", e.run, e.t, e.location, norm), value, "",
                       Sense::LowerIsBetter, 0, options.tolerance, error_floor, false});
  return found;
}

std::vector<Measured> orders(const fs::path& file, const CompareOptions& options) {
  constexpr auto columns = std::make_tuple(
      column("study", &OrderRecord::study), column("variant", &OrderRecord::variant),
      column("axis", &OrderRecord::axis), column("location", &OrderRecord::location),
      column("norm", &OrderRecord::norm), column("t", &OrderRecord::t),
      column("theoretical", &OrderRecord::theoretical), column("observed", &OrderRecord::observed));
  std::vector<Measured> found;
  for (const OrderRecord& o : read_csv(file, columns))
    found.push_back({fmt::format("{}{}{}, order in {}, {} {}, t = {} s", o.study,
                                 o.variant.empty() ? "" : ".", o.variant, o.axis, o.location, o.norm, o.t),
                     o.observed, "", std::isnan(o.theoretical) ? Sense::Neutral : Sense::NearerIsBetter,
                     o.theoretical, options.tolerance, options.tolerance, false});
  return found;
}

std::vector<Measured> verdicts(const fs::path& file) {
  constexpr auto columns =
      std::make_tuple(column("study", &CheckRecord::study), column("check", &CheckRecord::check),
                      column("observed", &CheckRecord::observed), column("lower", &CheckRecord::lower),
                      column("upper", &CheckRecord::upper), column("verdict", &CheckRecord::verdict));
  std::vector<Measured> found;
  for (const CheckRecord& check : read_csv(file, columns))
    found.push_back({check.study + ", " + check.check, holds(check) ? 1.0 : 0.0, "", Sense::HigherIsBetter, 0,
                     0, 0, true});
  return found;
}

std::vector<Measured> timings(const fs::path& file, bool with_spread) {
  constexpr auto plain =
      std::make_tuple(column("run", &TimingRecord::run), column("wall_s", &TimingRecord::wall_s));
  constexpr auto full = std::tuple_cat(plain, std::make_tuple(column("spread", &TimingRecord::spread)));
  std::vector<Measured> found;
  for (const TimingRecord& t : with_spread ? read_csv(file, full) : read_csv(file, plain))
    found.push_back(
        timed(t.run + ", wall time", t.wall_s, "s", Sense::LowerIsBetter, with_spread ? t.spread : nan));
  return found;
}

/// Rates are better when higher, times and sizes when lower; of anything else no direction is known.
Sense sense_of(const std::string& unit) {
  if (unit.ends_with("/s")) return Sense::HigherIsBetter;
  for (const char* lower : {"s", "ms", "us", "µs", "ns", "B", "kB", "MB", "KiB", "MiB"})
    if (unit == lower) return Sense::LowerIsBetter;
  return Sense::Neutral;
}

std::vector<Measured> benchmarks(const fs::path& file) {
  std::vector<Measured> found;
  for (const BenchRecord& row : read_csv(file, bench_columns))
    found.push_back(
        timed(row.benchmark + ", " + row.quantity, row.value, row.unit, sense_of(row.unit), row.spread));
  return found;
}

}  // namespace

std::string kind_of(const fs::path& file) {
  const std::vector<std::string> header = header_of(file);
  const auto has = [&](auto... names) {
    return ((std::find(header.begin(), header.end(), std::string(names)) != header.end()) && ...);
  };
  if (has_columns(header, bench_columns)) return "bench.csv";
  if (has("run", "t", "location", "l1", "l2", "linf")) return "errors.csv";
  if (has("study", "theoretical", "observed", "classification")) return "orders.csv";
  if (has("study", "check", "observed", "lower", "upper", "verdict")) return "checks.csv";
  if (has("run", "wall_s")) return "timing.csv";
  if (has("run", "status")) return "runs.csv";
  throw IoError(fmt::format(
      "{}: not a file that can be compared; it must be (by its columns) a runs.csv, errors.csv, orders.csv, "
      "checks.csv, timing.csv, or a bench.csv with benchmark,quantity,value,unit,spread",
      file.string()));
}

std::vector<Measured> read_measured(const fs::path& file, const CompareOptions& options) {
  const std::string kind = kind_of(file);
  if (kind == "bench.csv") return benchmarks(file);
  if (kind == "errors.csv") return errors(file, options);
  if (kind == "orders.csv") return orders(file, options);
  if (kind == "checks.csv") return verdicts(file);
  if (kind == "runs.csv") return statuses(file);
  const std::vector<std::string> header = header_of(file);
  return timings(file, std::find(header.begin(), header.end(), "spread") != header.end());
}

}  // namespace reports

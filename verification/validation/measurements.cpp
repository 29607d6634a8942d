#include "verification/validation/measurements.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "reports/files/csv.hpp"
#include "verification/config/config_error.hpp"
#include "verification/validation/validated_quantity.hpp"

namespace verification {
namespace {

/// A row as it stands in the file: numbers are converted here, where a remedy can be named.
struct RawRow {
  std::string quantity, t, x, y, value, uncertainty, shared, unit, note;
};

constexpr auto measured_columns = std::make_tuple(         //
    reports::column("quantity", &RawRow::quantity),        //
    reports::column("t", &RawRow::t),                      //
    reports::column("x", &RawRow::x),                      //
    reports::column("y", &RawRow::y),                      //
    reports::column("value", &RawRow::value),              //
    reports::column("uncertainty", &RawRow::uncertainty),  //
    reports::column("unit", &RawRow::unit),                //
    reports::column("note", &RawRow::note));

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r"), end = text.find_last_not_of(" \t\r");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

[[noreturn]] void fail_at(const std::filesystem::path& file, long line, const std::string& problem) {
  throw ConfigError(fmt::format("{}:{}: {}", file.string(), line, problem));
}

/// The "# key: text" lines, by key, cut out of the text; what stays is the CSV.
std::map<std::string, std::string> take_header(reports::csv::Text& text) {
  std::map<std::string, std::string> header;
  std::string rest;
  std::vector<long> lines;
  std::string last;  // key that a further comment line goes on with
  std::size_t begin = 0;
  for (std::size_t i = 0; begin < text.content.size(); ++i) {
    std::size_t end = text.content.find('\n', begin);
    if (end == std::string::npos) end = text.content.size();
    const std::string line = trimmed(text.content.substr(begin, end - begin));
    begin = end + 1;
    if (line.empty()) continue;
    if (line.front() != '#') {
      rest += line + "\n";
      lines.push_back(text.line_numbers[i]);
      continue;
    }
    const std::string comment = trimmed(line.substr(1));
    const std::size_t colon = comment.find(':');
    const bool is_key = colon != std::string::npos && comment.find(' ') > colon;
    if (is_key) last = comment.substr(0, colon);
    const std::string part = is_key ? trimmed(comment.substr(colon + 1)) : comment;
    if (!last.empty() && !part.empty()) header[last] += (header[last].empty() ? "" : " ") + part;
  }
  text.content = rest;
  text.line_numbers = lines;
  return header;
}

double number_in(const MeasurementTable& table, const Measurement& row, const char* column,
                 const std::string& text) {
  double value = 0;
  if (!reports::csv::parse_field(text, value) || !std::isfinite(value))
    table.fail(row,
               fmt::format("column '{}': '{}' is not a finite number; write it as 1.5e-3", column, text));
  return value;
}

double coordinate(const MeasurementTable& table, const Measurement& row, const char* column,
                  const std::string& text) {
  return text.empty() ? std::numeric_limits<double>::quiet_NaN() : number_in(table, row, column, text);
}

Measurement measurement(const MeasurementTable& table, const RawRow& raw, long line) {
  Measurement row{raw.quantity, 0, 0, 0, 0, 0, 0, raw.unit, raw.note, line};
  const ValidatedQuantity* quantity = find_validated_quantity(raw.quantity);
  if (!quantity)
    table.fail(row, fmt::format("quantity '{}' is not known; choose one of: {}", raw.quantity,
                                validated_quantity_names()));
  row.t = coordinate(table, row, "t", raw.t);
  row.x = coordinate(table, row, "x", raw.x);
  row.y = coordinate(table, row, "y", raw.y);
  if (std::isnan(row.t) || row.t < 0)
    table.fail(row,
               "column 't': the time of the measurement is missing or negative; a steady one stands at an "
               "output time by which the run is steady");
  if (quantity->at_a_place && std::isnan(row.y))
    table.fail(row, fmt::format("column 'y': '{}' is measured at a place; give it", raw.quantity));
  if (!quantity->at_a_place && !(std::isnan(row.x) && std::isnan(row.y)))
    table.fail(row, fmt::format("columns 'x' and 'y': '{}' has no place; leave them empty", raw.quantity));
  row.value = number_in(table, row, "value", raw.value);
  if (raw.uncertainty.empty())
    table.fail(row,
               "column 'uncertainty' is empty; a value without an uncertainty cannot be compared: state one "
               "standard deviation, digitisation included");
  row.uncertainty = number_in(table, row, "uncertainty", raw.uncertainty);
  if (!(row.uncertainty > 0))
    table.fail(row,
               fmt::format("column 'uncertainty': {} is not positive; give one standard deviation in the "
                           "unit of the value",
                           raw.uncertainty));
  if (!raw.shared.empty()) row.shared = number_in(table, row, "shared_uncertainty", raw.shared);
  if (row.shared < 0)
    table.fail(row,
               fmt::format("column 'shared_uncertainty': {} is negative; 0 or nothing for none", raw.shared));
  const std::string expected = table.scaled ? "1" : quantity->unit;
  if (raw.unit != expected)
    table.fail(row,
               fmt::format("column 'unit': '{}' is not the unit of '{}' here; convert value and "
                           "uncertainty to '{}'{}",
                           raw.unit, raw.quantity, expected,
                           raw.unit == "1" ? ", or write '# scales: velocity length' above the table" : ""));
  return row;
}

bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || a == b;
}

void refuse_twins(const MeasurementTable& table) {
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Measurement &a = table.rows[i], &b = table.rows[k];
      if (a.quantity == b.quantity && same(a.t, b.t) && same(a.x, b.x) && same(a.y, b.y))
        table.fail(a, fmt::format("the same quantity, time and place as in line {}; keep one, or their mean "
                                  "with its uncertainty",
                                  b.line));
    }
}

}  // namespace

void MeasurementTable::fail(const Measurement& row, const std::string& problem) const {
  fail_at(file, row.line, problem);
}

MeasurementTable read_measurements(const std::filesystem::path& file) {
  reports::csv::Text text = reports::csv::load(file);
  MeasurementTable table;
  table.file = file;
  const auto header = take_header(text);
  for (const auto& [key, member] :
       {std::pair{"source", &table.source}, std::pair{"obtained", &table.obtained},
        std::pair{"licence", &table.licence}}) {
    const auto found = header.find(key);
    if (found == header.end() || found->second.empty())
      fail_at(file, 1,
              fmt::format("a line '# {}: ...' is missing above the table; nobody can judge by numbers "
                          "of which that is not known",
                          key));
    *member = found->second;
  }
  if (const auto scales = header.find("scales"); scales != header.end()) {
    if (scales->second != "velocity length")
      fail_at(file, 1, "'# scales:' must be 'velocity length', or be left out for SI units");
    table.scaled = true;
  }
  const bool shares =
      text.content.substr(0, text.content.find('\n')).find("shared_uncertainty") != std::string::npos;
  const auto rows =
      shares ? reports::read_csv(
                   text, file,
                   std::tuple_cat(measured_columns,
                                  std::make_tuple(reports::column("shared_uncertainty", &RawRow::shared))))
             : reports::read_csv(text, file, measured_columns);
  for (std::size_t i = 0; i < rows.size(); ++i)
    table.rows.push_back(measurement(table, rows[i], text.line_of(static_cast<unsigned>(i) + 2)));
  if (table.rows.empty()) fail_at(file, 1, "no measurement: a comparison with nothing proves nothing");
  refuse_twins(table);
  return table;
}

}  // namespace verification

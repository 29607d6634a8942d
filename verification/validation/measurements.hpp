#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace verification {

/// One measured value.
struct Measurement {
  std::string quantity;  ///< one of validated_quantities()
  double t, x, y;        ///< time [s] and place [m] (or in the table's scales); NaN where left out
  double value = 0;
  double uncertainty = 0;  ///< standard uncertainty of the value alone, digitisation included; > 0
  double shared = 0;       ///< standard uncertainty that all values of the table share (a calibration); >= 0
  std::string unit, note;
  long line = 0;  ///< in the file
};

/// A table of measurements and what must be known of it.
struct MeasurementTable {
  std::filesystem::path file;
  std::string source;    ///< the primary source: author, year, table or figure
  std::string obtained;  ///< how the numbers got here: read from the table, digitised, second hand
  std::string licence;   ///< why they may be here; numbers that are facts are nobody's
  /// Values, places and times in units of a velocity V, a length L and L/V, which whoever compares must give.
  bool scaled = false;
  std::vector<Measurement> rows;

  /// Throws ConfigError "file:line: problem" for a row.
  [[noreturn]] void fail(const Measurement& row, const std::string& problem) const;
};

/// Reads a table: lines "# key: text" with the keys source, obtained and licence, and optionally
/// "# scales: velocity length"; then CSV with the columns
///   quantity,t,x,y,value,uncertainty,unit,note
/// and, where there is one, shared_uncertainty. An empty t, x or y is one that does not apply.
/// Throws ConfigError with file, line and remedy for a header that is incomplete, a field that is no number,
/// an uncertainty that is missing, zero or negative, a unit that is not the quantity's, an unknown quantity,
/// a time or place that is missing, and a place that stands twice; reports::IoError for a file or column that
/// is missing.
MeasurementTable read_measurements(const std::filesystem::path& file);

}  // namespace verification

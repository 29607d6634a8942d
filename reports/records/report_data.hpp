#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reports/figures/figures.hpp"
#include "reports/records/provenance.hpp"
#include "reports/records/records.hpp"

namespace reports {

/// A figure as the report shows it.
struct ReportFigure {
  Figure figure;
  bool drawn = false;  ///< figures/<name>.svg and .png are there
};

/// All that the report's formats show; they differ in clothing only.
struct ReportData {
  Results results;
  std::optional<Provenance> provenance;
  std::vector<ReportFigure> figures;
  std::optional<std::vector<ChangeRecord>> changes;  ///< since the results that lay here before, if any did
  std::vector<std::string> warnings;
};

/// The statement holds: its verdict says so and its numbers agree. A word alone is not believed.
bool holds(const CheckRecord& check);
/// "PASS: 5 of 5 checks hold" or "FAIL: ..."; without any check it is a failure, since nothing has been
/// shown.
std::string verdict_line(const Results& results);
bool passed(const Results& results);
std::vector<const CheckRecord*> failures(const Results& results);

/// Studies in the order of studies.csv, then those that only other files name (with no title and claim).
std::vector<StudyRecord> studies_of(const Results& results);
std::vector<const CheckRecord*> checks_of(const Results& results, const std::string& study);
std::vector<const OrderRecord*> orders_of(const Results& results, const std::string& study);
bool completed(const RunRecord& run);
/// Sum of the known wall times of a study's runs [s]; NaN if none is known.
double wall_time_of(const Results& results, const std::string& study);

/// Errors of a refinement ladder, coarse to fine, with the rate from each level to the next.
struct RateTable {
  std::string variant, axis, location, norm;
  std::vector<double> times;  ///< a pair of columns each
  struct Row {
    double step;
    std::vector<double> errors, rates;  ///< by time; the first rate is NaN, as is one without both errors
    std::vector<bool> used;             ///< false when the level was left out of the fit
  };
  std::vector<Row> rows;
};
/// The tables of a study: those in the L2 norm, or, where a ladder has no L2 norm, in the norms that it has.
std::vector<RateTable> rate_tables(const Results& results, const std::string& study);

/// What a ladder refines, as a table names it: "h [m]", "dt [s]", "Ma".
std::string step_symbol(const std::string& axis);

/// Numbers for people, not for programs: `digits` significant digits; "nan" stays visible.
std::string number(double value, int digits = 4);
/// The rate of a table: three decimals, "-" for NaN.
std::string rate(double value);
/// "1.95 to 2.05", "at most 2e-3", "at least 1", "any".
std::string bounds(const CheckRecord& check);
/// The observed value with as many digits as it takes to tell it from a bound that it misses.
std::string observed(const CheckRecord& check);
/// `value` followed by the check's unit unless it is a pure number ("", "1" or "-").
std::string with_unit(const std::string& value, const CheckRecord& check);
/// "2.001 [1.98, 2.03]"
std::string order_with_interval(const OrderRecord& order);

}  // namespace reports

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace reports {

/// What a change of a quantity means.
enum class Sense { LowerIsBetter, HigherIsBetter, NearerIsBetter, Neutral };

/// One number of a result file.
struct Measured {
  std::string name;  ///< unique in its file: "run, t = 0.1 s, grid, l2"
  double value = 0;
  std::string unit;
  Sense sense = Sense::Neutral;
  double target = 0;  ///< NearerIsBetter: what the value should be
  double relative =
      0;  ///< changes within relative * |value| + absolute are noise; NaN: the noise is not known
  double absolute = 0;
  bool statement = false;  ///< holds (1) or does not (0)
};

/// Missing: what was measured before and is gone. It counts as a regression, as worse does.
enum class Verdict { Same, Better, Worse, Changed, New, Missing };
std::string to_string(Verdict verdict);

/// A number before and after.
struct Change {
  Verdict verdict = Verdict::Same;
  Measured before, after;  ///< `before` is empty for New, `after` for Missing
  std::string note;        ///< why it is judged so, where that is not plain
  bool judged = true;      ///< false when the noise is not known: measured once
};

/// One file of OLD against the same of NEW.
struct FileComparison {
  std::string file;             ///< "errors.csv"
  std::vector<Change> changes;  ///< without Same; worse first, large changes first
  std::size_t same = 0;

  [[nodiscard]] std::size_t count(Verdict verdict) const;
  /// Whether anything is worse, or gone.
  [[nodiscard]] bool regressed() const;
};

struct CompareOptions {
  /// Relative change of errors and orders that is round-off: another order of summation moves them by this.
  double tolerance = 1e-9;
};

/// Two measured times differ beyond noise when they are further apart than this many times the spreads of
/// both together, root of the sum of squares, and more than `least_time_change` of the earlier (machines
/// drift by that much from day to day).
constexpr double spreads_of_noise = 3, least_time_change = 0.05;
/// Errors relative to the flow's velocity below this are round-off of many steps.
constexpr double error_floor = 1e-12;

/// Which result file one is, by its columns: "errors.csv", ... @throws IoError for any other file.
std::string kind_of(const std::filesystem::path& file);

/// The numbers of one result file of a known kind: runs.csv (status), errors.csv, orders.csv, checks.csv
/// (verdict), timing.csv, or bench.csv (columns benchmark, quantity, value, unit, spread: relative, from the
/// repetitions). The kind is known by the columns. @throws IoError for any other file.
std::vector<Measured> read_measured(const std::filesystem::path& file, const CompareOptions& options);

/// Judges `after` against `before`, matched by name.
FileComparison compare_measured(const std::string& file, const std::vector<Measured>& before,
                                const std::vector<Measured>& after);

/// Two result directories, file by file (a file that neither has is left out; one that only one of them has
/// counts as new or missing as a whole), or two files of the same kind. @throws IoError, also for two
/// kinds
std::vector<FileComparison> compare_results(const std::filesystem::path& before,
                                            const std::filesystem::path& after,
                                            const CompareOptions& options);

/// The comparison as text: a line a change, then the counts. Without `all`, at most 20 changes a file and
/// none that is not judged. Colour is for a terminal.
std::string comparison_text(const std::vector<FileComparison>& comparison, bool all, bool colour);

}  // namespace reports

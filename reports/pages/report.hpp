#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace reports {

struct ReportOutcome {
  std::size_t checks_passed = 0, checks_failed = 0;
  bool passed = false;                ///< at least one check, and all hold
  std::vector<std::string> warnings;  ///< one line each; they stand in the report too
};

/// How figures are drawn.
struct FigureOptions {
  /// Drawn figures are kept here by the content of their script and by the gnuplot that drew them, and taken
  /// from here instead of being drawn again; "" for nowhere.
  std::filesystem::path cache = {};
  int jobs = 1;      ///< gnuplot processes at the same time
  bool pdf = false;  ///< print report.pdf too, where there is a browser
};

/// Make figures/ of a result directory alone. Returns warnings, one line each. @throws IoError as
/// write_report().
std::vector<std::string> write_figures(const std::filesystem::path& dir, const FigureOptions& options = {});

/// Make figures/, report.html, summary.md, report.md, junit.xml and, if asked, report.pdf of a result
/// directory from its CSV files and provenance.json alone. The same files give the same bytes. A missing or
/// failing gnuplot costs the figures and one warning.
/// @throws IoError if a file is missing or malformed or cannot be written.
ReportOutcome write_report(const std::filesystem::path& dir, const FigureOptions& options = {});

}  // namespace reports

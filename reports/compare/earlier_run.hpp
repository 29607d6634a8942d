#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "reports/compare/compare.hpp"

namespace reports {

/// The numbers of the results that lie in a directory before new ones replace them. Of a suite that was
/// stopped, of nothing, or of files that cannot be read there are none: then no changes are written.
class EarlierRun {
 public:
  /// Reads checks, errors, orders and statuses of runs; times are noise between one run and the next.
  explicit EarlierRun(std::filesystem::path dir);

  /// Compares with what lies there now and writes changes.csv: only those that are judged (compare_measured),
  /// of studies that ran both times. @throws IoError
  void write_changes() const;

 private:
  std::filesystem::path dir_;
  std::string name_;
  std::map<std::string, std::vector<Measured>> files_;
};

}  // namespace reports

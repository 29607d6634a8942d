#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace reports {

/// Records by row and column, these in the order in which they first occur; of two records for one cell the
/// later one stands.
template <class Record>
struct CrossedTable {
  std::vector<std::string> rows, columns;
  std::map<std::pair<std::string, std::string>, const Record*> cells;

  void add(const std::string& row, const std::string& column, const Record& record) {
    const auto list = [](std::vector<std::string>& names, const std::string& name) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    };
    list(rows, row);
    list(columns, column);
    cells[{row, column}] = &record;
  }
};

}  // namespace reports

#include "verification/flows/vortices/cavity_tables.hpp"

#include <algorithm>
#include <map>

#include "reports/files/csv.hpp"
#include "verification/flows/vortices/cavity_table_texts.hpp"

namespace verification {
namespace {

struct Row {
  std::string quantity;
  double x, y, value, uncertainty;
};
constexpr auto columns = std::make_tuple(         //
    reports::column("quantity", &Row::quantity),  //
    reports::column("x", &Row::x),                //
    reports::column("y", &Row::y),                //
    reports::column("value", &Row::value),        //
    reports::column("uncertainty", &Row::uncertainty));

CavityTable read(const CavityTableText& table) {
  reports::csv::Text text;
  long line = 0;
  for (std::size_t begin = 0; begin < table.csv.size();) {
    const std::size_t end = std::min(table.csv.find('\n', begin), table.csv.size());
    ++line;
    if (table.csv[begin] != '#') {
      text.content += std::string(table.csv.substr(begin, end - begin)) + "\n";
      text.line_numbers.push_back(line);
    }
    begin = end + 1;
  }
  CavityTable read;
  for (const Row& row : reports::read_csv(text, std::string(table.fluid), columns)) {
    read.points.push_back({row.x, row.y, row.quantity == "u" ? 0 : 1, row.value});
    read.largest_uncertainty = std::max(read.largest_uncertainty, 2 * row.uncertainty);
  }
  return read;
}

}  // namespace

const CavityTable* cavity_table(const std::string& fluid) {
  static const std::map<std::string, CavityTable> tables = [] {
    std::map<std::string, CavityTable> all;
    for (const CavityTableText& text : cavity_table_texts) all.emplace(text.fluid, read(text));
    return all;
  }();
  const auto found = tables.find(fluid);
  return found == tables.end() ? nullptr : &found->second;
}

}  // namespace verification

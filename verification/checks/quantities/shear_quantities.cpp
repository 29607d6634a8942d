#include <algorithm>
#include <cmath>
#include <limits>

#include "verification/checks/quantities/quantity_entries.hpp"
#include "verification/checks/quantities/shear_cells.hpp"
#include "verification/not_a_number.hpp"

namespace verification {
namespace {

double in_cell(const std::vector<double>& cells, double place) {
  if (cells.empty()) return nan;
  const double j = std::clamp(std::floor(place * static_cast<double>(cells.size())), 0.0,
                              static_cast<double>(cells.size() - 1));
  return cells[static_cast<std::size_t>(j)];
}

double smallest_rise(const std::vector<double>& cells, std::size_t begin) {
  if (cells.size() < begin + 2) return nan;
  double rise = std::numeric_limits<double>::infinity();
  for (std::size_t j = begin + 1; j < cells.size(); ++j) rise = std::min(rise, cells[j] - cells[j - 1]);
  return rise / *std::ranges::max_element(cells);
}

double smallest_spread(std::vector<double> cells) {
  const double up = smallest_rise(cells, cells.size() / 2);
  std::ranges::reverse(cells);
  return std::min(up, smallest_rise(cells, cells.size() / 2));
}

double asymmetry(const std::vector<double>& cells) {
  if (cells.empty()) return nan;
  double largest = 0;
  for (std::size_t j = 0; j < cells.size(); ++j)
    largest = std::max(largest, std::abs(cells[j] - cells[cells.size() - 1 - j]));
  return largest / *std::ranges::max_element(cells);
}

constexpr auto rate = &reports::ShearRow::shear_rate;
constexpr auto viscosity = &reports::ShearRow::viscosity_ratio;

}  // namespace

void add_shear_quantities(std::vector<QuantityEntry>& entries) {
  entries.insert(
      entries.end(),
      {
          {"shear-rate", "1/s", Record::Shear, true, true,
           [](const Quantity& q, const RunData& r) { return in_cell(cells_at(r, q.time, rate), q.place); }},
          {"viscosity-ratio", "1", Record::Shear, true, true,
           [](const Quantity& q, const RunData& r) {
             return in_cell(cells_at(r, q.time, viscosity), q.place);
           }},
          {"shear-rate-rise", "1", Record::Shear, true, false,
           [](const Quantity& q, const RunData& r) { return smallest_rise(cells_at(r, q.time, rate), 0); }},
          {"shear-rate-spread", "1", Record::Shear, true, false,
           [](const Quantity& q, const RunData& r) { return smallest_spread(cells_at(r, q.time, rate)); }},
          {"shear-rate-asymmetry", "1", Record::Shear, true, false,
           [](const Quantity& q, const RunData& r) { return asymmetry(cells_at(r, q.time, rate)); }},
      });
}

}  // namespace verification

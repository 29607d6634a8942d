#include "verification/convergence/order_remark.hpp"

#include <fmt/format.h>

#include <cmath>

#include "verification/convergence/floor_fit.hpp"

namespace verification {
namespace {

constexpr double stalled_below = 0.25;  ///< of the theoretical order
/// A floor is worth a word if the order is this much below theory, the floor this part of the finest error,
/// and the fit within this much of every level.
constexpr double order_lost = 0.1, floor_share = 0.1, worst_misfit = 0.05;

std::string floor_remark(const reports::OrderRecord& order, const std::vector<reports::LevelRecord>& levels) {
  if (order.axis == "time" || !(order.observed < order.theoretical - order_lost)) return "";
  std::vector<double> steps, errors;
  for (const reports::LevelRecord& level : levels)
    if (level.used) {
      steps.push_back(level.step);
      errors.push_back(level.value);
    }
  const auto fit = fit_floor(steps, errors, order.theoretical);
  if (!fit || !(fit->misfit < worst_misfit) || !(fit->floor > floor_share * errors.back())) return "";
  return fmt::format(" (the errors are those of order {:.3g} on a floor of {:.3g}, within {:.2g} %)",
                     order.theoretical, fit->floor, 100 * fit->misfit);
}

}  // namespace

std::string order_remark(const reports::OrderRecord& order, const std::vector<reports::LevelRecord>& levels) {
  std::string text;
  if (order.classification != "monotone") text += " (the ladder is " + order.classification + ")";
  if (std::abs(order.observed) < stalled_below * order.theoretical)
    text += fmt::format(" (stalled: finer levels are hardly better, p = {:.2g})", order.observed);
  if (order.levels_used == 2) text += " (an order of two levels, which no third bears out)";
  return text + floor_remark(order, levels);
}

std::string unit_of(const reports::OrderRecord& order, double observed) {
  return std::isnan(observed) && order.classification != "monotone" ? "(" + order.classification + ")" : "1";
}

}  // namespace verification

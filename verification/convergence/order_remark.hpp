#pragma once

#include <string>
#include <vector>

#include "reports/records/records.hpp"

namespace verification {

/// What a reader of an observed order should know beside its number, "" where there is nothing: that it
/// stalls (below a quarter of theory), that it is one of two levels, or that the errors look like C h^p on a
/// floor. `levels`: those of the ladder, coarse to fine.
std::string order_remark(const reports::OrderRecord& order, const std::vector<reports::LevelRecord>& levels);

/// Unit of an order as checks show it: "1", and beside the nan of a ladder without one its class.
std::string unit_of(const reports::OrderRecord& order, double observed);

}  // namespace verification

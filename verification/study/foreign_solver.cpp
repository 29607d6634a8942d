#include "verification/study/foreign_solver.hpp"

#include <algorithm>

namespace verification {

std::string name(Record record) {
  static const char* const names[] = {"profile", "history", "shear", "state"};
  return names[static_cast<int>(record)];
}

const std::vector<std::string>& ForeignSolver::placeholders() {
  static const std::vector<std::string> known = {"{scene}", "{out}",     "{run}",   "{cells}",
                                                 "{dt}",    "{threads}", "{cores}", "{mpm-verify}"};
  return known;
}

bool ForeignSolver::delivers_record(Record record) const {
  return std::ranges::count(delivers, record) > 0;
}

}  // namespace verification

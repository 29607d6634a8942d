#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "solver/kernel/kernel.hpp"
#include "solver/kernel/lanes.hpp"

namespace mpm::MPM_ISA {

/// The functions of the basis in blocks of cells (LineOfCells::functions across lanes). Most blocks share
/// theirs with others.
class BlockFunctions {
 public:
  BlockFunctions(const std::array<LineOfCells, 2>& axis, int stride, int degree)
      : axis_(axis), stride_(stride), degree_(degree), size_((degree + 1) * (degree + 2)) {}

  /// Along an axis, of the cells from `first` on.
  const Lanes* of(int first, int a) {
    const LineOfCells& axis = axis_[static_cast<std::size_t>(a)];
    std::vector<Lanes> across(static_cast<std::size_t>(size_));
    for (int m = 0; m < size_; ++m)
      for (int lane = 0; lane < width; ++lane)
        across[static_cast<std::size_t>(m)][lane] = axis.functions[cell_along(first + lane, a) * size_ + m];
    for (const auto& known : functions_)
      if (std::memcmp(known.data(), across.data(), across.size() * sizeof(Lanes)) == 0) return known.data();
    functions_.push_back(std::move(across));
    return functions_.back().data();
  }

  /// Whether functions of quadratic splines are those of a uniform grid away from walls: polynomials and
  /// control points are, but for the rounding of the axis that made them.
  [[nodiscard]] bool is_uniform(const Lanes* functions) const {
    if (degree_ != 2) return false;
    constexpr double uniform[] = {0.5, 0.5, 0, -1, 1, 0, 0.5, -1, 0.5, -0.5, 0.5, 1.5}, rounding = 1e-14;
    bool is = true;
    for (int m = 0; m < size_; ++m)
      for (int lane = 0; lane < width; ++lane) is &= std::abs(functions[m][lane] - uniform[m]) < rounding;
    return is;
  }

 private:
  /// Numbers that belong to no cell take the nearest, so that their arithmetic stays harmless.
  [[nodiscard]] int cell_along(int number, int a) const {
    return std::min(a == 0 ? number % stride_ : number / stride_,
                    axis_[static_cast<std::size_t>(a)].cells - 1);
  }

  std::array<LineOfCells, 2> axis_;
  int stride_, degree_, size_;
  std::vector<std::vector<Lanes>> functions_;
};

}  // namespace mpm::MPM_ISA

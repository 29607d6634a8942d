#include "solver/lanes/line_mass.hpp"

#include <algorithm>

#include "solver/grid/matrices/cholesky.hpp"
#include "solver/grid/matrices/tensor_mass.hpp"

namespace mpm {

LineMass line_mass(const Axis& axis, bool walls_prescribe) {
  const Eigen::MatrixXd whole = mass_along(axis);
  const auto count = static_cast<int>(whole.rows());
  LineMass line{std::min(3 * axis.degree - 1, (count - 1) / 2), count, {}, {}};
  for (int i = 0; i < count; ++i) line.diagonal.push_back(whole(i, i));

  Eigen::MatrixXd mass = whole;
  if (!axis.periodic && walls_prescribe)
    for (const int wall : {0, count - 1}) {
      mass.row(wall).setZero();
      mass.col(wall).setZero();
      mass(wall, wall) = whole(wall, wall);
    }
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(count, count);
  for (int i = 0; i < count; ++i) {
    std::vector<int> near;
    for (int d = -line.reach; d <= line.reach; ++d) {
      const int j = i + d;
      if (axis.periodic || (j >= 0 && j < count)) near.push_back((j + count) % count);
    }
    const Eigen::MatrixXd columns = mass(Eigen::all, near);
    const Eigen::VectorXd column = solve_positive_definite(columns.transpose() * columns, mass(near, i));
    for (std::size_t k = 0; k < near.size(); ++k) inverse(near[k], i) = column[static_cast<Eigen::Index>(k)];
  }
  inverse = (0.5 * (inverse + inverse.transpose())).eval();
  for (int d = -line.reach; d <= line.reach; ++d)
    for (int i = 0; i < count; ++i) {
      const int j = axis.periodic ? (i + d + count) % count : i + d;
      line.inverse.push_back(j < 0 || j >= count ? 0 : inverse(i, j));
    }
  return line;
}

}  // namespace mpm

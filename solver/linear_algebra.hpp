#pragma once

#include <Eigen/Core>
#include <vector>

namespace mpm {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;

/// A vector at every node, or at every particle.
using VectorField = std::vector<Vec2>;
/// A scalar at every node, or at every particle.
using ScalarField = std::vector<double>;

}  // namespace mpm

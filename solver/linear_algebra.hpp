#pragma once

#include <Eigen/Core>
#include <vector>

namespace mpm {

// Left to scalar registers (with EIGEN_UNALIGNED_VECTORIZE off): two numbers that are made one by one and
// read as a vector have to go through memory, which costs the particle loops of Solver a sixth.
using Vec2 = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;
using Mat2 = Eigen::Matrix<double, 2, 2, Eigen::DontAlign>;

/// A vector at every node, or at every particle.
using VectorField = std::vector<Vec2>;
/// A scalar at every node, or at every particle.
using ScalarField = std::vector<double>;

}  // namespace mpm

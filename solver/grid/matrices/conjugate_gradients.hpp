#pragma once

#include "solver/linear_algebra.hpp"

namespace mpm {

/// Preconditioned conjugate gradients (Hestenes and Stiefel 1952) for A v = b, the two components of a nodal
/// field at once: each has its own step lengths, the matrix is read once for both.
///   multiply(p, q)     q <- A p
///   precondition(r, z) z <- P^-1 r, P symmetric and positive definite
/// `solution` holds the start and becomes v. Ends when both components' residual, measured by P^-1, is below
/// `tolerance` times that of b, or after `most_iterations`.
template <class Multiply, class Precondition>
void conjugate_gradients(const Multiply& multiply, const Precondition& precondition, const VectorField& b,
                         VectorField& solution, double tolerance, int most_iterations) {
  const auto dot = [](const VectorField& a, const VectorField& c) {
    Vec2 sum = Vec2::Zero();
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].cwiseProduct(c[i]);
    return sum;
  };
  const auto quotient = [](const Vec2& a, const Vec2& c) {  // a component that is solved stays as it is
    return Vec2(c.x() > 0 ? a.x() / c.x() : 0, c.y() > 0 ? a.y() / c.y() : 0);
  };
  VectorField residual(b.size()), z(b.size()), product(b.size());
  precondition(b, z);
  const Vec2 enough = tolerance * tolerance * dot(b, z);
  multiply(solution, product);
  for (std::size_t i = 0; i < b.size(); ++i) residual[i] = b[i] - product[i];
  precondition(residual, z);
  VectorField direction = z;
  Vec2 size = dot(residual, z);
  for (int iteration = 0; iteration < most_iterations && (size.array() > enough.array()).any(); ++iteration) {
    multiply(direction, product);
    const Vec2 step = quotient(size, dot(direction, product));
    for (std::size_t i = 0; i < b.size(); ++i) {
      solution[i] += step.cwiseProduct(direction[i]);
      residual[i] -= step.cwiseProduct(product[i]);
    }
    precondition(residual, z);
    const Vec2 next = dot(residual, z);
    const Vec2 turn = quotient(next, size);
    for (std::size_t i = 0; i < b.size(); ++i) direction[i] = z[i] + turn.cwiseProduct(direction[i]);
    size = next;
  }
}

}  // namespace mpm

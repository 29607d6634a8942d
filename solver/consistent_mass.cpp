#include "solver/consistent_mass.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>

namespace mpm {
namespace {

// Reached in about 20 (quadratic) to 50 (cubic) iterations on full cells; the cap is for near-empty ones,
// where the matrix may be singular and the remaining error belongs to functions that no particle sees.
constexpr double tolerance = 1e-15;
constexpr int most_iterations = 200;
// Pivots of regular strips stay above 1e-3; fewer particles than functions leave some at round-off.
constexpr double least_pivot = 1e-10;

}  // namespace

ConsistentMass::ConsistentMass(const Grid& grid, const WallNodes& walls)
    : strip_(grid.x.count() == 1 || grid.y.count() == 1),
      matrix_(pair_pattern(grid, 1)),
      constrained_(matrix_),
      slots_(grid, matrix_, 1) {
  for (std::size_t i = 0; i < grid.size(); ++i) is_wall_.push_back(walls.is_wall(i) ? 1 : 0);
  if (strip_) direct_.analyzePattern(constrained_);
}

void ConsistentMass::assemble(const StencilTable& table, const ScalarField& particle_mass) {
  if (table.value == last_.value && table.node == last_.node) return;  // rows that only slid along the flow
  std::fill(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros(), 0.0);
  const std::vector<int> distances = slots_.distances(table.width, table.support_x);
  const auto width = static_cast<std::size_t>(table.width);
  double* entry = matrix_.valuePtr();
  for (std::size_t p = 0; p < particle_mass.size(); ++p) {
    const int* node = table.node.data() + p * width;
    const double* value = table.value.data() + p * width;
    for (std::size_t k = 0; k < width; ++k)
      for (std::size_t l = 0; l < width; ++l)
        entry[slots_.position(node[k], distances[k * width + l], 0)] +=
            particle_mass[p] * (value[k] * value[l]);
  }
  constrain();
  last_ = table;
}

void ConsistentMass::constrain() {
  const Eigen::VectorXd diagonal = matrix_.diagonal();
  largest_ = diagonal.maxCoeff();
  is_fixed_ = is_wall_;
  for (Eigen::Index i = 0; i < diagonal.size(); ++i)
    if (diagonal[i] <= negligible_mass * largest_) is_fixed_[static_cast<std::size_t>(i)] = 1;
  constrained_ = matrix_;
  decouple(constrained_, is_fixed_, largest_);
  if (!strip_) return;
  direct_.factorize(constrained_);
  direct_holds_ = direct_.info() == Eigen::Success &&
                  direct_.vectorD().minCoeff() > least_pivot * direct_.vectorD().maxCoeff();
}

void ConsistentMass::solve_from(VectorField& guess, VectorField& field) const {
  VectorField fixed(field.size(), Vec2::Zero());
  for (std::size_t i = 0; i < field.size(); ++i) {
    if (is_wall_[i]) fixed[i] = guess[i];
    if (is_fixed_[i]) guess[i] = fixed[i];
  }
  auto rows = rows_of(field);
  rows -= matrix_ * rows_of(fixed);
  for (std::size_t i = 0; i < field.size(); ++i)
    if (is_fixed_[i]) field[i] = largest_ * fixed[i];
  const Eigen::MatrixX2d right_side = rows;
  if (direct_holds_) {
    rows = direct_.solve(right_side);
  } else {
    Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower | Eigen::Upper> iteration;
    iteration.setTolerance(tolerance);
    iteration.setMaxIterations(most_iterations);
    iteration.compute(constrained_);
    const Eigen::MatrixX2d start = rows_of(guess);
    rows = iteration.solveWithGuess(right_side, start);
  }
  for (std::size_t i = 0; i < field.size(); ++i)
    if (is_fixed_[i]) field[i] = fixed[i];
}

}  // namespace mpm

#include "solver/transfer/consistent_mass.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <cmath>

#include "solver/grid/matrices/conjugate_gradients.hpp"

namespace mpm {
namespace {

// Just above what round-off lets the iteration reach; a dozen iterations on full cells. The cap is for
// near-empty ones, where the matrix may be singular and the remaining error belongs to functions that no
// particle sees.
constexpr double tolerance = 1e-14;
constexpr int most_iterations = 200;
// Pivots of regular strips stay above 1e-3; fewer particles than functions leave some at round-off.
constexpr double least_pivot = 1e-10;

}  // namespace

ConsistentMass::Direct::Direct(const Grid& grid)
    : matrix(pair_pattern(grid, 1)), constrained(matrix), slots(grid, matrix, 1) {
  const Axis& along = grid.x.count() == 1 ? grid.y : grid.x;
  if (along.periodic)
    factor.analyzePattern(constrained);
  else
    band.emplace(2 * along.count(), 2 * along.degree);
}

bool ConsistentMass::Direct::factorise() {
  if (!band) {
    factor.factorize(constrained);
    return factor.info() == Eigen::Success &&
           factor.vectorD().minCoeff() > least_pivot * factor.vectorD().maxCoeff();
  }
  band->set_zero();
  for (int column = 0; column < constrained.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(constrained, column); entry; ++entry)
      for (int c : {0, 1})
        if (const int row = static_cast<int>(entry.row()); row >= column)
          band->at(2 * row + c, 2 * column + c) = entry.value();
  band->factorise();
  double largest = 0;
  for (int i = 0; i < band->size(); ++i) largest = std::max(largest, band->at(i, i));
  for (int i = 0; i < band->size(); ++i)
    if (!(band->at(i, i) > least_pivot * largest)) return false;
  return true;
}

void ConsistentMass::Direct::solve(VectorField& field) const {
  if (band) return band->solve(field.front().data());
  const Eigen::MatrixX2d right_side = rows_of(field);
  rows_of(field) = factor.solve(right_side);
}

void ConsistentMass::Direct::assemble(const StencilTable& table, const ScalarField& particle_mass) {
  std::fill(matrix.valuePtr(), matrix.valuePtr() + matrix.nonZeros(), 0.0);
  const std::vector<int> distances = slots.distances(table.width, table.support_x);
  const auto width = static_cast<std::size_t>(table.width);
  double* entry = matrix.valuePtr();
  for (std::size_t p = 0; p < particle_mass.size(); ++p) {
    const int* node = table.node.data() + p * width;
    const double* value = table.value.data() + p * width;
    for (std::size_t k = 0; k < width; ++k)
      for (std::size_t l = 0; l < width; ++l)
        entry[slots.position(node[k], distances[k * width + l], 0)] +=
            particle_mass[p] * (value[k] * value[l]);
  }
}

ConsistentMass::ConsistentMass(const Grid& grid, const WallNodes& walls) : ConsistentMass(grid) {
  for (std::size_t i = 0; i < grid.size(); ++i) is_wall_[i] = walls.is_wall(i) ? 1 : 0;
  has_walls_ = std::count(is_wall_.begin(), is_wall_.end(), 1) > 0;
}

ConsistentMass::ConsistentMass(const Grid& grid) : is_wall_(grid.size(), 0) {
  if (grid.x.count() == 1 || grid.y.count() == 1)
    direct_.emplace(grid);
  else
    iterative_.emplace(grid);
}

void ConsistentMass::assemble_direct(const StencilTable& table, const Grid& grid,
                                     const Particles& particles) {
  const Eigen::Index axis = grid.x.count() == 1 ? 1 : 0;
  const bool stand =
      across_.same(particles.size(), [&](std::size_t p) { return particles.position[p][axis]; });
  const bool weigh = masses_.same(particles.size(), [&](std::size_t p) { return particles.mass[p]; });
  if (stand && weigh) return;  // rows that only slid along the flow
  direct_->assemble(table, particles.mass);
  fix_nodes();
}

void ConsistentMass::fix_nodes() {
  const std::size_t count = is_wall_.size();
  ScalarField diagonal(count);
  for (std::size_t i = 0; i < count; ++i)
    diagonal[i] = direct_ ? direct_->matrix.coeff(static_cast<int>(i), static_cast<int>(i))
                          : iterative_->matrix.diagonal(i);
  largest_ = *std::max_element(diagonal.begin(), diagonal.end());
  is_fixed_ = is_wall_;
  for (std::size_t i = 0; i < count; ++i)
    if (diagonal[i] <= negligible_mass * largest_) is_fixed_[i] = 1;
  if (iterative_) {
    for (std::size_t i = 0; i < count; ++i)
      iterative_->scale[i] = is_fixed_[i] ? 0 : std::sqrt(iterative_->uniform.diagonal(i) / diagonal[i]);
    return;
  }
  direct_->constrained = direct_->matrix;
  decouple(direct_->constrained, is_fixed_, largest_);
  direct_->holds = direct_->factorise();
}

void ConsistentMass::solve_from(VectorField& guess, VectorField& field, const ScalarField& nodal_mass) {
  Vec2 total = Vec2::Zero();
  for (const Vec2& share : field) total += share;
  fixed_.assign(field.size(), Vec2::Zero());
  for (std::size_t i = 0; i < field.size(); ++i) {
    if (is_wall_[i]) fixed_[i] = guess[i];
    if (is_fixed_[i]) guess[i] = fixed_[i];
  }
  if (direct_)
    solve_direct(guess, field);
  else
    iterate(guess, field);
  if (!has_walls_) keep_total(total, nodal_mass, field);
  for (std::size_t i = 0; i < field.size(); ++i)
    if (is_fixed_[i]) field[i] = fixed_[i];
}

void ConsistentMass::solve_direct(VectorField& guess, VectorField& field) {
  for (std::size_t i = 0; i < field.size(); ++i)
    if (!fixed_[i].isZero(0))
      for (SparseMatrix::InnerIterator entry(direct_->matrix, static_cast<int>(i)); entry; ++entry)
        field[static_cast<std::size_t>(entry.row())] -= entry.value() * fixed_[i];
  for (std::size_t i = 0; i < field.size(); ++i)
    if (is_fixed_[i]) field[i] = largest_ * fixed_[i];
  if (direct_->holds) return direct_->solve(field);
  Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower | Eigen::Upper> iteration;
  iteration.setTolerance(tolerance);
  iteration.setMaxIterations(most_iterations);
  iteration.compute(direct_->constrained);
  const Eigen::MatrixX2d right_side = rows_of(field), start = rows_of(guess);
  rows_of(field) = iteration.solveWithGuess(right_side, start);
}

void ConsistentMass::iterate(const VectorField& guess, VectorField& field) {
  Iterative& plane = *iterative_;
  const auto free_nodes_only = [&](VectorField& v) {
    for (std::size_t i = 0; i < v.size(); ++i)
      if (is_fixed_[i]) v[i].setZero();
  };
  VectorField right_side(field.size());
  plane.matrix.multiply(fixed_, right_side);
  for (std::size_t i = 0; i < field.size(); ++i) right_side[i] = field[i] - right_side[i];
  free_nodes_only(right_side);
  field = guess;
  free_nodes_only(field);
  conjugate_gradients(
      [&](const VectorField& v, VectorField& product) {
        plane.matrix.multiply(v, product);
        free_nodes_only(product);
      },
      [&](const VectorField& residual, VectorField& z) {
        for (std::size_t i = 0; i < z.size(); ++i) z[i] = plane.scale[i] * residual[i];
        plane.uniform.solve(z);
        for (std::size_t i = 0; i < z.size(); ++i) z[i] *= plane.scale[i];
      },
      right_side, field, tolerance, most_iterations);
}

/// Adds the uniform field that makes up for what the solver left: sum_i (M v)_i = sum_i m_i v_i.
void ConsistentMass::keep_total(const Vec2& total, const ScalarField& nodal_mass, VectorField& field) const {
  Vec2 missing = total;
  double mass = 0;
  for (std::size_t i = 0; i < field.size(); ++i)
    if (!is_fixed_[i]) {
      missing -= nodal_mass[i] * field[i];
      mass += nodal_mass[i];
    }
  for (Vec2& v : field) v += missing / mass;
}

const SparseMatrix& ConsistentMass::matrix(const Grid& grid) {
  if (direct_) return direct_->matrix;
  if (written_out_.rows() == 0) written_out_ = pair_pattern(grid, 1);
  std::fill(written_out_.valuePtr(), written_out_.valuePtr() + written_out_.nonZeros(), 0.0);
  iterative_->matrix.for_each(
      [&](int row, int column, double entry) { written_out_.coeffRef(row, column) += entry; });
  return written_out_;
}

}  // namespace mpm

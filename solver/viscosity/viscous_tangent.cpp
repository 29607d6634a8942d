#include "solver/viscosity/viscous_tangent.hpp"

#include <Eigen/SparseCholesky>

#include "solver/grid/matrices/banded_matrix.hpp"

namespace mpm {
namespace {

/// What D' = sym(v_l g_l^T) at a particle, a node's share of its strain rate, does to another node's force
/// g_k . dt V sigma.
Mat2 coupling(const Linearised& law, double weight, const Vec2& g_k, const Vec2& g_l) {
  const auto& [d, mu, slope] = law;
  const Vec2 d_k = d * g_k, d_l = d * g_l;
  return weight * (mu * (g_k.dot(g_l) * Mat2::Identity() + g_l * g_k.transpose() -
                         (2.0 / 3.0) * g_k * g_l.transpose()) +
                   8 * slope * d_k * d_l.transpose());
}

class PlaneTangent final : public ViscousTangent {
 public:
  explicit PlaneTangent(const Grid& grid) : whole_(pair_pattern(grid, 2)), slots_(grid, whole_, 2) {
    factors_.analyzePattern(whole_);
  }

  void factorise(const SparseMatrix& mass, const StencilTable& table, const std::vector<Linearised>& law,
                 const ScalarField& weight, const std::vector<char>& fixed) override {
    std::fill(whole_.valuePtr(), whole_.valuePtr() + whole_.nonZeros(), 0.0);
    for (int column = 0; column < mass.outerSize(); ++column)
      for (SparseMatrix::InnerIterator entry(mass, column); entry; ++entry)
        for (int a : {0, 1})
          whole_.coeffRef(2 * static_cast<int>(entry.row()) + a, 2 * column + a) += entry.value();
    const std::vector<int> distances = slots_.distances(table.width, table.support_x);
    for (std::size_t p = 0; p < law.size(); ++p) add(law[p], weight[p], p, table, distances);
    std::vector<char> marked;
    for (const char is_fixed : fixed) marked.insert(marked.end(), 2, is_fixed);
    matrix_ = whole_;
    decouple(matrix_, marked, matrix_.diagonal().maxCoeff());
    factors_.factorize(matrix_);
  }

  void solve(VectorField& field) const override {
    Eigen::Map<Eigen::VectorXd> x(field.front().data(), whole_.rows());
    x = factors_.solve(x).eval();
  }

  [[nodiscard]] Vec2 row_times(std::size_t node, const VectorField& field) const override {
    const Eigen::Map<const Eigen::VectorXd> x(field.front().data(), whole_.rows());
    const auto row = 2 * static_cast<Eigen::Index>(node);  // a column, by symmetry
    return {whole_.col(row).dot(x), whole_.col(row + 1).dot(x)};
  }

  void add_columns(std::size_t node, const Vec2& v, VectorField& field) const override {
    Eigen::Map<Eigen::VectorXd> x(field.front().data(), whole_.rows());
    for (int a : {0, 1}) x += whole_.col(2 * static_cast<Eigen::Index>(node) + a) * v[a];
  }

 private:
  void add(const Linearised& law, double weight, std::size_t p, const StencilTable& table,
           const std::vector<int>& distances) {
    const auto width = static_cast<std::size_t>(table.width);
    for (std::size_t k = 0; k < width; ++k)
      for (std::size_t l = 0; l < width; ++l) {
        const std::size_t e = p * width + k;
        const Mat2 block = coupling(law, weight, table.gradient[e], table.gradient[p * width + l]);
        for (int b : {0, 1}) {
          const std::size_t first = slots_.position(table.node[e], distances[k * width + l], b);
          for (int a : {0, 1}) whole_.valuePtr()[first + static_cast<std::size_t>(a)] += block(a, b);
        }
      }
  }

  SparseMatrix whole_, matrix_;
  PairSlots slots_;
  Eigen::SimplicialLDLT<SparseMatrix> factors_;
};

class StripTangent final : public ViscousTangent {
 public:
  explicit StripTangent(const Grid& grid)
      : whole_(2 * static_cast<int>(grid.size()), 2 * grid.x.degree + 1), factors_(whole_) {}

  void factorise(const SparseMatrix& mass, const StencilTable& table, const std::vector<Linearised>& law,
                 const ScalarField& weight, const std::vector<char>& fixed) override {
    whole_.set_zero();
    for (int column = 0; column < mass.outerSize(); ++column)
      for (SparseMatrix::InnerIterator entry(mass, column); entry; ++entry)
        for (int a : {0, 1})
          if (entry.row() >= column)
            whole_.at(2 * static_cast<int>(entry.row()) + a, 2 * column + a) += entry.value();
    for (std::size_t p = 0; p < law.size(); ++p) add(law[p], weight[p], p, table);
    marked_.clear();
    for (const char is_fixed : fixed) marked_.insert(marked_.end(), 2, is_fixed);
    factors_ = whole_;
    factors_.decouple(marked_);
    factors_.factorise();
  }

  void solve(VectorField& field) const override { factors_.solve(field.front().data()); }

  [[nodiscard]] Vec2 row_times(std::size_t node, const VectorField& field) const override {
    const int row = 2 * static_cast<int>(node);
    return {whole_.row_times(row, field.front().data()), whole_.row_times(row + 1, field.front().data())};
  }

  void add_columns(std::size_t node, const Vec2& v, VectorField& field) const override {
    for (int a : {0, 1}) whole_.add_column(2 * static_cast<int>(node) + a, v[a], field.front().data());
  }

 private:
  /// Stencils run along one axis: every pair of nodes has the block of unit slopes times both their slopes.
  void add(const Linearised& law, double weight, std::size_t p, const StencilTable& table) {
    const auto width = static_cast<std::size_t>(table.width);
    const Mat2 block = coupling(law, weight, Vec2::UnitY(), Vec2::UnitY());
    for (std::size_t k = p * width; k < (p + 1) * width; ++k)
      for (std::size_t l = p * width; l <= k; ++l) {
        const double slopes = table.gradient[k].y() * table.gradient[l].y();
        const int row = 2 * table.node[k], column = 2 * table.node[l];
        whole_.at(row, column) += slopes * block(0, 0);
        whole_.at(row + 1, column) += slopes * block(1, 0);
        whole_.at(row + 1, column + 1) += slopes * block(1, 1);
        if (k != l) whole_.at(row, column + 1) += slopes * block(0, 1);
      }
  }

  BandedMatrix whole_, factors_;
  std::vector<char> marked_;  // work space
};

}  // namespace

std::unique_ptr<ViscousTangent> make_viscous_tangent(const Grid& grid, bool is_strip) {
  if (is_strip && !grid.y.periodic) return std::make_unique<StripTangent>(grid);
  return std::make_unique<PlaneTangent>(grid);
}

}  // namespace mpm

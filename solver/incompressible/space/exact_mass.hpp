#pragma once

#include <Eigen/SparseCholesky>
#include <array>

#include "solver/incompressible/space/velocity_space.hpp"

namespace mpm::incompressible {

/// Mass of the uniform fluid over the unknowns of a velocity space, per density [m2]: a product of the two
/// axes', so that it is applied and inverted along one axis at a time.
class ExactMass {
 public:
  explicit ExactMass(const VelocitySpace& space);

  [[nodiscard]] VectorXd times(const VectorXd& unknowns) const;
  /// Solves M x = b.
  [[nodiscard]] VectorXd solved(const VectorXd& loads) const;
  /// The whole matrix.
  [[nodiscard]] SparseMatrix matrix() const;

  /// One component alone, in place of a vector of both.
  [[nodiscard]] MatrixXd times(int component, const MatrixXd& unknowns) const;
  [[nodiscard]] MatrixXd solved(int component, const MatrixXd& loads) const;

 private:
  using Factor = Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>>;
  struct AlongAxis {
    SparseMatrix mass;
    Factor factor;
  };
  [[nodiscard]] const AlongAxis& along(int component, int axis) const {
    return along_[static_cast<std::size_t>(2 * component + axis)];
  }
  template <class PerComponent>
  [[nodiscard]] VectorXd by_component(const VectorXd& both, const PerComponent& apply) const;

  const VelocitySpace& space_;
  std::array<AlongAxis, 4> along_;
};

/// Sum over the functions of every unknown, on both sides: E^T A E.
SparseMatrix over_unknowns(const SparseMatrix& functions, const Unknowns& unknowns);

}  // namespace mpm::incompressible

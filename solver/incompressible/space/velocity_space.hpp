#pragma once

#include <array>
#include <functional>

#include "solver/incompressible/space/spline_axis.hpp"
#include "solver/scene/scene.hpp"

namespace mpm::incompressible {

/// A velocity by its coefficients, over all functions of both axes: u in S_k x S_{k-1}, v in S_{k-1} x S_k;
/// rows along x, columns along y [m/s].
struct VelocityField {
  MatrixXd u, v;
};

/// Kronecker product for arrays whose rows run along x: (along_y (x) along_x) vec(A) = vec(along_x A
/// along_y^T).
SparseMatrix kronecker(const SparseMatrix& along_y, const SparseMatrix& along_x);
/// Two matrices, of u and of v, as one of both.
SparseMatrix block_diagonal(const SparseMatrix& first, const SparseMatrix& second);
/// Z^T A Z for a basis Z, without the entries that cancel.
SparseMatrix reduced_to(const SparseMatrix& basis, const SparseMatrix& form);

/// The pair S_k x S_{k-1}, S_{k-1} x S_k on a scene's grid: its divergences fill S_{k-1} x S_{k-1}, so that a
/// velocity whose divergence vanishes against that space vanishes at every point (Evans & Hughes 2013).
/// Normal velocities are zero on walls; tangential ones are left to the weak form. A vector of unknowns holds
/// those of u, x fastest, then those of v.
class VelocitySpace {
 public:
  VelocitySpace(const Scene& scene, int degree);

  [[nodiscard]] const SplineAxis& axis(int a) const { return axes_[static_cast<std::size_t>(a)]; }
  [[nodiscard]] int degree() const { return axes_[0].degree(); }
  /// Unknowns of component c (0: u, 1: v) along an axis.
  [[nodiscard]] const Unknowns& unknowns(int component, int a) const {
    return component == a ? axis(a).normal() : axis(a).tangential();
  }
  [[nodiscard]] Eigen::Index size(int component) const {
    return static_cast<Eigen::Index>(unknowns(component, 0).count) * unknowns(component, 1).count;
  }
  [[nodiscard]] Eigen::Index size() const { return size(0) + size(1); }

  /// Coefficients of all functions for a vector of unknowns; and the sums over the functions of every
  /// unknown.
  [[nodiscard]] VelocityField extended(const VectorXd& unknowns) const;
  [[nodiscard]] VectorXd folded(const VelocityField& functions) const;
  /// Extends one component: `of` its unknowns (rows x columns), `to` all its functions.
  void extend(int component, const double* of, MatrixXd& to) const;
  void fold(int component, const MatrixXd& from, double* to) const;

  /// Columns that span the velocities of this space that are solenoidal at every point: curls of the stream
  /// functions in S_k x S_k that are constant on every wall, and the mean flows along directions that are
  /// periodic.
  [[nodiscard]] SparseMatrix solenoidal_basis() const;

  /// From the unknowns of a velocity to those of its divergence in S_{k-1} x S_{k-1} [1/m].
  [[nodiscard]] SparseMatrix divergence() const;

  /// Integral of every function of a component times a field: entry of an unknown, integral of N_i f dA [m2
  /// times the field's unit], by Gauss points exact to degree 2k + 1.
  [[nodiscard]] VectorXd load(
      const std::function<void(const VectorField& points, VectorField& values)>& field) const;

  /// The velocity of a field at a point, and its gradient L_ab = d v_a/d x_b [1/s].
  [[nodiscard]] Vec2 value(const VelocityField& field, const Vec2& x) const;
  [[nodiscard]] Mat2 gradient(const VelocityField& field, const Vec2& x) const;

 private:
  std::array<SplineAxis, 2> axes_;
  VectorField points_;                                    // Gauss points of all cells, row by row
  std::array<std::array<SparseMatrix, 2>, 2> integrals_;  // by axis, less: from values there to integrals
};

/// Cell of a coordinate and the place in it, in [0, 1].
struct PlaceInCell {
  int cell;
  double xi;
  PlaceInCell(const SplineAxis& axis, double x);
};

}  // namespace mpm::incompressible

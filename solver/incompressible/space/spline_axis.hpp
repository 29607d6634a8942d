#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

namespace mpm::incompressible {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

/// Which functions of an axis are unknowns. All arrays over an axis are kept in full, cell c touching the
/// functions c .. c + degree whether the axis is periodic or not; an unknown stands for one of them, or for
/// two that a periodic axis takes for the same. What a wall prescribes to be zero stands for none.
struct Unknowns {
  std::vector<int> of;  ///< for every function of the axis: its unknown, or -1
  int count = 0;

  /// functions x count, ones where a function is an unknown's.
  [[nodiscard]] SparseMatrix extension() const;
};

/// One direction of the grid with its B-splines of degree k (S_k) and k - 1 (S_{k-1}), into which the first's
/// derivatives fall exactly: clamped between walls, periodic otherwise (de Boor 1978; Evans & Hughes 2013).
class SplineAxis {
 public:
  /// `cells` of equal size on [0, length]; a periodic axis needs at least one, clamped ends need one.
  SplineAxis(double length, int cells, bool periodic, int degree);

  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] int cells() const { return cells_; }
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] double cell_size() const { return length_ / cells_; }
  [[nodiscard]] bool periodic() const { return periodic_; }
  /// Number of functions of degree k (`less` = 0) or k - 1 (`less` = 1).
  [[nodiscard]] int functions(int less) const { return cells_ + degree_ - less; }

  /// Coefficients of the polynomials in xi = x/h - c that the degree + 1 functions are in cell c, power by
  /// power from the highest: entry [power][function].
  [[nodiscard]] const double* polynomials(int less, int cell) const {
    const int size = degree_ - less + 1;
    return polynomials_[static_cast<std::size_t>(less)].data() +
           static_cast<std::ptrdiff_t>(cell) * size * size;
  }

  /// Unknowns of the velocity normal to this axis' walls (S_k, zero on them), tangential to them (S_{k-1}),
  /// and of a stream function (S_k, zero on them).
  [[nodiscard]] const Unknowns& normal() const { return normal_; }
  [[nodiscard]] const Unknowns& tangential() const { return tangential_; }

  // Matrices over the functions, before unknowns are chosen.
  [[nodiscard]] SparseMatrix mass(int less) const;       ///< integral of N_i N_j [m]
  [[nodiscard]] SparseMatrix stiffness(int less) const;  ///< integral of N_i' N_j' [1/m]
  [[nodiscard]] SparseMatrix derivative() const;         ///< S_k to S_{k-1} [1/m]
  [[nodiscard]] VectorXd integrals(int less) const;      ///< of every function [m]
  /// Values and slopes [1/m] of the functions of degree k - 1 at the lower (0) or upper (1) end.
  [[nodiscard]] VectorXd end_values(int end) const;
  [[nodiscard]] VectorXd end_slopes(int end) const;

  /// Values or slopes [1/m] of the functions that are not zero in a cell, at xi in [0, 1].
  [[nodiscard]] VectorXd values(int less, int cell, double xi) const;
  [[nodiscard]] VectorXd slopes(int less, int cell, double xi) const;
  /// Second derivatives [1/m2] of those of degree k.
  [[nodiscard]] VectorXd curvatures(int cell, double xi) const;

 private:
  [[nodiscard]] double knot(int i, int degree) const;  // in cells
  [[nodiscard]] std::vector<double> polynomials_in(int cell, int degree) const;
  template <class Values>
  [[nodiscard]] SparseMatrix integrated(int less, const Values& values) const;

  double length_;
  int cells_, degree_;
  bool periodic_;
  std::array<std::vector<double>, 2> polynomials_;
  Unknowns normal_, tangential_;
};

}  // namespace mpm::incompressible

#pragma once

#include "solver/incompressible/space/stream_function.hpp"

namespace mpm::incompressible {

/// The matrix M + a T over the coordinates of a stream function, of a mass M and a symmetric tangent T that
/// cells add to, over the same entries every time: the lower triangle.
class TangentMatrix {
 public:
  /// For functions of degree k.
  TangentMatrix(const StreamFunction& psi, int cells_x, int cells_y, int k, const SparseMatrix& mass);

  void clear();
  /// Adds a symmetric block over the functions of a cell: entry (m, n), m <= n, at (n (n + 1)/2 + m) pitch.
  void add(int cell_x, int cell_y, const double* entries, int pitch);

  /// M + a T.
  [[nodiscard]] const SparseMatrix& with_mass(double a);
  /// T, both triangles.
  [[nodiscard]] SparseMatrix tangent() const;

 private:
  /// Where an entry of a cell's block goes, and its sign; twice where (m, n) and (n, m) are one entry of the
  /// diagonal, none where a function is no coordinate.
  struct Place {
    int at;
    double factor;
  };

  int cells_x_;
  std::size_t entries_;  // of a block
  SparseMatrix sum_;     // M + a T, whose pattern all have
  VectorXd mass_, tangent_;
  std::vector<Place> places_;  // by cell, by entry
};

}  // namespace mpm::incompressible

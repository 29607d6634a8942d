#pragma once

#include "solver/incompressible/space/spline_axis.hpp"
#include "solver/kernel/isa.hpp"

namespace mpm::incompressible {

/// Products of the dense matrices that take a field to modes along both axes, on the vector kernels; all are
/// zero_padded().
class ModeProducts {
 public:
  static MatrixXd zero_padded(const MatrixXd& matrix) {
    MatrixXd all =
        MatrixXd::Zero(padded(static_cast<int>(matrix.rows())), padded(static_cast<int>(matrix.cols())));
    all.topLeftCorner(matrix.rows(), matrix.cols()) = matrix;
    return all;
  }

  /// product = left x right; may be x itself.
  void operator()(const MatrixXd& left, const MatrixXd& x, const MatrixXd& right, MatrixXd& product) const {
    MatrixXd in_x;
    times(left, x, in_x);
    times(in_x, right, product);
  }

 private:
  void times(const MatrixXd& a, const MatrixXd& b, MatrixXd& c) const {
    c.resize(a.rows(), b.cols());
    multiply_(static_cast<int>(a.rows()), static_cast<int>(a.cols()), static_cast<int>(b.cols()), a.data(),
              b.data(), c.data());
  }
  DenseProduct multiply_ = dense_product();
};

}  // namespace mpm::incompressible

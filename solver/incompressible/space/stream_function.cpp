#include "solver/incompressible/space/stream_function.hpp"

namespace mpm::incompressible {

StreamFunction::StreamFunction(const VelocitySpace& space)
    : rows_(space.axis(0).functions(0)), columns_(space.axis(1).functions(0)) {
  const SplineAxis &x = space.axis(0), &y = space.axis(1);
  const bool boundless = x.periodic() && y.periodic();
  const int curls = x.normal().count * y.normal().count - (boundless ? 1 : 0);
  // Between walls the flux comes after the curls: psi is zero on the lower wall and w on the upper, where the
  // last function alone is not zero. Along y it is the flux of v = -d psi/dx.
  const auto is_flux = [&](const SplineAxis& along, const SplineAxis& across, int k) {
    return along.periodic() && !across.periodic() && k == across.functions(0) - 1;
  };
  for (int j = 0; j < columns_; ++j)
    for (int i = 0; i < rows_; ++i) {
      const int a = x.normal().of[static_cast<std::size_t>(i)],
                b = y.normal().of[static_cast<std::size_t>(j)];
      Share share;
      if (is_flux(x, y, j))
        share = {curls, 1};
      else if (is_flux(y, x, i))
        share = {curls, -1};
      else if (a >= 0 && b >= 0 && a + x.normal().count * b < curls)
        share = {a + x.normal().count * b, 1};
      shares_.push_back(share);
    }
}

MatrixXd StreamFunction::extended(const VectorXd& w) const {
  MatrixXd psi = MatrixXd::Zero(rows_, columns_);
  for (std::size_t f = 0; f < shares_.size(); ++f)
    if (shares_[f].coordinate >= 0) psi.data()[f] = shares_[f].sign * w[shares_[f].coordinate];
  return psi;
}

VectorXd StreamFunction::folded(const MatrixXd& functions, Eigen::Index size) const {
  VectorXd sums = VectorXd::Zero(size);
  for (std::size_t f = 0; f < shares_.size(); ++f)
    if (shares_[f].coordinate >= 0) sums[shares_[f].coordinate] += shares_[f].sign * functions.data()[f];
  return sums;
}

}  // namespace mpm::incompressible

#include "solver/incompressible/pressure.hpp"

#include "solver/incompressible/space/exact_mass.hpp"

namespace mpm::incompressible {

Pressure::Pressure(const VelocitySpace& space) : space_(space), divergence_(space.divergence()) {
  // Divergences have no mean between walls or around a period: D D^T has a constant to spare, which one entry
  // fixes.
  SparseMatrix square = divergence_ * divergence_.transpose();
  square.coeffRef(0, 0) *= 2;
  of_divergences_.compute(square);
  for (const int a : {0, 1})
    mass_[static_cast<std::size_t>(a)].compute(
        over_unknowns(space.axis(a).mass(1), space.axis(a).tangential()));
}

MatrixXd Pressure::balancing(const VectorXd& load) const {
  // integral of p div N = D^T (M_p p): first y = M_p p, then p.
  const VectorXd y = of_divergences_.solve(divergence_ * load);
  const Unknowns &x_unknowns = space_.axis(0).tangential(), &y_unknowns = space_.axis(1).tangential();
  const MatrixXd in_x =
      mass_[0].solve(Eigen::Map<const MatrixXd>(y.data(), x_unknowns.count, y_unknowns.count));
  const MatrixXd turned = in_x.transpose();
  const MatrixXd p = MatrixXd(mass_[1].solve(turned)).transpose();
  MatrixXd all(static_cast<Eigen::Index>(x_unknowns.of.size()),
               static_cast<Eigen::Index>(y_unknowns.of.size()));
  for (std::size_t j = 0; j < y_unknowns.of.size(); ++j)
    for (std::size_t i = 0; i < x_unknowns.of.size(); ++i)
      all(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = p(x_unknowns.of[i], y_unknowns.of[j]);
  const VectorXd along_x = space_.axis(0).integrals(1), along_y = space_.axis(1).integrals(1);
  const double mean = along_x.dot(all * along_y) / (along_x.sum() * along_y.sum());
  return all.array() - mean;
}

double Pressure::value(const MatrixXd& coefficients, const Vec2& x) const {
  const PlaceInCell px(space_.axis(0), x.x()), py(space_.axis(1), x.y());
  const int k = space_.degree();
  return space_.axis(0)
      .values(1, px.cell, px.xi)
      .dot(coefficients.block(px.cell, py.cell, k, k) * space_.axis(1).values(1, py.cell, py.xi));
}

}  // namespace mpm::incompressible

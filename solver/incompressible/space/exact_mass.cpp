#include "solver/incompressible/space/exact_mass.hpp"

namespace mpm::incompressible {

SparseMatrix over_unknowns(const SparseMatrix& functions, const Unknowns& unknowns) {
  const SparseMatrix extension = unknowns.extension();
  return extension.transpose() * functions * extension;
}

ExactMass::ExactMass(const VelocitySpace& space) : space_(space) {
  for (const int component : {0, 1})
    for (const int a : {0, 1}) {
      AlongAxis& one = along_[static_cast<std::size_t>(2 * component + a)];
      one.mass = over_unknowns(space.axis(a).mass(component == a ? 0 : 1), space.unknowns(component, a));
      one.factor.compute(one.mass);
    }
}

MatrixXd ExactMass::times(int component, const MatrixXd& unknowns) const {
  const MatrixXd in_x = along(component, 0).mass * unknowns;
  return (along(component, 1).mass * in_x.transpose()).transpose();
}

MatrixXd ExactMass::solved(int component, const MatrixXd& loads) const {
  const MatrixXd in_x = along(component, 0).factor.solve(loads);
  const MatrixXd turned = in_x.transpose();
  return MatrixXd(along(component, 1).factor.solve(turned)).transpose();
}

template <class PerComponent>
VectorXd ExactMass::by_component(const VectorXd& both, const PerComponent& apply) const {
  VectorXd result(both.size());
  for (const int c : {0, 1}) {
    const Eigen::Index first = c == 0 ? 0 : space_.size(0);
    const Eigen::Index rows = space_.unknowns(c, 0).count, columns = space_.unknowns(c, 1).count;
    const MatrixXd part = Eigen::Map<const MatrixXd>(both.data() + first, rows, columns);
    Eigen::Map<MatrixXd>(result.data() + first, rows, columns) = apply(c, part);
  }
  return result;
}

VectorXd ExactMass::times(const VectorXd& unknowns) const {
  return by_component(unknowns, [&](int c, const MatrixXd& part) { return times(c, part); });
}

VectorXd ExactMass::solved(const VectorXd& loads) const {
  return by_component(loads, [&](int c, const MatrixXd& part) { return solved(c, part); });
}

SparseMatrix ExactMass::matrix() const {
  return block_diagonal(kronecker(along(0, 1).mass, along(0, 0).mass),
                        kronecker(along(1, 1).mass, along(1, 0).mass));
}

}  // namespace mpm::incompressible

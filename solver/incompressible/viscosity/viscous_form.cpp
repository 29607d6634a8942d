#include "solver/incompressible/viscosity/viscous_form.hpp"

#include <cmath>

#include "solver/scene/seeding.hpp"

namespace mpm::incompressible {
namespace {

/// Integral of every function of degree k times the share of its velocity with which a wall moves [m].
VectorXd moved(const SplineAxis& axis, const std::function<double(double)>& share) {
  if (!share) return axis.integrals(0);
  const CellPoints gauss = cell_points(Seeding::Rule::Gauss, axis.degree() + 2);
  VectorXd sum = VectorXd::Zero(axis.functions(0));
  for (int cell = 0; cell < axis.cells(); ++cell)
    for (std::size_t g = 0; g < gauss.position.size(); ++g)
      sum.segment(cell, axis.degree() + 1) += gauss.weight[g] * axis.cell_size() *
                                              share((cell + gauss.position[g]) * axis.cell_size()) *
                                              axis.values(0, cell, gauss.position[g]);
  return sum;
}

/// What an end of an axis adds to the stiffness of the velocity along the wall there, and the load of its
/// unit motion.
struct AtWall {
  SparseMatrix matrix;
  VectorXd load;
};

AtWall at_wall(const SplineAxis& axis, int end, double slip_length) {
  const VectorXd a = axis.end_values(end), slope = axis.end_slopes(end);
  const Eigen::Index n = a.size();
  AtWall wall{SparseMatrix(n, n), VectorXd::Zero(n)};
  if (std::isinf(slip_length)) return wall;
  if (slip_length > 0) {
    wall.matrix = (a * a.transpose() / slip_length).sparseView();
    wall.load = a / slip_length;
    return wall;
  }
  const VectorXd b = end == 0 ? VectorXd(-slope) : slope;  // along the outward normal
  const double c = wall_penalty * axis.degree() / axis.cell_size();
  wall.matrix = MatrixXd(c * a * a.transpose() - a * b.transpose() - b * a.transpose()).sparseView();
  wall.load = c * a - b;
  return wall;
}

VectorXd folded(const VectorXd& functions, const Unknowns& unknowns) {
  return unknowns.extension().transpose() * functions;
}

}  // namespace

ViscousForm::ViscousForm(const VelocitySpace& space, const Scene& scene, const WallShares& shares)
    : space_(space) {
  std::array<SparseMatrix, 2> blocks;
  for (const int component : {0, 1}) {
    const int across = 1 - component;  // the axis along which walls hold this component back
    const SplineAxis &normal = space.axis(component), &tangential = space.axis(across);
    SparseMatrix held = tangential.stiffness(1);
    for (const int end : {0, 1}) {
      if (tangential.periodic()) break;
      const auto edge = static_cast<std::size_t>(2 * across + end);
      const Side& side = scene.sides[edge];
      const AtWall wall = at_wall(tangential, end, side.slip_length);
      held = held + wall.matrix;
      const VectorXd along = folded(moved(normal, shares[edge]), space.unknowns(component, component));
      const VectorXd into = folded(wall.load, space.unknowns(component, across));
      MatrixXd load = along * into.transpose();
      if (component == 1) load.transposeInPlace();
      VectorXd both = VectorXd::Zero(space.size());
      Eigen::Map<MatrixXd>(both.data() + (component == 0 ? 0 : space.size(0)), load.rows(), load.cols()) =
          load;
      walls_.push_back({&side, component, both});
    }
    held_[static_cast<std::size_t>(across)] = held;
    const SparseMatrix along_normal =
        over_unknowns(normal.stiffness(0), space.unknowns(component, component));
    const SparseMatrix mass_normal = over_unknowns(normal.mass(0), space.unknowns(component, component));
    const SparseMatrix along_tangential = over_unknowns(held, space.unknowns(component, across));
    const SparseMatrix mass_tangential = over_unknowns(tangential.mass(1), space.unknowns(component, across));
    blocks[static_cast<std::size_t>(component)] =
        component == 0 ? SparseMatrix(kronecker(mass_tangential, along_normal) +
                                      kronecker(along_tangential, mass_normal))
                       : SparseMatrix(kronecker(along_normal, mass_tangential) +
                                      kronecker(mass_normal, along_tangential));
  }
  matrix_ = block_diagonal(blocks[0], blocks[1]);
}

VectorXd ViscousForm::wall_load(double t) const {
  VectorXd sum = VectorXd::Zero(space_.size());
  for (const Wall& wall : walls_)
    if (const double speed = wall.side->velocity(t)[wall.along]; speed != 0) sum += speed * wall.load;
  return sum;
}

}  // namespace mpm::incompressible

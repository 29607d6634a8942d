#include "solver/incompressible/lanes/plane_setup.hpp"

#include <Eigen/SparseCholesky>

#include "solver/incompressible/space/exact_mass.hpp"

namespace mpm::incompressible {
namespace {

/// What lies beside the diagonal, column by column.
LineFactor::Entries entries_of(const SparseMatrix& matrix) {
  LineFactor::Entries entries;
  for (int k = 0; k < matrix.outerSize(); ++k) {
    entries.begin.push_back(static_cast<int>(entries.other.size()));
    for (SparseMatrix::InnerIterator it(matrix, k); it; ++it) {
      if (it.row() == k) continue;
      entries.other.push_back(static_cast<int>(it.row()));
      entries.value.push_back(it.value());
    }
  }
  entries.begin.push_back(static_cast<int>(entries.other.size()));
  return entries;
}

LineFactor factor_of(const SparseMatrix& mass) {
  const Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> cholesky(mass);
  const SparseMatrix l = cholesky.matrixL();
  LineFactor factor;
  for (Eigen::Index i = 0; i < l.rows(); ++i) factor.inverse_diagonal.push_back(1 / l.coeff(i, i));
  factor.columns = entries_of(l);
  factor.rows = entries_of(SparseMatrix(l.transpose()));
  return factor;
}

}  // namespace

PlaneSetup plane_setup(const VelocitySpace& space, double regularisation) {
  PlaneSetup setup{space.degree(), {}, regularisation};
  for (const int a : {0, 1}) {
    const SplineAxis& axis = space.axis(a);
    LineOfFunctions& line = setup.axis[static_cast<std::size_t>(a)];
    line.cells = axis.cells();
    line.periodic = axis.periodic();
    line.length = axis.length();
    for (const int less : {0, 1}) {
      const auto l = static_cast<std::size_t>(less);
      line.polynomials[l] = axis.polynomials(less, 0);
      const SparseMatrix mass = axis.mass(less);
      for (int d = 0; d <= axis.degree() - less; ++d)
        for (int i = 0; i < axis.functions(less); ++i)
          line.mass[l].push_back(i + d < axis.functions(less) ? mass.coeff(i + d, i) : 0);
      const Unknowns& unknowns = less == 0 ? axis.normal() : axis.tangential();
      line.unknowns[l] = unknowns.count;
      line.first_unknown[l] = less == 0 && !axis.periodic() ? 1 : 0;
      line.factor[l] = factor_of(over_unknowns(mass, unknowns));
    }
  }
  return setup;
}

}  // namespace mpm::incompressible

#pragma once

#include <cmath>
#include <vector>

#include "solver/incompressible/particle_weights.hpp"
#include "solver/incompressible/space/exact_mass.hpp"
#include "solver/incompressible/space/stencil_diagonals.hpp"
#include "solver/kernel/threads/thread_team.hpp"

namespace mpm::incompressible {

/// The velocity field nearest to the particles': argmin over U of
///   sum_p V_p |U(x_p) - v_p|^2 + r |U - U_last|^2,
/// the last term, with the exact mass, for cells that run thin or empty. Its matrix is the particles'
/// consistent mass, which the exact mass of the uniform fluid resembles: conjugate gradients with that as
/// preconditioner need some ten iterations whatever the mesh.
template <int K>
class ParticleFit {
 public:
  ParticleFit(const VelocitySpace& space, const ExactMass& mass, double regularisation)
      : space_(space), mass_(mass), regularisation_(regularisation) {
    const SplineAxis &x = space.axis(0), &y = space.axis(1);
    matrices_.emplace_back(x.functions(0), y.functions(1), K, K - 1);
    matrices_.emplace_back(x.functions(1), y.functions(0), K - 1, K);
  }

  /// Volumes V_p [m2], places [m] and velocities [m/s] of the particles; `last` are unknowns, and where the
  /// iteration starts. Sums run cell by cell, in each by the particles' numbers: the same bits for any number
  /// of threads.
  VectorXd fitted(const std::vector<double>& volume, const VectorField& place, const VectorField& velocity,
                  const VectorXd& last, ThreadTeam& team) {
    sort_by_cell(place);
    assemble(volume, place, velocity, team);
    VectorXd result(space_.size());
    team.run(2, [&](int component) { solve(component, last, result); });
    return result;
  }

  /// Fewest and most particles of a cell at the last fit.
  [[nodiscard]] std::pair<int, int> occupancy() const {
    int fewest = std::numeric_limits<int>::max(), most = 0;
    for (std::size_t c = 0; c + 1 < first_.size(); ++c) {
      fewest = std::min(fewest, first_[c + 1] - first_[c]);
      most = std::max(most, first_[c + 1] - first_[c]);
    }
    return {fewest, most};
  }

 private:
  static constexpr int size = K * (K + 1);
  static constexpr int rows_a_strip = 8;  // more than the K + 1 rows of functions that a cell touches
  static constexpr double tolerance = 1e-11;
  static constexpr int most_iterations = 400;
  using Block = Eigen::Matrix<double, size, size>;
  using Load = Eigen::Matrix<double, size, 1>;

  void sort_by_cell(const VectorField& place) {
    const SplineAxis &x = space_.axis(0), &y = space_.axis(1);
    std::vector<int> cell(place.size());
    first_.assign(static_cast<std::size_t>(x.cells()) * static_cast<std::size_t>(y.cells()) + 1, 0);
    for (std::size_t p = 0; p < place.size(); ++p) {
      cell[p] = PlaceInCell(x, place[p].x()).cell + x.cells() * PlaceInCell(y, place[p].y()).cell;
      ++first_[static_cast<std::size_t>(cell[p]) + 1];
    }
    for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
    order_.resize(place.size());
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for (std::size_t p = 0; p < place.size(); ++p)
      order_[static_cast<std::size_t>(next[static_cast<std::size_t>(cell[p])]++)] = p;
  }

  /// Strips of cells that are not neighbours share no function: first all even ones, then all odd ones.
  void assemble(const std::vector<double>& volume, const VectorField& place, const VectorField& velocity,
                ThreadTeam& team) {
    const SplineAxis &x = space_.axis(0), &y = space_.axis(1);
    loads_.u.setZero(x.functions(0), y.functions(1));
    loads_.v.setZero(x.functions(1), y.functions(0));
    for (StencilDiagonals& matrix : matrices_) matrix.clear();
    const int strips = (y.cells() + rows_a_strip - 1) / rows_a_strip;
    for (const int parity : {0, 1})
      team.run((strips + 1 - parity) / 2, [&](int share) {
        const int begin = (2 * share + parity) * rows_a_strip,
                  end = std::min(begin + rows_a_strip, y.cells());
        for (int cy = begin; cy < end; ++cy)
          for (int cx = 0; cx < x.cells(); ++cx) add_cell(cx, cy, volume, place, velocity);
      });
  }

  void add_cell(int cx, int cy, const std::vector<double>& volume, const VectorField& place,
                const VectorField& velocity) {
    const auto cell = static_cast<std::size_t>(cx + space_.axis(0).cells() * cy);
    if (first_[cell] == first_[cell + 1]) return;
    Block of_u = Block::Zero(), of_v = Block::Zero();
    Load load_u = Load::Zero(), load_v = Load::Zero();
    for (int k = first_[cell]; k < first_[cell + 1]; ++k) {
      const std::size_t p = order_[static_cast<std::size_t>(k)];
      const ParticleWeights<K> w(space_, place[p]);
      const Eigen::Matrix<double, K + 1, K> u = w.x_full * w.y_less.transpose();
      const Eigen::Matrix<double, K, K + 1> v = w.x_less * w.y_full.transpose();
      const Eigen::Map<const Load> nu(u.data()), nv(v.data());
      const Load weighted_u = volume[p] * nu, weighted_v = volume[p] * nv;
      of_u.noalias() += weighted_u * nu.transpose();
      of_v.noalias() += weighted_v * nv.transpose();
      load_u += velocity[p].x() * weighted_u;
      load_v += velocity[p].y() * weighted_v;
    }
    matrices_[0].add(cx, cy, K + 1, K, of_u);
    matrices_[1].add(cx, cy, K, K + 1, of_v);
    loads_.u.template block<K + 1, K>(cx, cy) += load_u.template reshaped<Eigen::ColMajor>(K + 1, K);
    loads_.v.template block<K, K + 1>(cx, cy) += load_v.template reshaped<Eigen::ColMajor>(K, K + 1);
  }

  /// Conjugate gradients for one component, from the last field on, until the error has fallen to `tolerance`
  /// in the norm of the preconditioner.
  void solve(int component, const VectorXd& last, VectorXd& result) const {
    const Eigen::Index first = component == 0 ? 0 : space_.size(0);
    const Eigen::Index rows = space_.unknowns(component, 0).count,
                       columns = space_.unknowns(component, 1).count;
    const Eigen::Map<const MatrixXd> held(last.data() + first, rows, columns);
    MatrixXd full, product, x = held, r(rows, columns), Ap(rows, columns);
    const auto multiply = [&](const MatrixXd& p, MatrixXd& sum) {
      space_.extend(component, p.data(), full);
      matrices_[static_cast<std::size_t>(component)].multiply(full, product);
      space_.fold(component, product, sum.data());
      sum += regularisation_ * mass_.times(component, p);
    };
    space_.fold(component, component == 0 ? loads_.u : loads_.v, r.data());
    r += regularisation_ * mass_.times(component, held);
    MatrixXd z = mass_.solved(component, r);
    const double enough = tolerance * tolerance * r.cwiseProduct(z).sum();
    multiply(x, Ap);
    r -= Ap;
    z = mass_.solved(component, r);
    MatrixXd p = z;
    double rz = r.cwiseProduct(z).sum();
    for (int k = 0; k < most_iterations && rz > enough; ++k) {
      multiply(p, Ap);
      const double alpha = rz / p.cwiseProduct(Ap).sum();
      x += alpha * p;
      r -= alpha * Ap;
      z = mass_.solved(component, r);
      const double next = r.cwiseProduct(z).sum();
      p = z + (next / rz) * p;
      rz = next;
    }
    Eigen::Map<MatrixXd>(result.data() + first, rows, columns) = x;
  }

  const VelocitySpace& space_;
  const ExactMass& mass_;
  double regularisation_;
  std::vector<StencilDiagonals> matrices_;
  VelocityField loads_;
  std::vector<int> first_;          // of every cell, in order_
  std::vector<std::size_t> order_;  // particles, cell by cell
};

}  // namespace mpm::incompressible

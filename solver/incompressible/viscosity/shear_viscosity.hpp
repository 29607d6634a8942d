#pragma once

#include <Eigen/SparseCholesky>

#include "solver/incompressible/space/stream_function.hpp"
#include "solver/incompressible/viscosity/flow_law.hpp"
#include "solver/incompressible/viscosity/tangent_matrix.hpp"
#include "solver/incompressible/viscosity/viscosity.hpp"
#include "solver/incompressible/viscosity/wall_sites.hpp"

namespace mpm::incompressible {

/// A viscosity nu(q) of the full shear-rate tensor, q = 2 D:D = 4 psi_xy^2 + (psi_yy - psi_xx)^2 of the
/// stream function:
///   N(w).dw = integral of nu (4 psi_xy dpsi_xy + (psi_yy - psi_xx)(dpsi_yy - dpsi_xx)) dA + walls.
/// Walls hold the velocity along them by Nitsche's method, as ViscousForm, with the stress's own tangent in
/// the adjoint term. Integrals by (k + 1)^2 Gauss points a cell.
/// Solved by Newton's method: the functional whose minimum is sought is convex, but for the walls' terms,
/// wherever shear stress grows with shear rate. A factorised matrix is kept, over steps too, while it still
/// contracts the error (chord method).
class ShearViscosity : public Viscosity {
 public:
  ShearViscosity(const Scene& scene, const VelocitySpace& space, const SparseMatrix& mass, FlowLaw law,
                 const WallShares& shares = {});

  [[nodiscard]] VectorXd force(const VectorXd& w, double t) const override;
  [[nodiscard]] Solution solved(double a, double t, const VectorXd& load, const VectorXd& guess) override;

  /// The symmetric matrix that Newton's method takes for dN/dw: all but what vanishes where walls are met.
  [[nodiscard]] SparseMatrix tangent(const VectorXd& w);

 protected:
  /// The field at all sites, those of walls last.
  struct State {
    MatrixXd psi;
    VectorXd xy, shear, nu, slope;  // psi_xy, psi_yy - psi_xx [1/s]; the law there
  };
  /// Where the slope of the law is asked for.
  enum class Slopes { OnWalls, Everywhere };

  // Round-off in the residual, amplified by the condition of M + a N, leaves a few 1e-13.
  static constexpr double tolerance = 1e-11;
  static constexpr int most_iterations = 200;

  struct Tangent {
    double rate;   // d u_t/dn [1/s]
    double nu;     // stress over rate
    double slope;  // d stress/d rate
    double held;   // the larger one
  };

  [[nodiscard]] State state_of(const VectorXd& w, Slopes slopes) const;
  [[nodiscard]] State rates_of(const VectorXd& w) const;  ///< without the law
  void find_law(State& state, Slopes slopes) const;
  [[nodiscard]] Tangent tangent_at(const State& state, std::size_t wall) const;
  /// Adds what the walls resist with to the sums over functions: stress(i) [m2/s2] is that of the fluid at
  /// wall site i, along the wall and outwards.
  template <class Stress>
  void add_walls(const State& law, const MatrixXd& psi, double t, const Stress& stress, MatrixXd& sums) const;

  /// M + a dN/dw at a state.
  void factorise(double a, const State& state);

  const SparseMatrix& mass_;
  std::unique_ptr<SiteKernel> sites_;
  Eigen::Index inner_;  // numbers of a field at the sites in the cells
  VectorXd weight_;     // of these [m2]
  std::vector<WallSite> walls_;
  StreamFunction psi_;
  Eigen::SimplicialLDLT<SparseMatrix> factor_;

 private:
  void find_tangent(const State& state);
  void add_wall_tangents(const State& state);

  int k_;
  FlowLaw law_;
  TangentMatrix matrix_;
  double factorised_for_ = -1;
};

template <class Stress>
void ShearViscosity::add_walls(const State& law, const MatrixXd& psi, double t, const Stress& stress,
                               MatrixXd& sums) const {
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const WallSite& s = walls_[i];
    const Tangent tangent = tangent_at(law, i);
    const double missed = s.of(psi, s.along) - s.moves * s.side->velocity(t)[1 - s.across];
    if (s.side->slip_length > 0) {
      s.in(sums) += s.weight * tangent.nu * s.holds * missed * s.along;
      continue;
    }
    s.in(sums) += s.weight * ((tangent.held * s.holds * missed - stress(i)) * s.along -
                              tangent.slope * missed * s.sign * s.shear);
  }
}

}  // namespace mpm::incompressible

#pragma once

#include <Eigen/SparseCholesky>
#include <cmath>
#include <limits>

#include "solver/incompressible/space/stream_function.hpp"
#include "solver/incompressible/viscosity/flow_law.hpp"
#include "solver/incompressible/viscosity/tangent_matrix.hpp"
#include "solver/incompressible/viscosity/viscosity.hpp"
#include "solver/scene/seeding.hpp"

namespace mpm::incompressible {

/// A viscosity nu(q) of the full shear-rate tensor, q = 2 D:D = 4 psi_xy^2 + (psi_yy - psi_xx)^2 of the
/// stream function:
///   N(w).dw = integral of nu (4 psi_xy dpsi_xy + (psi_yy - psi_xx)(dpsi_yy - dpsi_xx)) dA + walls.
/// Walls hold the velocity along them by Nitsche's method, as ViscousForm, with the stress's own tangent in
/// the adjoint term. Integrals by (k + 1)^2 Gauss points a cell.
/// Solved by Newton's method: the functional whose minimum is sought is convex, but for the walls' terms,
/// wherever shear stress grows with shear rate. A factorised matrix is kept, over steps too, while it still
/// contracts the error (chord method).
template <int K>
class ShearViscosity : public Viscosity {
 public:
  ShearViscosity(const Scene& scene, const VelocitySpace& space, const SparseMatrix& mass, FlowLaw law,
                 const WallShares& shares = {})
      : law_(std::move(law)),
        psi_(space),
        mass_(mass),
        sites_(make_site_kernel(site_setup(space))),
        inner_(sites_->size()),
        weight_(Eigen::Map<const VectorXd>(sites_->weights(), inner_)),
        matrix_(psi_, space.axis(0).cells(), space.axis(1).cells(), K, mass) {
    const std::array<std::vector<Line>, 2> lines = {gauss_lines(space.axis(0)), gauss_lines(space.axis(1))};
    for (const int across : {0, 1}) {
      const SplineAxis& axis = space.axis(across);
      if (axis.periodic()) continue;
      for (const int end : {0, 1}) {
        const auto edge = static_cast<std::size_t>(2 * across + end);
        const Side& side = scene.sides[edge];
        if (std::isinf(side.slip_length)) continue;
        const Line wall = line(axis, end == 0 ? 0 : axis.cells() - 1, end, 1);
        const double holds = side.slip_length > 0 ? 1 / side.slip_length : penalty * K / axis.cell_size();
        for (const Line& along : lines[static_cast<std::size_t>(1 - across)])
          walls_.push_back({across == 0 ? wall : along, across == 0 ? along : wall, along.weight, &side,
                            across, end == 0 ? -1.0 : 1.0, holds,
                            shares[edge] ? shares[edge](along.place) : 1.0});
      }
    }
    factor_.analyzePattern(matrix_.with_mass(0));
  }

  [[nodiscard]] [[gnu::flatten]] VectorXd force(const VectorXd& w, double t) const override {
    const State state = state_of(w, Slopes::OnWalls);
    MatrixXd sum = MatrixXd::Zero(state.psi.rows(), state.psi.cols());
    const VectorXd of_shear =
        weight_.cwiseProduct(state.nu.head(inner_)).cwiseProduct(state.shear.head(inner_));
    const VectorXd of_xy =
        4 * weight_.cwiseProduct(state.nu.head(inner_)).cwiseProduct(state.xy.head(inner_));
    sites_->add_forces(of_xy.data(), of_shear.data(), sum.data());
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      const Wall& s = walls_[i];
      const Tangent tangent = tangent_at(state, i);
      const Block along = along_of(s);
      const double missed =
          at(state.psi, s).cwiseProduct(along).sum() - s.moves * s.side->velocity(t)[1 - s.across];
      if (s.side->slip_length > 0) {
        at(sum, s) += s.weight * tangent.nu * s.holds * missed * along;
        continue;
      }
      at(sum, s) += s.weight * ((tangent.held * s.holds * missed - tangent.nu * tangent.rate) * along -
                                tangent.slope * missed * s.sign * shear_of(s));
    }
    return psi_.folded(sum, w.size());
  }

  [[nodiscard]] Solution solved(double a, double t, const VectorXd& load, const VectorXd& guess) override {
    VectorXd w = guess;
    const auto residual = [&](const VectorXd& x) -> VectorXd { return load - mass_ * x - a * force(x, t); };
    const auto norm = [&](const VectorXd& x) { return std::sqrt(std::max(0.0, x.dot(mass_ * x))); };
    bool fresh = a != factorised_for_;
    bool of_this_solve = fresh;
    if (fresh) factorise(a, w);
    VectorXd r = residual(w);
    double last_change = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      VectorXd step = factor_.solve(r);
      double change = norm(step);
      // A matrix of this solve that contracts at all is cheaper kept than taken anew.
      if (!fresh && !(change <= (of_this_solve ? slow_contraction : contraction) * last_change)) {
        factorise(a, w);
        of_this_solve = true;
        step = factor_.solve(r);
        change = norm(step);
      }
      if (!std::isfinite(change)) break;
      if (change <= tolerance * norm(w)) return {w + step, true};
      // Back to where the slope along the step has not turned too far upwards.
      const double slope = r.dot(step);
      double fraction = 1;
      VectorXd next = w + step, r_next = residual(next);
      while (!(r_next.dot(step) >= -0.5 * slope) && fraction > 1e-6) {
        fraction *= 0.5;
        next = w + fraction * step;
        r_next = residual(next);
      }
      w = next;
      r = r_next;
      // A cut step says nothing on how well the matrix contracts: take the present one's next time.
      fresh = fraction < 1;
      if (fresh) factorise(a, w);
      of_this_solve = of_this_solve || fresh;
      last_change = change;
    }
    return {w, false};
  }

  /// The symmetric matrix that Newton's method takes for dN/dw: all but what vanishes where walls are met.
  [[nodiscard]] SparseMatrix tangent(const VectorXd& w) {
    find_tangent(state_of(w, Slopes::Everywhere));
    return matrix_.tangent();
  }

 protected:
  /// The field at all sites, those of walls last.
  struct State {
    MatrixXd psi;
    VectorXd xy, shear, nu, slope;  // psi_xy, psi_yy - psi_xx [1/s]; the law there
  };
  /// Where the slope of the law is asked for.
  enum class Slopes { OnWalls, Everywhere };

  [[gnu::flatten]] void find_tangent(const State& state) {
    matrix_.clear();
    const auto xy = state.xy.head(inner_).array(), shear = state.shear.head(inner_).array();
    const Eigen::ArrayXd along = weight_.array() * state.nu.head(inner_).array();
    const Eigen::ArrayXd steeper = 2 * weight_.array() * state.slope.head(inner_).array();
    const Eigen::ArrayXd xx = 4 * along + 16 * steeper * xy.square(), xs = 4 * steeper * xy * shear,
                         ss = along + steeper * shear.square();
    sites_->tangents(
        xx.data(), xs.data(), ss.data(),
        [](void* matrix, int cell_x, int cell_y, const double* entries, int pitch) {
          static_cast<TangentMatrix*>(matrix)->add(cell_x, cell_y, entries, pitch);
        },
        &matrix_);
    CellBlock block = CellBlock::Zero();
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      const Wall& s = walls_[i];
      const Tangent tangent = tangent_at(state, i);
      const Block along_wall = along_of(s), of_shear = shear_of(s);
      if (s.side->slip_length > 0) {
        add(block, s.weight * tangent.nu * s.holds, along_wall, along_wall);
      } else {
        add(block, s.weight * tangent.held * s.holds, along_wall, along_wall);
        add(block, -s.weight * tangent.slope * s.sign, along_wall, of_shear);
        add(block, -s.weight * tangent.slope * s.sign, of_shear, along_wall);
      }
      const bool ends_cell =
          i + 1 == walls_.size() || walls_[i + 1].x.cell != s.x.cell || walls_[i + 1].y.cell != s.y.cell;
      if (!ends_cell) continue;
      std::array<double, size*(size + 1) / 2> entries;
      std::size_t e = 0;
      for (int n = 0; n < size; ++n)
        for (int m = 0; m <= n; ++m) entries[e++] = block(m, n);
      matrix_.add(s.x.cell, s.y.cell, entries.data(), 1);
      block.setZero();
    }
  }

  static constexpr int size = (K + 1) * (K + 1);
  static constexpr double penalty = 6;  // times k/h, as ViscousForm
  // Round-off in the residual, amplified by the condition of M + a N, leaves a few 1e-13.
  static constexpr double tolerance = 1e-11;
  static constexpr double contraction = 0.25, slow_contraction = 0.6;
  static constexpr int most_iterations = 200;
  using Weights = Eigen::Matrix<double, K + 1, 1>;
  using Block = Eigen::Matrix<double, K + 1, K + 1>;
  using CellBlock = Eigen::Matrix<double, size, size>;
  using Flat = Eigen::Map<const Eigen::Matrix<double, size, 1>>;

  /// The functions of an axis at a place: values, first and second derivatives.
  struct Line {
    int cell;
    Weights value, slope, curvature;
    double weight, place;  // [m]
  };
  /// On a wall.
  struct Wall {
    Line x, y;
    double weight;  // [m]
    const Side* side;
    int across;    // axis
    double sign;   // of the outward normal
    double holds;  // [1/m]
    double moves;  // share of the side's velocity
  };
  struct Tangent {
    double rate;   // d u_t/dn [1/s]
    double nu;     // stress over rate
    double slope;  // d stress/d rate
    double held;   // the larger one
  };

  static Line line(const SplineAxis& axis, int cell, double xi, double weight) {
    return {cell,   axis.values(0, cell, xi),      axis.slopes(0, cell, xi), axis.curvatures(cell, xi),
            weight, (cell + xi) * axis.cell_size()};
  }
  static std::vector<Line> gauss_lines(const SplineAxis& axis) {
    const CellPoints gauss = cell_points(Seeding::Rule::Gauss, K + 1);
    std::vector<Line> lines;
    for (int cell = 0; cell < axis.cells(); ++cell)
      for (std::size_t g = 0; g < gauss.position.size(); ++g)
        lines.push_back(line(axis, cell, gauss.position[g], gauss.weight[g] * axis.cell_size()));
    return lines;
  }
  static SiteSetup site_setup(const VelocitySpace& space) {
    SiteSetup setup{K, {space.axis(0).cells(), space.axis(1).cells()}, {}, {}};
    for (const std::size_t a : {0, 1})
      for (const Line& line : gauss_lines(space.axis(static_cast<int>(a)))) {
        setup.weights[a].push_back(line.weight);
        for (Eigen::Index m = 0; m <= K; ++m) {
          setup.functions[a][0].push_back(line.value[m]);
          setup.functions[a][1].push_back(line.slope[m]);
          setup.functions[a][2].push_back(line.curvature[m]);
        }
      }
    return setup;
  }

  template <class Matrix>
  static auto at(Matrix& psi, const Wall& s) {
    return psi.template block<K + 1, K + 1>(s.x.cell, s.y.cell);
  }
  static Block shear_of(const Wall& s) {
    return s.x.value * s.y.curvature.transpose() - s.x.curvature * s.y.value.transpose();
  }
  /// Velocity along a wall: u = psi_y, v = -psi_x.
  static Block along_of(const Wall& s) {
    if (s.across == 1) return s.x.value * s.y.slope.transpose();
    return -s.x.slope * s.y.value.transpose();
  }
  static void add(CellBlock& block, double factor, const Block& a, const Block& b) {
    block.noalias() += factor * Flat(a.data()) * Flat(b.data()).transpose();
  }

  [[nodiscard]] State state_of(const VectorXd& w, Slopes slopes) const {
    State state = rates_of(w);
    find_law(state, slopes);
    return state;
  }

  /// Without the law.
  [[nodiscard]] State rates_of(const VectorXd& w) const {
    State state;
    state.psi = psi_.extended(w);
    const Eigen::Index count = inner_ + static_cast<Eigen::Index>(walls_.size());
    state.xy.resize(count);
    state.shear.resize(count);
    sites_->rates(state.psi.data(), state.xy.data(), state.shear.data());
    Eigen::Index n = inner_;
    for (const Wall& s : walls_) {
      const Block psi = at(state.psi, s);
      state.xy[n] = s.x.slope.dot(psi * s.y.slope);
      state.shear[n++] = s.x.value.dot(psi * s.y.curvature) - s.x.curvature.dot(psi * s.y.value);
    }
    return state;
  }

  void find_law(State& state, Slopes slopes) const {
    const VectorXd q = FlowLaw::bounded_below(4 * state.xy.array().square() + state.shear.array().square());
    state.nu = law_.viscosity(q);
    state.slope.setZero(q.size());
    const Eigen::Index asked = slopes == Slopes::Everywhere ? q.size() : q.size() - inner_;
    state.slope.tail(asked) = law_.slope(q.tail(asked), state.nu.tail(asked));
  }

  [[nodiscard]] Tangent tangent_at(const State& state, std::size_t wall) const {
    const Eigen::Index n = inner_ + static_cast<Eigen::Index>(wall);
    const double rate = walls_[wall].sign * state.shear[n], nu = state.nu[n];
    const double slope = nu + 2 * rate * rate * state.slope[n];
    return {rate, nu, slope, std::max(nu, slope)};
  }

  /// M + a dN/dw at a state.
  void factorise(double a, const State& state) {
    find_tangent(state);
    factor_.factorize(matrix_.with_mass(a));
  }
  void factorise(double a, const VectorXd& w) {
    factorise(a, state_of(w, Slopes::Everywhere));
    factorised_for_ = a;
  }

  FlowLaw law_;
  StreamFunction psi_;
  const SparseMatrix& mass_;
  std::unique_ptr<SiteKernel> sites_;
  Eigen::Index inner_;  // numbers of a field at the sites in the cells
  VectorXd weight_;     // of these [m2]
  std::vector<Wall> walls_;
  TangentMatrix matrix_;
  Eigen::SimplicialLDLT<SparseMatrix> factor_;
  double factorised_for_ = -1;
};

}  // namespace mpm::incompressible

#pragma once

#include <Eigen/SparseCholesky>
#include <cmath>
#include <limits>

#include "solver/incompressible/space/stream_function.hpp"
#include "solver/incompressible/viscosity/flow_law.hpp"
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
      : law_(std::move(law)), psi_(space), mass_(mass) {
    const std::array<std::vector<Line>, 2> lines = {gauss_lines(space.axis(0)), gauss_lines(space.axis(1))};
    for (const Line& y : lines[1])
      for (const Line& x : lines[0]) inner_.push_back({x, y, x.weight * y.weight});
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
  }

  [[nodiscard]] VectorXd force(const VectorXd& w, double t) const override {
    const State state = state_of(w);
    MatrixXd sum = MatrixXd::Zero(state.psi.rows(), state.psi.cols());
    for (std::size_t i = 0; i < inner_.size(); ++i) {
      const Site& s = inner_[i];
      const auto n = static_cast<Eigen::Index>(i);
      const double f = s.weight * state.nu[n];
      at(sum, s) += 4 * f * state.xy[n] * xy_of(s) + f * state.shear[n] * shear_of(s);
    }
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
  [[nodiscard]] SparseMatrix tangent(const VectorXd& w) const { return tangent(state_of(w), w.size()); }

 protected:
  /// The field at all sites, inner ones first.
  struct State {
    MatrixXd psi;
    VectorXd xy, shear, nu, slope;  // psi_xy, psi_yy - psi_xx [1/s]; the law there
  };

  [[nodiscard]] SparseMatrix tangent(const State& state, Eigen::Index size_of_w) const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(inner_.size() / ((K + 1) * (K + 1)) * size * size);
    CellBlock block;
    const auto per_line = static_cast<std::size_t>(K + 1);
    const std::size_t in_row = static_cast<std::size_t>(state.psi.rows() - K) * per_line;
    for (std::size_t cy = 0; cy * per_line * in_row < inner_.size(); ++cy)
      for (std::size_t cx = 0; cx * per_line < in_row; ++cx) {
        block.setZero();
        for (std::size_t b = 0; b < per_line; ++b)
          for (std::size_t a = 0; a < per_line; ++a) {
            const std::size_t i = (cy * per_line + b) * in_row + cx * per_line + a;
            const auto n = static_cast<Eigen::Index>(i);
            const Block xy = xy_of(inner_[i]), shear = shear_of(inner_[i]);
            const Block along_q = 4 * state.xy[n] * xy + state.shear[n] * shear;
            const double f = inner_[i].weight * state.nu[n];
            add(block, 4 * f, xy, xy);
            add(block, f, shear, shear);
            add(block, 2 * inner_[i].weight * state.slope[n], along_q, along_q);
          }
        scatter(entries, inner_[cy * per_line * in_row + cx * per_line], block);
      }
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      const Wall& s = walls_[i];
      const Tangent tangent = tangent_at(state, i);
      const Block along = along_of(s), shear = shear_of(s);
      block.setZero();
      if (s.side->slip_length > 0) {
        add(block, s.weight * tangent.nu * s.holds, along, along);
      } else {
        add(block, s.weight * tangent.held * s.holds, along, along);
        add(block, -s.weight * tangent.slope * s.sign, along, shear);
        add(block, -s.weight * tangent.slope * s.sign, shear, along);
      }
      scatter(entries, s, block);
    }
    SparseMatrix matrix(size_of_w, size_of_w);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
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
  struct Site {
    Line x, y;
    double weight;  // [m2], on walls [m]
  };
  struct Wall : Site {
    const Side* side;
    int across;    // axis
    double sign;   // of the outward normal
    double holds;  // [1/m]
    double moves;  // share of the side's velocity
    Wall(const Line& lx, const Line& ly, double weight, const Side* of, int axis, double normal, double held,
         double share)
        : Site{lx, ly, weight}, side(of), across(axis), sign(normal), holds(held), moves(share) {}
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

  template <class Matrix>
  static auto at(Matrix& psi, const Site& s) {
    return psi.template block<K + 1, K + 1>(s.x.cell, s.y.cell);
  }
  static Block xy_of(const Site& s) { return s.x.slope * s.y.slope.transpose(); }
  static Block shear_of(const Site& s) {
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

  [[nodiscard]] State state_of(const VectorXd& w) const {
    State state = rates_of(w);
    const VectorXd q = 4 * state.xy.array().square() + state.shear.array().square();
    law_(q, state.nu, state.slope);
    return state;
  }

  /// Without the law.
  [[nodiscard]] State rates_of(const VectorXd& w) const {
    State state;
    state.psi = psi_.extended(w);
    const auto count = static_cast<Eigen::Index>(inner_.size() + walls_.size());
    state.xy.resize(count);
    state.shear.resize(count);
    Eigen::Index n = 0;
    const auto look = [&](const Site& s) {
      const Block psi = at(state.psi, s);
      state.xy[n] = s.x.slope.dot(psi * s.y.slope);
      state.shear[n++] = s.x.value.dot(psi * s.y.curvature) - s.x.curvature.dot(psi * s.y.value);
    };
    for (const Site& s : inner_) look(s);
    for (const Wall& s : walls_) look(s);
    return state;
  }

  [[nodiscard]] Tangent tangent_at(const State& state, std::size_t wall) const {
    const auto n = static_cast<Eigen::Index>(inner_.size() + wall);
    const double rate = walls_[wall].sign * state.shear[n], nu = state.nu[n];
    const double slope = nu + 2 * rate * rate * state.slope[n];
    return {rate, nu, slope, std::max(nu, slope)};
  }

  void scatter(std::vector<Eigen::Triplet<double>>& entries, const Site& s, const CellBlock& block) const {
    std::array<StreamFunction::Share, size> share;
    for (int j = 0; j <= K; ++j)
      for (int i = 0; i <= K; ++i)
        share[static_cast<std::size_t>(i + (K + 1) * j)] = psi_.share(s.x.cell + i, s.y.cell + j);
    for (int c = 0; c < size; ++c)
      for (int r = 0; r < size; ++r) {
        const auto &row = share[static_cast<std::size_t>(r)], &column = share[static_cast<std::size_t>(c)];
        if (row.coordinate >= 0 && column.coordinate >= 0)
          entries.emplace_back(row.coordinate, column.coordinate, row.sign * column.sign * block(r, c));
      }
  }

  void factorise(double a, const VectorXd& w) {
    factor_.compute(mass_ + a * tangent(w));
    factorised_for_ = a;
  }

  FlowLaw law_;
  StreamFunction psi_;
  const SparseMatrix& mass_;
  std::vector<Site> inner_;
  std::vector<Wall> walls_;
  Eigen::SimplicialLDLT<SparseMatrix> factor_;
  double factorised_for_ = -1;
};

}  // namespace mpm::incompressible

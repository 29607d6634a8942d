#pragma once

#include "solver/incompressible/viscosity/shear_viscosity.hpp"
#include "solver/material/rheology/dual_rate.hpp"

namespace mpm::incompressible {

/// The viscosity of a regularised yield stress. Newton's method as YieldNewton (solver/viscosity) has it: the
/// place of each Gauss point on the flow curve is an unknown of its own, which moves along the curve by
/// stress + c times rate; eliminated point by point, what is left has the tangent at those places.
template <int K>
class YieldViscosity final : public ShearViscosity<K> {
  using Base = ShearViscosity<K>;
  using typename Base::Block;
  using typename Base::Slopes;
  using typename Base::State;
  using typename Base::Wall;
  using typename Viscosity::Solution;

 public:
  YieldViscosity(const Scene& scene, const VelocitySpace& space, const SparseMatrix& mass,
                 const HerschelBulkley& fluid, const WallShares& shares = {})
      : Base(scene, space, mass, FlowLaw(fluid, scene.fluid.density), shares), fluid_(fluid) {
    fluid_.consistency /= scene.fluid.density;
    fluid_.yield_stress /= scene.fluid.density;
  }

  [[nodiscard]] Solution solved(double a, double t, const VectorXd& load, const VectorXd& guess) override {
    const SparseMatrix& mass = this->mass_;
    const auto norm = [&](const VectorXd& x) { return std::sqrt(std::max(0.0, x.dot(mass * x))); };
    VectorXd w = guess;
    State place = this->state_of(w, Slopes::Everywhere), flow = place;
    double last_change = std::numeric_limits<double>::infinity(), share = 1;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      this->factorise(a, place);
      if (this->factor_.info() != Eigen::Success) break;
      const VectorXd step =
          this->factor_.solve(load - mass * w - a * linearised_force(flow, place, w.size(), t));
      const double change = norm(step);
      if (!std::isfinite(change)) break;
      w += step;
      flow = this->rates_of(w);
      const double speed = norm(w), missing = missed(flow, place);
      if (change <= Base::tolerance * speed && missing <= rate_tolerance) return {w, true};
      if (change <= round_off * speed && change >= last_change && missing <= round_off) return {w, true};
      share = next_share(share, change, last_change, iteration);
      last_change = change;
      move(place, flow, share);
    }
    return {w, false};
  }

 private:
  static constexpr int most_iterations = 200;
  static constexpr double rate_tolerance = 1e-11;  // of the largest rate
  static constexpr double round_off = 1e-8;        // as YieldNewton

  [[nodiscard]] static Eigen::Vector2d rate(const State& s, Eigen::Index i) {
    return {2 * s.xy[i], s.shear[i]};
  }

  /// Largest distance between a rate and that of its place, over the largest rate.
  [[nodiscard]] static double missed(const State& flow, const State& place) {
    double most = 0, largest = 1e-200;
    for (Eigen::Index i = 0; i < flow.xy.size(); ++i) {
      most = std::max(most, (rate(flow, i) - rate(place, i)).norm());
      largest = std::max(largest, rate(flow, i).norm());
    }
    return most / largest;
  }

  void move(State& place, const State& flow, double share) const {
    double square = 0;
    for (Eigen::Index i = 0; i < flow.xy.size(); ++i) square += rate(flow, i).squaredNorm();
    const auto count = (this->weight_.array() > 0).count() + static_cast<Eigen::Index>(this->walls_.size());
    const DualRate curve(fluid_, std::sqrt(square / static_cast<double>(count)));
    for (Eigen::Index i = 0; i < flow.xy.size(); ++i) {
      const Eigen::Vector2d next =
          curve.moved<Eigen::Vector2d>(rate(place, i), place.nu[i], place.slope[i], rate(flow, i), share);
      place.xy[i] = 0.5 * next[0];
      place.shear[i] = next[1];
    }
    this->find_law(place, Slopes::Everywhere);
  }

  /// As force(), of the stresses that the curves linearised at `place` give the flow; what walls take of the
  /// law is the place's.
  [[nodiscard]] [[gnu::flatten]] VectorXd linearised_force(const State& flow, const State& place,
                                                           Eigen::Index size_of_w, double t) const {
    MatrixXd sum = MatrixXd::Zero(flow.psi.rows(), flow.psi.cols());
    const auto stress = [&](Eigen::Index n) -> Eigen::Vector2d {
      const Eigen::Vector2d at = rate(place, n), r = rate(flow, n);
      return place.nu[n] * r + (2 * place.slope[n] * at.dot(r - at)) * at;
    };
    VectorXd of_xy(this->inner_), of_shear(this->inner_);
    for (Eigen::Index n = 0; n < this->inner_; ++n) {
      const Eigen::Vector2d of = this->weight_[n] * stress(n);
      of_xy[n] = 2 * of[0];
      of_shear[n] = of[1];
    }
    this->sites_->add_forces(of_xy.data(), of_shear.data(), sum.data());
    Eigen::Index n = this->inner_;
    for (std::size_t i = 0; i < this->walls_.size(); ++i, ++n) {
      const Wall& s = this->walls_[i];
      const auto tangent = this->tangent_at(place, i);
      const Block along = Base::along_of(s);
      const double missed =
          Base::at(flow.psi, s).cwiseProduct(along).sum() - s.moves * s.side->velocity(t)[1 - s.across];
      if (s.side->slip_length > 0) {
        Base::at(sum, s) += s.weight * tangent.nu * s.holds * missed * along;
        continue;
      }
      Base::at(sum, s) += s.weight * ((tangent.held * s.holds * missed - s.sign * stress(n)[1]) * along -
                                      tangent.slope * missed * s.sign * Base::shear_of(s));
    }
    return this->psi_.folded(sum, size_of_w);
  }

  HerschelBulkley fluid_;  // per density
};

}  // namespace mpm::incompressible

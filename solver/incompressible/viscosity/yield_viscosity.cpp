#include "solver/incompressible/viscosity/yield_viscosity.hpp"

#include <cmath>
#include <limits>

#include "solver/material/rheology/dual_rate.hpp"

namespace mpm::incompressible {
namespace {

constexpr double rate_tolerance = 1e-11;  // of the largest rate
constexpr double round_off = 1e-8;        // as YieldNewton

template <class State>
Eigen::Vector2d rate(const State& s, Eigen::Index i) {
  return {2 * s.xy[i], s.shear[i]};
}

/// Largest distance between a rate and that of its place, over the largest rate.
template <class State>
double missed(const State& flow, const State& place) {
  double most = 0, largest = 1e-200;
  for (Eigen::Index i = 0; i < flow.xy.size(); ++i) {
    most = std::max(most, (rate(flow, i) - rate(place, i)).norm());
    largest = std::max(largest, rate(flow, i).norm());
  }
  return most / largest;
}

}  // namespace

YieldViscosity::YieldViscosity(const Scene& scene, const VelocitySpace& space, const SparseMatrix& mass,
                               const HerschelBulkley& fluid, const WallShares& shares)
    : ShearViscosity(scene, space, mass, FlowLaw(fluid, scene.fluid.density), shares), fluid_(fluid) {
  fluid_.consistency /= scene.fluid.density;
  fluid_.yield_stress /= scene.fluid.density;
}

Viscosity::Solution YieldViscosity::solved(double a, double t, const VectorXd& load, const VectorXd& guess) {
  const auto norm = [&](const VectorXd& x) { return std::sqrt(std::max(0.0, x.dot(mass_ * x))); };
  VectorXd w = guess;
  State place = state_of(w, Slopes::Everywhere), flow = place;
  double last_change = std::numeric_limits<double>::infinity(), share = 1;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    factorise(a, place);
    if (factor_.info() != Eigen::Success) break;
    const VectorXd step = factor_.solve(load - mass_ * w - a * linearised_force(flow, place, w.size(), t));
    const double change = norm(step);
    if (!std::isfinite(change)) break;
    w += step;
    flow = rates_of(w);
    const double speed = norm(w), missing = missed(flow, place);
    if (change <= tolerance * speed && missing <= rate_tolerance) return {w, true};
    if (change <= round_off * speed && change >= last_change && missing <= round_off) return {w, true};
    share = next_share(share, change, last_change, iteration);
    last_change = change;
    move(place, flow, share);
  }
  return {w, false};
}

void YieldViscosity::move(State& place, const State& flow, double share) const {
  double square = 0;
  for (Eigen::Index i = 0; i < flow.xy.size(); ++i) square += rate(flow, i).squaredNorm();
  const auto count = (weight_.array() > 0).count() + static_cast<Eigen::Index>(walls_.size());
  const DualRate curve(fluid_, std::sqrt(square / static_cast<double>(count)));
  for (Eigen::Index i = 0; i < flow.xy.size(); ++i) {
    const Eigen::Vector2d next =
        curve.moved<Eigen::Vector2d>(rate(place, i), place.nu[i], place.slope[i], rate(flow, i), share);
    place.xy[i] = 0.5 * next[0];
    place.shear[i] = next[1];
  }
  find_law(place, Slopes::Everywhere);
}

/// As force(), of the stresses that the curves linearised at `place` give the flow; what walls take of the
/// law is the place's.
VectorXd YieldViscosity::linearised_force(const State& flow, const State& place, Eigen::Index size_of_w,
                                          double t) const {
  MatrixXd sum = MatrixXd::Zero(flow.psi.rows(), flow.psi.cols());
  const auto stress = [&](Eigen::Index n) -> Eigen::Vector2d {
    const Eigen::Vector2d at = rate(place, n), r = rate(flow, n);
    return place.nu[n] * r + (2 * place.slope[n] * at.dot(r - at)) * at;
  };
  VectorXd of_xy(inner_), of_shear(inner_);
  for (Eigen::Index n = 0; n < inner_; ++n) {
    const Eigen::Vector2d of = weight_[n] * stress(n);
    of_xy[n] = 2 * of[0];
    of_shear[n] = of[1];
  }
  sites_->add_forces(of_xy.data(), of_shear.data(), sum.data());
  const auto on_wall = [&](std::size_t i) {
    return walls_[i].sign * stress(inner_ + static_cast<Eigen::Index>(i))[1];
  };
  add_walls(place, flow.psi, t, on_wall, sum);
  return psi_.folded(sum, size_of_w);
}

}  // namespace mpm::incompressible

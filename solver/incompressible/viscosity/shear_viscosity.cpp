#include "solver/incompressible/viscosity/shear_viscosity.hpp"

#include <cmath>
#include <limits>

namespace mpm::incompressible {
namespace {

constexpr double contraction = 0.25, slow_contraction = 0.6;

}  // namespace

ShearViscosity::ShearViscosity(const Scene& scene, const VelocitySpace& space, const SparseMatrix& mass,
                               FlowLaw law, const WallShares& shares)
    : mass_(mass),
      sites_(make_site_kernel(site_setup(space))),
      inner_(sites_->size()),
      weight_(Eigen::Map<const VectorXd>(sites_->weights(), inner_)),
      walls_(wall_sites(scene, space, shares)),
      psi_(space),
      k_(space.degree()),
      law_(std::move(law)),
      matrix_(psi_, space.axis(0).cells(), space.axis(1).cells(), k_, mass) {
  factor_.analyzePattern(matrix_.with_mass(0));
}

VectorXd ShearViscosity::force(const VectorXd& w, double t) const {
  const State state = state_of(w, Slopes::OnWalls);
  MatrixXd sum = MatrixXd::Zero(state.psi.rows(), state.psi.cols());
  const VectorXd of_shear =
      weight_.cwiseProduct(state.nu.head(inner_)).cwiseProduct(state.shear.head(inner_));
  const VectorXd of_xy = 4 * weight_.cwiseProduct(state.nu.head(inner_)).cwiseProduct(state.xy.head(inner_));
  sites_->add_forces(of_xy.data(), of_shear.data(), sum.data());
  const auto stress = [&](std::size_t i) {
    const Tangent tangent = tangent_at(state, i);
    return tangent.nu * tangent.rate;
  };
  add_walls(state, state.psi, t, stress, sum);
  return psi_.folded(sum, w.size());
}

Viscosity::Solution ShearViscosity::solved(double a, double t, const VectorXd& load, const VectorXd& guess) {
  VectorXd w = guess;
  const auto residual = [&](const VectorXd& x) -> VectorXd { return load - mass_ * x - a * force(x, t); };
  const auto norm = [&](const VectorXd& x) { return std::sqrt(std::max(0.0, x.dot(mass_ * x))); };
  const auto take_anew = [&] {
    factorise(a, state_of(w, Slopes::Everywhere));
    factorised_for_ = a;
  };
  bool fresh = a != factorised_for_;
  bool of_this_solve = fresh;
  if (fresh) take_anew();
  VectorXd r = residual(w);
  double last_change = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    VectorXd step = factor_.solve(r);
    double change = norm(step);
    // A matrix of this solve that contracts at all is cheaper kept than taken anew.
    if (!fresh && !(change <= (of_this_solve ? slow_contraction : contraction) * last_change)) {
      take_anew();
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
    if (fresh) take_anew();
    of_this_solve = of_this_solve || fresh;
    last_change = change;
  }
  return {w, false};
}

SparseMatrix ShearViscosity::tangent(const VectorXd& w) {
  find_tangent(state_of(w, Slopes::Everywhere));
  return matrix_.tangent();
}

void ShearViscosity::find_tangent(const State& state) {
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
  add_wall_tangents(state);
}

void ShearViscosity::add_wall_tangents(const State& state) {
  const std::size_t size = static_cast<std::size_t>(k_ + 1) * static_cast<std::size_t>(k_ + 1);
  std::vector<double> entries(size * (size + 1) / 2, 0.0);  // of the sites of one cell
  const auto add = [&](double factor, const WallSite::Block& a, const WallSite::Block& b) {
    for (std::size_t n = 0, e = 0; n < size; ++n)
      for (std::size_t m = 0; m <= n; ++m, ++e) entries[e] += factor * a.data()[m] * b.data()[n];
  };
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const WallSite& s = walls_[i];
    const Tangent tangent = tangent_at(state, i);
    if (s.side->slip_length > 0) {
      add(s.weight * tangent.nu * s.holds, s.along, s.along);
    } else {
      add(s.weight * tangent.held * s.holds, s.along, s.along);
      add(-s.weight * tangent.slope * s.sign, s.along, s.shear);
      add(-s.weight * tangent.slope * s.sign, s.shear, s.along);
    }
    const bool ends_cell =
        i + 1 == walls_.size() || walls_[i + 1].cell_x != s.cell_x || walls_[i + 1].cell_y != s.cell_y;
    if (!ends_cell) continue;
    matrix_.add(s.cell_x, s.cell_y, entries.data(), 1);
    std::ranges::fill(entries, 0.0);
  }
}

ShearViscosity::State ShearViscosity::state_of(const VectorXd& w, Slopes slopes) const {
  State state = rates_of(w);
  find_law(state, slopes);
  return state;
}

ShearViscosity::State ShearViscosity::rates_of(const VectorXd& w) const {
  State state;
  state.psi = psi_.extended(w);
  const Eigen::Index count = inner_ + static_cast<Eigen::Index>(walls_.size());
  state.xy.resize(count);
  state.shear.resize(count);
  sites_->rates(state.psi.data(), state.xy.data(), state.shear.data());
  Eigen::Index n = inner_;
  for (const WallSite& s : walls_) {
    state.xy[n] = s.of(state.psi, s.xy);
    state.shear[n++] = s.of(state.psi, s.shear);
  }
  return state;
}

void ShearViscosity::find_law(State& state, Slopes slopes) const {
  const VectorXd q = FlowLaw::bounded_below(4 * state.xy.array().square() + state.shear.array().square());
  state.nu = law_.viscosity(q);
  state.slope.setZero(q.size());
  const Eigen::Index asked = slopes == Slopes::Everywhere ? q.size() : q.size() - inner_;
  state.slope.tail(asked) = law_.slope(q.tail(asked), state.nu.tail(asked));
}

ShearViscosity::Tangent ShearViscosity::tangent_at(const State& state, std::size_t wall) const {
  const Eigen::Index n = inner_ + static_cast<Eigen::Index>(wall);
  const double rate = walls_[wall].sign * state.shear[n], nu = state.nu[n];
  const double slope = nu + 2 * rate * rate * state.slope[n];
  return {rate, nu, slope, std::max(nu, slope)};
}

void ShearViscosity::factorise(double a, const State& state) {
  find_tangent(state);
  factor_.factorize(matrix_.with_mass(a));
}

}  // namespace mpm::incompressible

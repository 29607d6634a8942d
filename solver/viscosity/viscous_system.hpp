#pragma once

#include <algorithm>
#include <cmath>

#include "solver/grid/remembered.hpp"
#include "solver/viscosity/implicit_viscosity.hpp"
#include "solver/viscosity/viscous_tangent.hpp"

namespace mpm {

/// The equations of backward Euler for a viscous stress, M (v - start) = dt (f + f_visc(v)), and their
/// tangent. What the stress is, the caller says: particle by particle.
class ViscousSystem {
 public:
  ViscousSystem(const Grid& grid, const WallNodes& walls) : grid_(grid), cell_(std::min(grid.x.h, grid.y.h)) {
    for (std::size_t i = 0; i < grid.size(); ++i) is_wall_.push_back(walls.is_wall(i) ? 1 : 0);
  }

  /// The system at hand, arguments as ImplicitViscosity::solve. Nodes without mass get zero.
  void begin(const StencilTable& table, const Particles& particles, const SparseMatrix& mass,
             const VectorField& start, const VectorField& force, double dt, VectorField& velocity) {
    table_ = &table;
    particles_ = &particles;
    mass_ = &mass;
    start_ = &start;
    force_ = &force;
    if (!tangent_) tangent_ = make_viscous_tangent(grid_, is_strip());
    if (!(stands(dt) && is_strip())) weigh();
    double push = 0;
    for (std::size_t i = 0; i < velocity.size(); ++i) {
      push = std::max(push, inverse_mass_[i] * force[i].cwiseAbs().maxCoeff());
      if (is_fixed_[i] && !is_wall_[i]) velocity[i] = Vec2::Zero();
    }
    scale_ = std::max({largest(start), largest(velocity), dt * push});
    const double least_shear = shear_floor * shear_scale();
    least_shear_squared_ = std::max(least_shear * least_shear, 1e-200);
  }

  /// Largest velocity that the start or the forces give [m/s].
  [[nodiscard]] double scale() const { return scale_; }
  /// Shear rate of that velocity over a cell [1/s].
  [[nodiscard]] double shear_scale() const { return scale_ / cell_; }
  /// Below which no square of a shear rate counts [1/s2].
  [[nodiscard]] double least_shear_squared() const { return least_shear_squared_; }
  /// Size of a cell [m].
  [[nodiscard]] double cell() const { return cell_; }
  /// Stencils that run along y alone have no slope along x.
  [[nodiscard]] bool is_strip() const { return table_->support_x == 1; }
  /// The system's particles.
  [[nodiscard]] std::size_t particles() const { return particles_->size(); }

  /// mu(q) and d mu/dq at q = gdot^2.
  template <class Law>
  [[nodiscard]] std::pair<double, double> viscosity(const Law& law, double q) const {
    if constexpr (Law::needs_shear_rate) {
      q = std::max(q, least_shear_squared_);
      constexpr double e = 1e-4;  // relative: truncation e^2 and round-off 1e-16/e are both below 1e-8
      const double mu = law.viscosity(q);
      const double slope = (law.viscosity(q * (1 + e)) - law.viscosity(q * (1 - e))) / (2 * e * q);
      // Not below the slope at which shear stress would fall with shear rate.
      return {mu, std::max(slope, -0.4995 * mu / q)};
    } else {
      return {law.viscosity(), 0};
    }
  }

  [[nodiscard]] Mat2 strain_rate(const VectorField& velocity, std::size_t p) const {
    return is_strip() ? strain_rate_at<true>(velocity, p) : strain_rate_at<false>(velocity, p);
  }

  /// Of every particle [1/s].
  void strain_rates(const VectorField& velocity, std::vector<Mat2>& rate) const {
    rate.resize(particles());
    const auto fill = [&]<bool strip>() {
      for (std::size_t p = 0; p < rate.size(); ++p) rate[p] = strain_rate_at<strip>(velocity, p);
    };
    is_strip() ? fill.template operator()<true>() : fill.template operator()<false>();
  }

  /// M (v - start) - dt (f + f_visc), zero at fixed nodes; what stood at the walls is kept. `stress(p)` is a
  /// particle's stress [Pa].
  template <class Stress>
  void residual_at(const VectorField& velocity, const Stress& stress, VectorField& residual) {
    difference_.resize(velocity.size());
    residual.resize(velocity.size());
    for (std::size_t i = 0; i < velocity.size(); ++i) difference_[i] = velocity[i] - (*start_)[i];
    rows_of(residual).noalias() = *mass_ * rows_of(difference_);
    for (std::size_t i = 0; i < velocity.size(); ++i) residual[i] -= dt_ * (*force_)[i];
    is_strip() ? add_impulses<true>(stress, residual) : add_impulses<false>(stress, residual);
    keep_walls(residual);
  }
  /// Where the stress is linear and the tangent is_current(): sets the velocity to zero but at walls, and the
  /// residual there, from which one direction() leads to the solution.
  void linear_residual(VectorField& velocity, VectorField& residual) {
    residual.resize(velocity.size());
    rows_of(residual).noalias() = *mass_ * rows_of(*start_);
    for (std::size_t i = 0; i < velocity.size(); ++i) residual[i] = -residual[i] - dt_ * (*force_)[i];
    for (std::size_t i = 0; i < velocity.size(); ++i) {
      if (!is_wall_[i])
        velocity[i] = Vec2::Zero();
      else if (velocity[i] != Vec2::Zero())
        tangent_->add_columns(i, velocity[i], residual);
    }
    keep_walls(residual);
  }

  /// What a small step changes of the residual at the walls.
  void close_walls(const VectorField& step) {
    for (std::size_t i = 0; i < step.size(); ++i)
      if (is_wall_[i]) wall_residual_[i] += tangent_->row_times(i, step);
  }

  /// The walls' impulse in the last residual [kg/s].
  [[nodiscard]] Vec2 wall_impulse() const {
    Vec2 sum = Vec2::Zero();
    for (std::size_t i = 0; i < wall_residual_.size(); ++i)
      if (is_wall_[i]) sum += wall_residual_[i];
    return sum;
  }

  [[nodiscard]] bool factorised() const { return factorised_; }
  /// Whether the tangent is that of the system at hand, if the law's is the same everywhere: on a strip whose
  /// rows slide.
  [[nodiscard]] bool is_current() const { return is_current_; }

  /// Takes the tangent with an entry of `law` a particle.
  void factorise(const std::vector<Linearised>& law) {
    tangent_->factorise(*mass_, *table_, law, weight_, is_fixed_);
    factorised_ = is_current_ = true;
  }

  /// step = -J^-1 residual
  void direction(const VectorField& residual, VectorField& step) const {
    step.resize(residual.size());
    for (std::size_t i = 0; i < residual.size(); ++i) step[i] = -residual[i];
    tangent_->solve(step);
  }

  static double largest(const VectorField& field) {
    double most = 0;
    for (const Vec2& v : field) {
      const double size = v.cwiseAbs().maxCoeff();
      if (!std::isfinite(size)) return size;
      most = std::max(most, size);
    }
    return most;
  }

 private:
  // Shear rates below this fraction of velocity scale per cell count as this: a power law below one has an
  // infinite viscosity at rest. What it leaves out is a stress 1e-9^n of the flow's.
  static constexpr double shear_floor = 1e-9;

  /// Whether the particles of a strip stand where they did across it, as heavy and dense, and dt is the same.
  [[nodiscard]] bool stands(double dt) {
    const std::size_t count = particles();
    const bool across = across_.same(count, [&](std::size_t p) { return particles_->position[p].y(); });
    const bool masses = masses_.same(count, [&](std::size_t p) { return particles_->mass[p]; });
    const bool densities = densities_.same(count, [&](std::size_t p) { return particles_->density[p]; });
    const bool same_dt = dt == dt_;
    dt_ = dt;
    return across && masses && densities && same_dt;
  }

  /// Takes what the particles and their masses say.
  void weigh() {
    is_current_ = false;
    weight_.resize(particles());
    for (std::size_t p = 0; p < particles(); ++p)
      weight_[p] = dt_ * (particles_->mass[p] / particles_->density[p]);
    const Eigen::VectorXd diagonal = mass_->diagonal();
    const double heaviest = diagonal.maxCoeff();
    is_fixed_ = is_wall_;
    inverse_mass_.assign(is_wall_.size(), 0.0);
    for (std::size_t i = 0; i < is_wall_.size(); ++i) {
      const double m = diagonal[static_cast<Eigen::Index>(i)];
      if (m > negligible_mass * heaviest)
        inverse_mass_[i] = 1 / m;
      else
        is_fixed_[i] = 1;
    }
  }

  void keep_walls(VectorField& residual) {
    wall_residual_ = residual;
    for (std::size_t i = 0; i < residual.size(); ++i)
      if (is_fixed_[i]) residual[i] = Vec2::Zero();
  }

  template <bool strip>
  [[nodiscard]] Mat2 strain_rate_at(const VectorField& velocity, std::size_t p) const {
    const auto width = static_cast<std::size_t>(table_->width);
    Mat2 l = Mat2::Zero();
    for (std::size_t e = p * width; e < (p + 1) * width; ++e) {
      const Vec2& v = velocity[static_cast<std::size_t>(table_->node[e])];
      if constexpr (strip)
        l.col(1) += table_->gradient[e].y() * v;
      else
        l += v * table_->gradient[e].transpose();
    }
    return 0.5 * (l + l.transpose());
  }

  template <bool strip, class Stress>
  void add_impulses(const Stress& stress, VectorField& residual) const {
    const auto width = static_cast<std::size_t>(table_->width);
    for (std::size_t p = 0; p < weight_.size(); ++p) {
      const Mat2 impulse = weight_[p] * stress(p);
      for (std::size_t e = p * width; e < (p + 1) * width; ++e) {
        Vec2& sum = residual[static_cast<std::size_t>(table_->node[e])];
        if constexpr (strip)
          sum += table_->gradient[e].y() * impulse.col(1);
        else
          sum += impulse * table_->gradient[e];
      }
    }
  }

  const Grid& grid_;
  double cell_;
  std::vector<char> is_wall_, is_fixed_;
  std::unique_ptr<ViscousTangent> tangent_;
  bool factorised_ = false, is_current_ = false;
  Remembered across_, masses_, densities_;  // of the particles of the last system
  // The system at hand.
  const StencilTable* table_ = nullptr;
  const Particles* particles_ = nullptr;
  const SparseMatrix* mass_ = nullptr;
  const VectorField *start_ = nullptr, *force_ = nullptr;
  ScalarField weight_;        // dt V_p of the particles, per unit depth [m2 s]
  ScalarField inverse_mass_;  // of the nodes [m/kg]; 0 without mass
  VectorField wall_residual_;
  VectorField difference_;  // work space
  double dt_ = -1, scale_ = 0, least_shear_squared_ = 0;
};

}  // namespace mpm

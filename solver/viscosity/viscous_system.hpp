#pragma once

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "solver/material/stress_update.hpp"
#include "solver/viscosity/implicit_viscosity.hpp"

namespace mpm {

/// The equations of backward Euler for a viscous stress, M (v - start) = dt (f + f_visc(v)), and their
/// linearised matrix. What the stress is, the caller says: particle by particle.
class ViscousSystem {
 public:
  ViscousSystem(const Grid& grid, const WallNodes& walls)
      : cell_(std::min(grid.x.h, grid.y.h)), matrix_(pair_pattern(grid, 2)), slots_(grid, matrix_, 2) {
    for (std::size_t i = 0; i < grid.size(); ++i) is_wall_.push_back(walls.is_wall(i) ? 1 : 0);
    factors_.analyzePattern(matrix_);
  }

  /// The system at hand, arguments as ImplicitViscosity::solve. Nodes without mass get zero.
  void begin(const StencilTable& table, const Particles& particles, const SparseMatrix& mass,
             VectorField& start, VectorField& force, double dt, VectorField& velocity) {
    table_ = &table;
    particles_ = &particles;
    mass_ = &mass;
    start_ = &start;
    force_ = &force;
    dt_ = dt;
    is_fixed_ = is_wall_;
    const Eigen::VectorXd diagonal = mass.diagonal();
    const double heaviest = diagonal.maxCoeff();
    scale_ = std::max(largest(start), largest(velocity));
    double push = 0;
    for (std::size_t i = 0; i < velocity.size(); ++i) {
      const double m = diagonal[static_cast<Eigen::Index>(i)];
      if (m > negligible_mass * heaviest) {
        push = std::max(push, force[i].norm() * dt / m);
        continue;
      }
      is_fixed_[i] = 1;
      if (!is_wall_[i]) velocity[i] = Vec2::Zero();
    }
    scale_ = std::max(scale_, push);
    least_shear_squared_ = std::max(std::pow(shear_floor * scale_ / cell_, 2), 1e-200);
  }

  /// Largest velocity that the start or the forces give [m/s].
  [[nodiscard]] double scale() const { return scale_; }
  /// Shear rate of that velocity over a cell [1/s].
  [[nodiscard]] double shear_scale() const { return scale_ / cell_; }
  /// Size of a cell [m].
  [[nodiscard]] double cell() const { return cell_; }
  /// The system's particles.
  [[nodiscard]] std::size_t particles() const { return particles_->size(); }
  [[nodiscard]] bool factorised() const { return factorised_; }

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
    Mat2 l = Mat2::Zero();
    const auto width = static_cast<std::size_t>(table_->width);
    for (std::size_t e = p * width; e < (p + 1) * width; ++e)
      l += velocity[static_cast<std::size_t>(table_->node[e])] * table_->gradient[e].transpose();
    return 0.5 * (l + l.transpose());
  }

  /// M (v - start) - dt (f + f_visc), zero at fixed nodes; what stood at the walls is kept. `stress(p, d)` is
  /// a particle's stress [Pa] for its strain rate.
  template <class Stress>
  void residual_at(const VectorField& velocity, const Stress& stress, VectorField& residual) {
    difference_.resize(velocity.size());
    for (std::size_t i = 0; i < velocity.size(); ++i) difference_[i] = velocity[i] - (*start_)[i];
    rows_of(residual).noalias() = *mass_ * rows_of(difference_);
    for (std::size_t i = 0; i < velocity.size(); ++i) residual[i] -= dt_ * (*force_)[i];
    const auto width = static_cast<std::size_t>(table_->width);
    for (std::size_t p = 0; p < particles_->size(); ++p) {
      const Mat2 impulse = dt_ * volume(p) * stress(p, strain_rate(velocity, p));
      for (std::size_t e = p * width; e < (p + 1) * width; ++e)
        residual[static_cast<std::size_t>(table_->node[e])] += impulse * table_->gradient[e];
    }
    wall_residual_ = residual;
    for (std::size_t i = 0; i < residual.size(); ++i)
      if (is_fixed_[i]) residual[i] = Vec2::Zero();
  }

  /// The walls' impulse in the last residual [kg/s].
  [[nodiscard]] Vec2 wall_impulse() const {
    Vec2 sum = Vec2::Zero();
    for (std::size_t i = 0; i < wall_residual_.size(); ++i)
      if (is_wall_[i]) sum += wall_residual_[i];
    return sum;
  }

  /// A particle's strain rate D and, there, mu and d mu/dq.
  struct Linearised {
    Mat2 d;
    double mu, slope;
  };

  /// Matrix of the residual's derivative, symmetric: the part of it that trace D makes unsymmetric is left
  /// out. `linearised(p)` gives a particle's law.
  template <class Law>
  void factorise(const Law& linearised) {
    std::fill(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros(), 0.0);
    for (int column = 0; column < mass_->outerSize(); ++column)
      for (SparseMatrix::InnerIterator entry(*mass_, column); entry; ++entry)
        for (int a : {0, 1})
          matrix_.coeffRef(2 * static_cast<int>(entry.row()) + a, 2 * column + a) += entry.value();
    const std::vector<int> distances = slots_.distances(table_->width, table_->support_x);
    for (std::size_t p = 0; p < particles_->size(); ++p) add_particle(linearised(p), p, distances);
    std::vector<char> marked;
    for (const char fixed : is_fixed_) marked.insert(marked.end(), 2, fixed);
    decouple(matrix_, marked, matrix_.diagonal().maxCoeff());
    factors_.factorize(matrix_);
    factorised_ = true;
  }

  /// step = -J^-1 residual
  void direction(const VectorField& residual, VectorField& step) const {
    const Eigen::Map<const Eigen::VectorXd> r(residual.front().data(),
                                              2 * static_cast<Eigen::Index>(residual.size()));
    Eigen::Map<Eigen::VectorXd>(step.front().data(), r.size()) = factors_.solve(-r);
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

  [[nodiscard]] double volume(std::size_t p) const { return particles_->mass[p] / particles_->density[p]; }

  void add_particle(const Linearised& law, std::size_t p, const std::vector<int>& distances) {
    const auto width = static_cast<std::size_t>(table_->width);
    const auto& [d, mu, slope] = law;
    const double weight = dt_ * volume(p);
    for (std::size_t k = p * width; k < (p + 1) * width; ++k) {
      const Vec2 g_k = table_->gradient[k], d_k = d * g_k;
      for (std::size_t l = p * width; l < (p + 1) * width; ++l) {
        const Vec2 g_l = table_->gradient[l], d_l = d * g_l;
        const Mat2 block = weight * (mu * (g_k.dot(g_l) * Mat2::Identity() + g_l * g_k.transpose() -
                                           (2.0 / 3.0) * g_k * g_l.transpose()) +
                                     8 * slope * d_k * d_l.transpose());
        for (int b : {0, 1}) {
          const std::size_t first =
              slots_.position(table_->node[k], distances[(k - p * width) * width + (l - p * width)], b);
          for (int a : {0, 1}) matrix_.valuePtr()[first + static_cast<std::size_t>(a)] += block(a, b);
        }
      }
    }
  }

  double cell_;
  std::vector<char> is_wall_, is_fixed_;
  SparseMatrix matrix_;
  PairSlots slots_;
  Eigen::SimplicialLDLT<SparseMatrix> factors_;
  bool factorised_ = false;
  // The system at hand.
  const StencilTable* table_ = nullptr;
  const Particles* particles_ = nullptr;
  const SparseMatrix* mass_ = nullptr;
  VectorField *start_ = nullptr, *force_ = nullptr;
  VectorField wall_residual_;
  VectorField difference_;  // work space
  double dt_ = 0, scale_ = 0, least_shear_squared_ = 0;
};

}  // namespace mpm

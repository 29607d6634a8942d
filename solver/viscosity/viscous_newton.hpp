#pragma once

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/material/stress_update.hpp"
#include "solver/viscosity/implicit_viscosity.hpp"

namespace mpm {

/// Newton's method for one fluid. The system is the minimum of a convex function wherever shear stress grows
/// with shear rate, so that a line search on the function's slope along the Newton direction always makes
/// progress. A factorised matrix is kept while it still contracts the error (chord method): a Newtonian shear
/// flow factorises once in a run.
template <class Law>
class ViscousNewton final : public ImplicitViscosity {
 public:
  ViscousNewton(const Law& law, const Grid& grid, const WallNodes& walls)
      : law_(law),
        cell_(std::min(grid.x.h, grid.y.h)),
        matrix_(pair_pattern(grid, 2)),
        slots_(grid, matrix_, 2) {
    for (std::size_t i = 0; i < grid.size(); ++i) is_wall_.push_back(walls.is_wall(i) ? 1 : 0);
    factors_.analyzePattern(matrix_);
  }

  ImplicitSolution solve(const StencilTable& table, const Particles& particles, const SparseMatrix& mass,
                         VectorField start, VectorField force, double dt, VectorField& velocity) override {
    begin(table, particles, mass, start, force, dt, velocity);
    if (!factorised_) factorise(velocity);
    bool fresh = false, converged = false;
    double last_change = std::numeric_limits<double>::infinity();
    VectorField residual(velocity.size()), step(velocity.size());
    residual_at(velocity, residual);
    for (int iteration = 0; iteration < most_iterations && !converged; ++iteration) {
      direction(residual, step);
      double change = largest(step);
      if (!fresh && !(change <= contraction * last_change)) {
        factorise(velocity);
        direction(residual, step);
        change = largest(step);
      }
      if (!std::isfinite(change)) break;
      converged = change <= tolerance * std::max(largest(velocity), scale_);
      if (converged) {  // too small a step to change the residual, which goes on to tell the walls' forces
        for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] += step[i];
        break;
      }
      const double fraction = advance(velocity, step, residual);
      // A cut step says nothing on how well the matrix contracts: take the present one's next time.
      fresh = fraction < 1;
      if (fresh) factorise(velocity);
      last_change = change;
    }
    Vec2 wall_impulse = Vec2::Zero();
    for (std::size_t i = 0; i < velocity.size(); ++i)
      if (is_wall_[i]) wall_impulse += wall_residual_[i];
    return {wall_impulse, converged};
  }

 private:
  // Round-off in the residual, amplified by the condition of M + dt K, leaves a few 1e-14 of the velocity.
  static constexpr double tolerance = 1e-12;
  static constexpr double contraction = 0.1;
  static constexpr int most_iterations = 100;
  // Shear rates below this fraction of velocity scale per cell count as this: a power law below one has an
  // infinite viscosity at rest. What it leaves out is a stress 1e-9^n of the flow's.
  static constexpr double shear_floor = 1e-9;

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

  /// mu(q) and d mu/dq at q = gdot^2.
  [[nodiscard]] std::pair<double, double> viscosity(double q) const {
    if constexpr (Law::needs_shear_rate) {
      q = std::max(q, least_shear_squared_);
      constexpr double e = 1e-4;  // relative: truncation e^2 and round-off 1e-16/e are both below 1e-8
      const double mu = law_.viscosity(q);
      const double slope = (law_.viscosity(q * (1 + e)) - law_.viscosity(q * (1 - e))) / (2 * e * q);
      // Not below the slope at which shear stress would fall with shear rate.
      return {mu, std::max(slope, -0.4995 * mu / q)};
    } else {
      return {law_.viscosity(), 0};
    }
  }

  [[nodiscard]] Mat2 strain_rate(const VectorField& velocity, std::size_t p) const {
    Mat2 l = Mat2::Zero();
    const auto width = static_cast<std::size_t>(table_->width);
    for (std::size_t e = p * width; e < (p + 1) * width; ++e)
      l += velocity[static_cast<std::size_t>(table_->node[e])] * table_->gradient[e].transpose();
    return 0.5 * (l + l.transpose());
  }

  [[nodiscard]] double volume(std::size_t p) const { return particles_->mass[p] / particles_->density[p]; }

  /// M (v - start) - dt (f + f_visc(v)), zero at fixed nodes; what stood at the walls is kept.
  void residual_at(const VectorField& velocity, VectorField& residual) {
    difference_.resize(velocity.size());
    for (std::size_t i = 0; i < velocity.size(); ++i) difference_[i] = velocity[i] - (*start_)[i];
    rows_of(residual).noalias() = *mass_ * rows_of(difference_);
    for (std::size_t i = 0; i < velocity.size(); ++i) residual[i] -= dt_ * (*force_)[i];
    const auto width = static_cast<std::size_t>(table_->width);
    for (std::size_t p = 0; p < particles_->size(); ++p) {
      const Mat2 d = strain_rate(velocity, p);
      const double mu = viscosity(2 * d.squaredNorm()).first;
      const Mat2 stress = 2 * mu * d - (2.0 / 3.0) * mu * d.trace() * Mat2::Identity();
      const Mat2 impulse = dt_ * volume(p) * stress;
      for (std::size_t e = p * width; e < (p + 1) * width; ++e)
        residual[static_cast<std::size_t>(table_->node[e])] += impulse * table_->gradient[e];
    }
    wall_residual_ = residual;
    for (std::size_t i = 0; i < residual.size(); ++i)
      if (is_fixed_[i]) residual[i] = Vec2::Zero();
  }

  /// Matrix of the residual's derivative, symmetric: the part of it that trace D makes unsymmetric is left
  /// out.
  void factorise(const VectorField& velocity) {
    std::fill(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros(), 0.0);
    for (int column = 0; column < mass_->outerSize(); ++column)
      for (SparseMatrix::InnerIterator entry(*mass_, column); entry; ++entry)
        for (int a : {0, 1})
          matrix_.coeffRef(2 * static_cast<int>(entry.row()) + a, 2 * column + a) += entry.value();
    const std::vector<int> distances = slots_.distances(table_->width, table_->support_x);
    for (std::size_t p = 0; p < particles_->size(); ++p) add_particle(velocity, p, distances);
    std::vector<char> marked;
    for (const char fixed : is_fixed_) marked.insert(marked.end(), 2, fixed);
    decouple(matrix_, marked, matrix_.diagonal().maxCoeff());
    factors_.factorize(matrix_);
    factorised_ = true;
  }

  void add_particle(const VectorField& velocity, std::size_t p, const std::vector<int>& distances) {
    const auto width = static_cast<std::size_t>(table_->width);
    const Mat2 d = strain_rate(velocity, p);
    const auto [mu, slope] = viscosity(2 * d.squaredNorm());
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

  /// step = -J^-1 residual
  void direction(const VectorField& residual, VectorField& step) const {
    const Eigen::Map<const Eigen::VectorXd> r(residual.front().data(),
                                              2 * static_cast<Eigen::Index>(residual.size()));
    Eigen::Map<Eigen::VectorXd>(step.front().data(), r.size()) = factors_.solve(-r);
  }

  /// v += s step with s = 1, or smaller where the slope of the convex function has grown beyond the one at
  /// the start. Updates the residual and returns s.
  double advance(VectorField& velocity, const VectorField& step, VectorField& residual) {
    base_ = velocity;
    const double slope_at_start = dot(residual, step);
    double low = 0, high = 1, fraction = 1;
    for (int cut = 0; cut < 30; ++cut) {
      for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] = base_[i] + fraction * step[i];
      residual_at(velocity, residual);
      if (!Law::needs_shear_rate || is_round_off(step)) break;
      const double slope = dot(residual, step);
      if (std::abs(slope) <= 0.5 * std::abs(slope_at_start)) break;
      // Still falling: the minimum lies beyond; a full step is never lengthened.
      if (slope < 0 && fraction == 1) break;
      (slope < 0 ? low : high) = fraction;
      fraction = 0.5 * (low + high);
    }
    return fraction;
  }

  [[nodiscard]] bool is_round_off(const VectorField& step) const {
    return largest(step) <= tolerance * scale_;
  }

  static double dot(const VectorField& a, const VectorField& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
    return sum;
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

  Law law_;
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
  VectorField difference_, base_;  // work space
  double dt_ = 0, scale_ = 0, least_shear_squared_ = 0;
};

}  // namespace mpm

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <memory>

#include "solver/material/block_viscosity.hpp"
#include "solver/material/cell_dilatation.hpp"
#include "solver/particles.hpp"
#include "solver/scene/scene.hpp"

namespace mpm {

/// Strain rate, density, viscosity and stress of every particle from a nodal velocity field. The choice of
/// fluid is made once a call, outside the particle loop.
class StressUpdate {
 public:
  virtual ~StressUpdate() = default;
  /// Advances density by dt [s] and sets the stress; dt = 0 sets the stress of the present state.
  virtual void operator()(Particles& particles, const Grid& grid, const VectorField& nodal_velocity,
                          double dt) const = 0;
  /// Advances density alone, by the volume ratio det(I + dt L) of the motion x + dt v(x): exact for that
  /// motion, where rho/(1 + dt tr D) errs by dt^2 det L and makes every scheme first order.
  virtual void compress(Particles& particles, const Grid& grid, const VectorField& nodal_velocity,
                        double dt) const = 0;
  /// Sets the stress to that of the pressure alone.
  virtual void set_pressure(Particles& particles) const = 0;
};

/// sigma = 2 mu D - (2/3) mu tr(D) I (paper Eq. 21, without the pressure).
inline Mat2 viscous_stress(double mu, const Mat2& strain_rate) {
  return 2 * mu * strain_rate - (2.0 / 3.0) * mu * strain_rate.trace() * Mat2::Identity();
}

template <class Basis, class Pressure>
class FluidStress final : public StressUpdate {
 public:
  FluidStress(const Rheology& rheology, const Pressure& pressure)
      : viscosity_(rheology), pressure_(pressure) {}

  /// Block by block, so that the viscosities of a block come from one call on an array: in vector registers,
  /// and the law is asked for once a block.
  void operator()(Particles& particles, const Grid& grid, const VectorField& nodal_velocity,
                  double dt) const override {
    if constexpr (Pressure::is_of_cell)
      cells_.assign(pressure_, particles, grid, nodal_velocity,
                    [&](const Mat2& l) { return 1 + dt * l.trace(); });
    std::array<Mat2, block> strain_rate;
    ViscosityBlock mu = ViscosityBlock::Constant(viscosity_.constant());
    for (std::size_t begin = 0; begin < particles.size(); begin += block) {
      const std::size_t count = std::min(block, particles.size() - begin);
      for (std::size_t k = 0; k < count; ++k) {
        const Mat2 l = gradient<Basis>(grid, nodal_velocity, particles.position[begin + k]);
        strain_rate[k] = 0.5 * (l + l.transpose());
        if constexpr (Pressure::is_of_cell)
          strain_rate[k] += 0.5 * (cells_.dilatation(begin + k) - l.trace()) * Mat2::Identity();
      }
      if (viscosity_.varies()) mu = viscosity_(squared_shear_rates(strain_rate, count));
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t p = begin + k;
        const Mat2& d = strain_rate[k];
        particles.stress[p] = viscous_stress(mu[static_cast<Eigen::Index>(k)], d) -
                              pressure_.pressure(advance_density(particles, p, d, dt)) * Mat2::Identity();
      }
    }
  }

  void compress(Particles& particles, const Grid& grid, const VectorField& nodal_velocity,
                double dt) const override {
    const auto ratio = [dt](const Mat2& l) {
      return (1 + dt * l(0, 0)) * (1 + dt * l(1, 1)) - dt * dt * l(0, 1) * l(1, 0);
    };
    if constexpr (Pressure::is_of_cell) {
      cells_.assign(pressure_, particles, grid, nodal_velocity, ratio);
      for (std::size_t p = 0; p < particles.size(); ++p) particles.density[p] = cells_.of(p);
    } else if constexpr (Pressure::varies) {
      for (std::size_t p = 0; p < particles.size(); ++p)
        particles.density[p] /= ratio(gradient<Basis>(grid, nodal_velocity, particles.position[p]));
    }
  }

  void set_pressure(Particles& particles) const override {
    for (std::size_t p = 0; p < particles.size(); ++p)
      particles.stress[p] = -pressure_.pressure(particles.density[p]) * Mat2::Identity();
  }

 private:
  static constexpr std::size_t block = ViscosityBlock::SizeAtCompileTime;

  /// Advances a particle's density by dt and returns the one that its pressure belongs to. With dt = 0 the
  /// particles of a cell keep theirs: asking for the stress changes nothing.
  double advance_density(Particles& particles, std::size_t p, const Mat2& d, double dt) const {
    if constexpr (Pressure::is_of_cell) {
      if (dt > 0) particles.density[p] = cells_.of(p);
      return cells_.of(p);
    } else {
      return particles.density[p] = pressure_.advance_density(particles.density[p], d.trace(), dt);
    }
  }

  /// gdot^2 = 2 D:D of the particles of a block; places beyond `count` hold a harmless value.
  static ViscosityBlock squared_shear_rates(const std::array<Mat2, block>& strain_rate, std::size_t count) {
    ViscosityBlock gdot_squared = ViscosityBlock::Ones();
    for (std::size_t k = 0; k < count; ++k)
      gdot_squared[static_cast<Eigen::Index>(k)] = 2 * strain_rate[k].squaredNorm();
    return gdot_squared;
  }

  struct Nothing {};
  BlockViscosity viscosity_;
  Pressure pressure_;
  [[no_unique_address]] mutable std::conditional_t<Pressure::is_of_cell, CellDensities<Basis>, Nothing>
      cells_;
};

/// The update that a scene's fluid and a scheme ask for, on a basis.
template <class Basis>
std::unique_ptr<StressUpdate> make_stress_update(const Scene& scene, const Scheme& scheme) {
  const auto make = [&]<class Pressure>(const Pressure& pressure) {
    return std::unique_ptr<StressUpdate>(
        std::make_unique<FluidStress<Basis, Pressure>>(scene.fluid.rheology, pressure));
  };
  const Fluid& fluid = scene.fluid;
  if (!fluid.pressure) return make(NoPressure{});
  const TaitPressure tait{fluid.bulk_modulus, 1 / fluid.density};
  if (scheme.dilatation == Scheme::Dilatation::Cell)
    return make(CellTaitPressure{tait, scene.least_density()});
  return make(tait);
}

}  // namespace mpm

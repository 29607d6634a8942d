#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <memory>
#include <variant>

#include "solver/grid/stencil.hpp"
#include "solver/material/pressure.hpp"
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

template <class Basis, class Rheology, class Pressure>
class FluidStress final : public StressUpdate {
 public:
  FluidStress(const Rheology& rheology, const Pressure& pressure)
      : rheology_(rheology), pressure_(pressure) {}

  /// Block by block, so that the viscosities of a block come from one call on an array: in vector registers.
  void operator()(Particles& particles, const Grid& grid, const VectorField& nodal_velocity,
                  double dt) const override {
    std::array<Mat2, block> strain_rate;
    Array mu = Array::Zero();
    for (std::size_t begin = 0; begin < particles.size(); begin += block) {
      const std::size_t count = std::min(block, particles.size() - begin);
      for (std::size_t k = 0; k < count; ++k) {
        const Mat2 l = gradient<Basis>(grid, nodal_velocity, particles.position[begin + k]);
        strain_rate[k] = 0.5 * (l + l.transpose());
      }
      viscosities(strain_rate, count, mu);
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t p = begin + k;
        const Mat2& d = strain_rate[k];
        particles.density[p] = pressure_.advance_density(particles.density[p], d.trace(), dt);
        particles.stress[p] = viscous_stress(mu[static_cast<Eigen::Index>(k)], d) -
                              pressure_.pressure(particles.density[p]) * Mat2::Identity();
      }
    }
  }

  void compress(Particles& particles, const Grid& grid, const VectorField& nodal_velocity,
                double dt) const override {
    if constexpr (Pressure::varies) {
      for (std::size_t p = 0; p < particles.size(); ++p) {
        const Mat2 l = gradient<Basis>(grid, nodal_velocity, particles.position[p]);
        particles.density[p] /= (1 + dt * l(0, 0)) * (1 + dt * l(1, 1)) - dt * dt * l(0, 1) * l(1, 0);
      }
    }
  }

  void set_pressure(Particles& particles) const override {
    for (std::size_t p = 0; p < particles.size(); ++p)
      particles.stress[p] = -pressure_.pressure(particles.density[p]) * Mat2::Identity();
  }

 private:
  static constexpr std::size_t block = 32;
  using Array = Eigen::Array<double, static_cast<int>(block), 1>;

  void viscosities(const std::array<Mat2, block>& strain_rate, std::size_t count, Array& mu) const {
    if constexpr (Rheology::needs_shear_rate) {
      Array gdot_squared = Array::Ones();  // lanes beyond `count` hold a harmless value
      for (std::size_t k = 0; k < count; ++k)
        gdot_squared[static_cast<Eigen::Index>(k)] = 2 * strain_rate[k].squaredNorm();
      mu = rheology_.viscosity(gdot_squared);
    } else {
      mu.setConstant(rheology_.viscosity());
    }
  }

  Rheology rheology_;
  Pressure pressure_;
};

/// The update that a fluid asks for, on a basis.
template <class Basis>
std::unique_ptr<StressUpdate> make_stress_update(const Fluid& fluid) {
  return std::visit(
      [&]<class Law>(const Law& law) -> std::unique_ptr<StressUpdate> {
        if (fluid.pressure)
          return std::make_unique<FluidStress<Basis, Law, TaitPressure>>(
              law, TaitPressure{fluid.bulk_modulus, 1 / fluid.density});
        return std::make_unique<FluidStress<Basis, Law, NoPressure>>(law, NoPressure{});
      },
      fluid.rheology);
}

}  // namespace mpm

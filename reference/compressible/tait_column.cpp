#include "reference/compressible/tait_column.hpp"

#include <cmath>

#include "reference/require.hpp"

namespace reference {

double tait_pressure(double density, double bulk_constant, double reference_density) {
  // expm1 and log keep the digits of a pressure near zero.
  return bulk_constant * std::expm1(7.0 * std::log(density / reference_density));
}

TaitColumn::TaitColumn(const TaitColumnParameters& parameters) : parameters_(parameters) {
  const auto& [height, gravity, c, rho0] = parameters_;
  require(std::isfinite(height) && height > 0.0, "Tait column: the height must be positive and finite");
  require(std::isfinite(gravity) && gravity >= 0.0, "Tait column: gravity must be finite and not negative");
  require(std::isfinite(c) && c > 0.0, "Tait column: the sound speed must be positive and finite");
  require(std::isfinite(rho0) && rho0 > 0.0,
          "Tait column: the reference density must be positive and finite");
}

double TaitColumn::density(double y) const {
  const auto& [height, gravity, c, rho0] = parameters_;
  return rho0 * std::pow(1.0 + 6.0 * gravity * (height - y) / (c * c), 1.0 / 6.0);
}

double TaitColumn::pressure(double y) const {
  const double c = parameters_.sound_speed, rho0 = parameters_.reference_density;
  return tait_pressure(density(y), rho0 * c * c / 7.0, rho0);
}

double TaitColumn::mass() const {
  const auto& [height, gravity, c, rho0] = parameters_;
  // (P(0) - P(H))/g = rho0 c^2/(7 g) [(1 + s)^(7/6) - 1], s = 6 g H/c^2, which is rho0 H as s -> 0.
  const double s = 6.0 * gravity * height / (c * c);
  return s == 0.0 ? rho0 * height : rho0 * height * 6.0 / 7.0 * std::expm1(7.0 / 6.0 * std::log1p(s)) / s;
}

double TaitColumn::gravity_of_contrast(double contrast, double height, double sound_speed) {
  require(std::isfinite(contrast) && contrast >= 0.0,
          "Tait column: the density contrast must be finite and not negative");
  return sound_speed * sound_speed / (6.0 * height) * std::expm1(6.0 * std::log1p(contrast));
}

}  // namespace reference

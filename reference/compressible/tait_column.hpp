#pragma once

namespace reference {

/// Pressure P = K [(rho/rho0)^7 - 1] [Pa] of the Tait equation of state; K [Pa], densities [kg/m3].
double tait_pressure(double density, double bulk_constant, double reference_density);

/// A column of Tait fluid at rest between two plates. SI units.
struct TaitColumnParameters {
  double height = 0.0;             ///< H [m] > 0
  double gravity = 0.0;            ///< g [m/s2] >= 0, towards y = 0
  double sound_speed = 0.0;        ///< c [m/s] > 0 at rho0
  double reference_density = 0.0;  ///< rho0 [kg/m3] > 0, that of the fluid at y = H, where P = 0
};

/// Hydrostatic equilibrium dP/dy = -rho g of the Tait fluid P = K [(rho/rho0)^7 - 1], c^2 = 7 K/rho0. With
/// r = rho/rho0 it reads c^2 r^5 dr/dy = -g, so
///   r(y) = [1 + 6 g (H - y)/c^2]^(1/6),
/// and the mass of the column is (P(0) - P(H))/g per unit area.
class TaitColumn {
 public:
  /// Throws std::invalid_argument for arguments out of the ranges above, or not finite.
  explicit TaitColumn(const TaitColumnParameters& parameters);

  /// rho(y) [kg/m3]; 0 <= y <= H, and as far above H as the fluid holds together.
  [[nodiscard]] double density(double y) const;
  /// P(y) [Pa].
  [[nodiscard]] double pressure(double y) const;
  /// Mass per unit area of the plates [kg/m2].
  [[nodiscard]] double mass() const;
  /// Gravity [m/s2] that makes the density at the bottom (1 + contrast) times that at the top; contrast >= 0.
  static double gravity_of_contrast(double contrast, double height, double sound_speed);

 private:
  TaitColumnParameters parameters_;
};

}  // namespace reference

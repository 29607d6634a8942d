#pragma once

namespace reference {

/// A fluid that is stretched evenly along x from t = 0. SI units.
struct UniformDilatationParameters {
  double rate = 0.0;               ///< a [1/s], any sign: du/dx at t = 0
  double reference_density = 0.0;  ///< rho0 [kg/m3] > 0 at t = 0
};

/// Homogeneous dilatation along one axis, u = a x/(1 + a t): a solution of the equations of motion without
/// forces, since every material point keeps its velocity (Du/Dt = 0) and a uniform stress pushes nothing.
/// The point that starts at X is at X (1 + a t), and the density is rho0/(1 + a t). For a < 0 it ends in a
/// collapse at t = -1/a. The update rho/(1 + dt tr D) with the strain rate at the start of a step is exact
/// for it: (1 + a t)/(1 + a (t + dt)) = 1/(1 + dt a/(1 + a t)).
class UniformDilatation {
 public:
  /// Throws std::invalid_argument for a density that is not positive, or anything not finite.
  explicit UniformDilatation(const UniformDilatationParameters& parameters);

  /// 1 + a t, the ratio of present to initial lengths; std::invalid_argument at and after the collapse.
  [[nodiscard]] double stretch(double t) const;
  /// u(x, t) [m/s].
  [[nodiscard]] double velocity(double x, double t) const;
  /// rho(t) [kg/m3].
  [[nodiscard]] double density(double t) const;

 private:
  UniformDilatationParameters parameters_;
};

}  // namespace reference

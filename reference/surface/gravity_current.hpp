#pragma once

namespace reference {

/// A heap of a power-law fluid on a horizontal plane, symmetric about x = 0. SI units.
struct GravityCurrentParameters {
  double area = 0;         ///< A of the half with x > 0 [m2] > 0
  double gravity = 0;      ///< g [m/s2] > 0
  double consistency = 0;  ///< K/rho [m2 s^(n-2)] > 0, viscosity over density at a shear rate of 1/s
  double index = 1;        ///< n > 0
};

/// Planar viscous gravity current of fixed area in the limit of a thin layer (lubrication; Huppert 1982, J.
/// Fluid Mech. 121, 43, for n = 1; power law derived here in the same way). The layer's flow rate is
///   q = c h^(2+1/n) |h_x|^(1/n),  c = n/(2n+1) (g/(K/rho))^(1/n),
/// and h_t + q_x = 0 has the similarity solution
///   x_N = xi_N (c^n A^(n+2) t^n)^(1/(2n+3)),  h = A/x_N f(x/x_N),  f = (1 - s^(n+1))^(1/(n+2))/I,
///   I = integral of (1 - s^(n+1))^(1/(n+2)) over [0, 1],
///   xi_N = [(2n+3)/n]^(n/(2n+3)) [(n+1)/((n+2) I^(n+2))]^(1/(2n+3)).
class GravityCurrent {
 public:
  /// Throws std::invalid_argument for parameters out of the ranges above.
  explicit GravityCurrent(const GravityCurrentParameters& parameters);

  /// xi_N of an index n > 0: 1.4112 for n = 1.
  static double front_constant(double index);
  /// Exponent n/(2n+3) of t in the front.
  static double exponent(double index);
  /// I: the area over height at x = 0 times length.
  static double fullness(double index);
  /// Gravity [m/s2] under which a current of that consistency and index has its front at `front` [m] at time
  /// t [s].
  static double gravity_of(double front, double t, const GravityCurrentParameters& but_gravity);

  /// x_N [m] at time t > 0 [s].
  [[nodiscard]] double front(double t) const;
  /// h [m] at x >= 0 [m]; 0 beyond the front.
  [[nodiscard]] double height(double x, double t) const;

 private:
  GravityCurrentParameters parameters_;
  double c_;
};

}  // namespace reference

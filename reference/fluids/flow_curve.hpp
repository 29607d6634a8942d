#pragma once

#include <optional>
#include <string>
#include <variant>

namespace reference {

// Kinematic flow curves: stress per unit density tau [m2/s2] and viscosity nu [m2/s] against the shear rate
// w = |du/dy| [1/s]. A model is a short struct with viscosity(w), slope(w) = dtau/dw, check() and describe(),
// listed in FlowCurve::Model; where it has a closed form it also offers rate(tau), the inverse, or
// potential(w), the integral of tau from 0 to w. All of them take w, tau >= 0.

/// nu constant.
struct NewtonianCurve {
  double nu = 0.0;  ///< [m2/s] > 0
  void check() const;
  [[nodiscard]] double viscosity(double) const { return nu; }
  [[nodiscard]] double slope(double) const { return nu; }
  [[nodiscard]] double rate(double tau) const { return tau / nu; }
  [[nodiscard]] double potential(double w) const { return 0.5 * nu * w * w; }
  [[nodiscard]] std::optional<double> newtonian() const { return nu; }
  [[nodiscard]] std::string describe() const;
};

/// nu = nu_inf + (nu_0 - nu_inf)/(1 + (K w)^M) (Zhou & Sun 2019, Eq. 24).
struct CrossCurve {
  double nu_0 = 0.0;    ///< [m2/s] > 0
  double nu_inf = 0.0;  ///< [m2/s] >= 0
  double K = 0.0;       ///< [s] > 0
  double M = 1.0;       ///< [-] > 0
  void check() const;
  [[nodiscard]] double viscosity(double w) const;
  [[nodiscard]] double slope(double w) const;
  [[nodiscard]] std::optional<double> rate(double tau) const;     // closed for M = 1
  [[nodiscard]] std::optional<double> potential(double w) const;  // closed for M = 1
  [[nodiscard]] std::optional<double> newtonian() const;
  [[nodiscard]] std::string describe() const;
};

/// nu = nu_0 w^(n-1), w in 1/s (Zhou & Sun 2019, Eq. 25). At w = 0: infinite for n < 1, zero for n > 1.
struct PowerLawCurve {
  double nu_0 = 0.0;  ///< [m2/s] at w = 1/s, > 0
  double n = 1.0;     ///< [-] > 0
  void check() const;
  [[nodiscard]] double viscosity(double w) const;
  [[nodiscard]] double slope(double w) const;
  [[nodiscard]] double rate(double tau) const;
  [[nodiscard]] double potential(double w) const;
  [[nodiscard]] std::optional<double> newtonian() const;
  [[nodiscard]] std::string describe() const;
};

/// nu = nu_inf + (nu_0 - nu_inf)(1 + (lambda w)^a)^((n-1)/a); a = 2 is Carreau's (Bird, Armstrong & Hassager
/// 1987).
struct CarreauYasudaCurve {
  double nu_0 = 0.0;    ///< [m2/s] > 0
  double nu_inf = 0.0;  ///< [m2/s] >= 0
  double lambda = 0.0;  ///< [s] > 0
  double a = 2.0;       ///< [-] > 0
  double n = 1.0;       ///< [-] > 0
  void check() const;
  [[nodiscard]] double viscosity(double w) const;
  [[nodiscard]] double slope(double w) const;
  [[nodiscard]] std::optional<double> newtonian() const;
  [[nodiscard]] std::string describe() const;
};

/// tau = nu_0 w^n + tau_y (1 - exp(-m w)): Herschel & Bulkley's fluid, n = 1 Bingham's, with Papanastasiou's
/// regularisation (J. Rheol. 31, 1987, 385); m = infinity is the ideal fluid, which does not flow below
/// tau_y.
struct HerschelBulkleyCurve {
  double nu_0 = 0.0;   ///< consistency [m2/s] at w = 1/s, > 0
  double n = 1.0;      ///< [-] > 0
  double tau_y = 0.0;  ///< yield stress over density [m2/s2] > 0
  double m = 0.0;      ///< [s] > 0
  void check() const;
  [[nodiscard]] double viscosity(double w) const;
  [[nodiscard]] double slope(double w) const;
  [[nodiscard]] double rate(double tau) const;
  [[nodiscard]] double potential(double w) const;
  [[nodiscard]] std::optional<double> newtonian() const { return std::nullopt; }
  [[nodiscard]] std::string describe() const;
  /// The same fluid without regularisation.
  [[nodiscard]] HerschelBulkleyCurve ideal() const;
};

/// Any of the models above, with what every reference solution needs of it. Signs: stress and rate are odd,
/// viscosity, slope and potential even functions.
class FlowCurve {
 public:
  using Model =
      std::variant<NewtonianCurve, CrossCurve, PowerLawCurve, CarreauYasudaCurve, HerschelBulkleyCurve>;

  /// Throws std::invalid_argument for parameters out of their ranges.
  FlowCurve(const Model& model);  // NOLINT(google-explicit-constructor): a model is a flow curve
  FlowCurve(const NewtonianCurve& model) : FlowCurve(Model(model)) {}
  FlowCurve(const CrossCurve& model) : FlowCurve(Model(model)) {}
  FlowCurve(const PowerLawCurve& model) : FlowCurve(Model(model)) {}
  FlowCurve(const CarreauYasudaCurve& model) : FlowCurve(Model(model)) {}
  FlowCurve(const HerschelBulkleyCurve& model) : FlowCurve(Model(model)) {}

  [[nodiscard]] const Model& model() const { return model_; }

  /// nu(|w|) [m2/s]; infinite or zero at w = 0 for a power law.
  [[nodiscard]] double viscosity(double w) const;
  /// tau(w) [m2/s2], odd.
  [[nodiscard]] double stress(double w) const;
  /// dtau/dw [m2/s], even.
  [[nodiscard]] double slope(double w) const;
  /// w(tau) [1/s], the inverse of stress, odd, to a few 1e-16. Throws std::invalid_argument if no finite rate
  /// gives tau.
  [[nodiscard]] double rate(double tau) const;
  /// Phi(w), integral of tau from 0 to w [m2/s3], even.
  [[nodiscard]] double potential(double w) const;
  /// Complementary potential w tau - Phi, the integral of the rate from 0 to tau [m2/s3], even.
  [[nodiscard]] double complementary_potential(double tau) const;

  /// The constant viscosity [m2/s] if the curve is Newtonian whatever its model (a = 1, n = 1, nu_0 =
  /// nu_inf).
  [[nodiscard]] std::optional<double> newtonian() const;
  /// The model if it has a yield stress, else null.
  [[nodiscard]] const HerschelBulkleyCurve* yielding() const {
    return std::get_if<HerschelBulkleyCurve>(&model_);
  }
  /// dlog(tau)/dlog(w) at w > 0: the exponent of the power law that osculates the curve there.
  [[nodiscard]] double local_exponent(double w) const { return slope(w) / viscosity(w); }

  /// Throws std::invalid_argument unless tau grows with w all the way from 0 to `largest_rate` [1/s].
  void require_monotone(double largest_rate) const;

  /// Model and parameters, 17 digits: equal texts mean equal curves.
  [[nodiscard]] std::string describe() const;

 private:
  [[nodiscard]] double invert(double tau) const;

  Model model_;
};

}  // namespace reference

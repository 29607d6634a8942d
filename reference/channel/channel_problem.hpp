#pragma once

#include <string>
#include <vector>

#include "reference/fluids/flow_curve.hpp"

namespace reference {

/// Start-up of a channel from rest at t = 0: plates at y = 0 (at rest) and y = H, a constant body
/// acceleration F and an upper plate that moves with V0 from t = 0 on. Between plates at rest the flow may
/// also begin as the steady one of another body acceleration, which F replaces at t = 0: F = 0 is cessation.
/// In place of a plate a stress may pull the fluid along its upper side from t = 0 on. SI units.
struct ChannelProblem {
  double height = 0.0;                ///< H [m] > 0
  double body_acceleration = 0.0;     ///< F [m/s2], any sign
  double plate_velocity = 0.0;        ///< V0 [m/s], any sign; F and V0 not both zero
  FlowCurve curve;                    ///< monotone up to the shear rates that occur
  std::vector<double> times;          ///< [s] >= 0, at which the solution is wanted; any order
  double initial_acceleration = 0.0;  ///< F before t = 0 [m/s2], whose steady flow is the start; 0: from rest
  double pull = 0.0;  ///< stress over density on the side at H [m2/s2], any sign, alone; 0: a plate

  /// Throws std::invalid_argument for values out of these ranges.
  void check() const;
  /// Every parameter, 17 digits: equal texts mean equal problems.
  [[nodiscard]] std::string describe() const;
  /// The same without the times.
  [[nodiscard]] std::string describe_flow() const;
  /// Smallest positive and largest of the times; 0 if there is none.
  [[nodiscard]] double first_time() const;
  [[nodiscard]] double last_time() const;
  /// The power of ten [s] at or below first_time, 0 if there is none: what a computed solution is accurate
  /// from, so that problems that ask for neighbouring times share one.
  [[nodiscard]] double accurate_from() const;
};

}  // namespace reference

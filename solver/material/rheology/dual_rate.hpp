#pragma once

#include <algorithm>
#include <cmath>

#include "solver/material/rheology/herschel_bulkley.hpp"

namespace mpm {

/// Places on the flow curve of a regularised yield stress, told by y = tau + c gdot: where the curve is
/// steep, y follows the stress, beyond its corner the rate, and either is a mildly bent function of y. c is a
/// viscosity of the flow beyond the corner; any within a factor of ten serves.
class DualRate {
 public:
  /// `typical_rate`: of the flow at hand [1/s].
  DualRate(const HerschelBulkley& law, double typical_rate)
      : law_(law), c_(law.consistency * std::pow(std::max(typical_rate, law.floor), law.n - 1)) {}

  [[nodiscard]] double c() const { return c_; }  ///< [Pa s]

  /// The shear rate gdot >= 0 at which tau(gdot) + c gdot = y [Pa]: by Newton's method, held within bounds
  /// that shut around the root. `guess`: another rate [1/s].
  [[nodiscard]] double rate(double y, double guess) const {
    double low = 0, high = y / c_;
    if (!(high > 0)) return 0;
    double x = guess > 0 && guess < high ? guess : 0.5 * high;
    for (int k = 0; k < 100; ++k) {
      const double miss = (law_.viscosity(x * x) + c_) * x - y;
      if (std::abs(miss) <= 4e-16 * y) break;
      (miss < 0 ? low : high) = x;
      double next = x - miss / (tangent(x) + c_);
      // Many decades lie between the rates of a plug and of a flow: the middle of the exponents.
      if (!(next > low && next < high)) next = low > 0 ? std::sqrt(low * high) : 1e-3 * high;
      if (next == x) break;
      x = next;
    }
    return x;
  }

  /// A new place: the flow is at `flow` (any vector whose length is the shear rate), the curve was linearised
  /// at `at`, where its viscosity is mu [Pa s] with a slope d mu/d(gdot^2). `share` of the way is gone. The
  /// strain rate of the new place, parallel to stress + c rate.
  template <class Rate>
  [[nodiscard]] Rate moved(const Rate& at, double mu, double slope, const Rate& flow, double share) const {
    const Rate change = flow - at;
    const Rate y = (mu + c_) * at + share * ((mu + c_) * change + (2 * slope * at.dot(change)) * at);
    const double length = y.norm();
    return length > 0 ? Rate(rate(length, at.norm()) / length * y) : Rate(0 * y);
  }

 private:
  /// d tau/d gdot [Pa s].
  [[nodiscard]] double tangent(double gdot) const {
    const double power = RealPower{law_.n - 1}(std::max(gdot, law_.floor));
    return law_.consistency * (gdot > law_.floor ? law_.n : 1) * power +
           law_.yield_stress * law_.regularisation * std::exp(-law_.regularisation * gdot);
  }

  const HerschelBulkley law_;
  double c_;
};

/// Share of the way that places go next. Whole steps may come round in circles, where a fluid that thickens
/// starts from rest; half and quarter steps do not. `change`: of the velocities in this iteration, and in the
/// last one.
inline double next_share(double share, double change, double last_change, int iteration) {
  if (change <= 0.8 * last_change) return std::min(1.0, 2 * share);
  return iteration < 3 ? share : std::max(0.25, 0.5 * share);
}

}  // namespace mpm

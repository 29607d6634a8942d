#pragma once

#include <algorithm>
#include <functional>

#include "solver/incompressible/space/spline_axis.hpp"
#include "solver/material/rheology.hpp"

namespace mpm::incompressible {

/// Kinematic viscosity nu [m2/s] and d nu/d q [m2 s] at many q = gdot^2 = 2 D:D [1/s2] in one call.
using FlowLaw = std::function<void(const VectorXd& q, VectorXd& nu, VectorXd& slope)>;

/// Of a fluid of the given density [kg/m3]. Shear rates below a billionth of the largest count as that: a
/// power law below one has an infinite viscosity at rest.
inline FlowLaw flow_law(const Rheology& rheology, double density) {
  return std::visit(
      [density]<class Law>(const Law& law) -> FlowLaw {
        return [law, density](const VectorXd& q, VectorXd& nu, VectorXd& slope) {
          nu.resize(q.size());
          slope.setZero(q.size());
          if constexpr (!Law::needs_shear_rate) {
            nu.setConstant(law.viscosity() / density);
          } else {
            const double least = std::max(1e-18 * q.maxCoeff(), 1e-200);
            constexpr double e = 1e-4;  // relative: truncation e^2 and round-off 1e-16/e are below 1e-8
            for (Eigen::Index i = 0; i < q.size(); ++i) {
              const double at = std::max(q[i], least);
              nu[i] = law.viscosity(at) / density;
              const double d = (law.viscosity(at * (1 + e)) - law.viscosity(at * (1 - e))) / (2 * e * at);
              // Not below the slope at which shear stress would fall with shear rate.
              slope[i] = std::max(d / density, -0.4995 * nu[i] / at);
            }
          }
        };
      },
      rheology);
}

}  // namespace mpm::incompressible

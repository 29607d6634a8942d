#include "reference/compressible/uniform_dilatation.hpp"

#include <cmath>

#include "reference/require.hpp"

namespace reference {

UniformDilatation::UniformDilatation(const UniformDilatationParameters& parameters)
    : parameters_(parameters) {
  require(std::isfinite(parameters.rate), "uniform dilatation: the rate must be finite");
  require(std::isfinite(parameters.reference_density) && parameters.reference_density > 0.0,
          "uniform dilatation: the reference density must be positive and finite");
}

double UniformDilatation::stretch(double t) const {
  const double stretch = 1.0 + parameters_.rate * t;
  require(stretch > 0.0, "uniform dilatation: the time must lie before the collapse at t = -1/rate");
  return stretch;
}

double UniformDilatation::velocity(double x, double t) const {
  return parameters_.rate * x / stretch(t);
}

double UniformDilatation::density(double t) const {
  return parameters_.reference_density / stretch(t);
}

}  // namespace reference

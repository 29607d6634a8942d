#pragma once

#include "reference/compressible/uniform_dilatation.hpp"
#include "verification/flows/flow.hpp"

namespace verification {

/// Even compression along one axis, u = a x/(1 + a t), a < 0: the wall at L moves with the fluid that starts
/// there, the fluid draws away from the edge of the grid and leaves empty cells behind. Every material point
/// keeps its velocity if pressure and viscosity are too small to matter, so give the fluid a tiny bulk
/// modulus and viscosity: the density update alone is on trial. Judge it on the particles: grid samples in
/// empty cells mean nothing.
struct DilatationFlowParameters {
  double length = 0;  ///< L [m]
  int axis = 0;       ///< 0 for x, 1 for y
  double rate = 0;    ///< a [1/s] < 0
  mpm::Fluid fluid;
};

class DilatationFlow final : public Flow {
 public:
  explicit DilatationFlow(const DilatationFlowParameters& parameters);
  [[nodiscard]] mpm::Scene scene(const Discretisation& discretisation) const override;
  [[nodiscard]] std::shared_ptr<const ExactField> exact(const std::vector<double>& times) const override;
  [[nodiscard]] double velocity_scale() const override { return -parameters_.rate * parameters_.length; }
  [[nodiscard]] double latest() const override { return -1 / parameters_.rate; }
  [[nodiscard]] Probe probe() const override;
  [[nodiscard]] int across() const override { return parameters_.axis; }
  [[nodiscard]] double length() const override { return parameters_.length; }

 private:
  DilatationFlowParameters parameters_;
  std::shared_ptr<const reference::UniformDilatation> solution_;
};

}  // namespace verification

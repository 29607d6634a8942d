#pragma once

#include "reference/surface/gravity_current.hpp"
#include "verification/flows/flow.hpp"
#include "verification/flows/fluid_reader.hpp"

namespace verification {

/// A heap of a viscous fluid that spreads over a plane which it sticks to, half of it beside a plane of
/// symmetry at x = 0. It starts at rest in the shape of the thin-layer similarity solution of its age; what
/// that neglects falls with the aspect ratio.
struct GravityCurrentFlowParameters {
  double front = 0;         ///< x_N at the start [m]
  double aspect_ratio = 0;  ///< x_N over the height at x = 0, at the start
  double age = 0;           ///< of the similarity solution at the start [s]; gravity follows from it
  double room = 2;          ///< width of the box over the front at the start
  FluidConfig fluid;        ///< Newtonian or power law
};

class GravityCurrentFlow final : public Flow {
 public:
  /// Throws std::invalid_argument for another fluid.
  explicit GravityCurrentFlow(const GravityCurrentFlowParameters& parameters);
  /// Cells are counted over the box's height, 1.25 times that of the heap.
  [[nodiscard]] mpm::Scene scene(const Discretisation& discretisation) const override;
  [[nodiscard]] bool has_exact() const override { return false; }
  [[nodiscard]] std::shared_ptr<const ExactField> exact(const std::vector<double>&) const override {
    return nullptr;
  }
  [[nodiscard]] std::optional<Spreading> spreading() const override;
  /// Of the front at the start.
  [[nodiscard]] double velocity_scale() const override;
  [[nodiscard]] Probe probe() const override;
  [[nodiscard]] int across() const override { return 1; }
  [[nodiscard]] double length() const override { return 1.25 * height(); }
  /// [m/s2]
  [[nodiscard]] double gravity() const { return gravity_; }

 private:
  [[nodiscard]] double height() const { return parameters_.front / parameters_.aspect_ratio; }

  GravityCurrentFlowParameters parameters_;
  double index_, gravity_;
};

}  // namespace verification

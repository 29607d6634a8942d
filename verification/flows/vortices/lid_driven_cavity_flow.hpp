#pragma once

#include "reference/fluids/flow_curve.hpp"
#include "reference/vortices/lid_driven_cavity.hpp"
#include "verification/flows/flow.hpp"
#include "verification/flows/vortices/cavity_tables.hpp"

namespace verification {

/// The square cavity [0, L]^2 whose lid, y = L, moves along x with U from t = 0. The steady flow is known at
/// the points of published tables alone, one component at each: there grid velocities are compared. For some
/// other than Newtonian fluids the tables are this project's (cavity_tables.hpp); of any other it is computed
/// there (reference/cavity/cavity_finite_volumes.hpp). A smooth lid
/// moves with 16 U (x/L)^2 (1 - x/L)^2: the steady flow of a Newtonian fluid is then known everywhere
/// (reference/vortices/smooth_cavity.hpp).
struct LidDrivenCavityParameters {
  double side = 0;          ///< L [m]
  double lid_velocity = 0;  ///< U [m/s]
  bool smooth = false;
  reference::FlowCurve curve{reference::NewtonianCurve{1}};
  mpm::Fluid fluid;
};

class LidDrivenCavityFlow final : public Flow {
 public:
  explicit LidDrivenCavityFlow(const LidDrivenCavityParameters& parameters) : parameters_(parameters) {}

  [[nodiscard]] mpm::Scene scene(const Discretisation& discretisation) const override;
  [[nodiscard]] mpm::WallShares wall_shares() const override;
  [[nodiscard]] bool has_exact() const override;
  [[nodiscard]] std::shared_ptr<const ExactField> exact(const std::vector<double>& times) const override;
  [[nodiscard]] std::optional<CostlyReference> costly_reference(
      const std::vector<double>& times) const override;
  [[nodiscard]] mpm::VectorField tabulated_points() const override;
  [[nodiscard]] double velocity_scale() const override { return parameters_.lid_velocity; }
  [[nodiscard]] Probe probe() const override { return {Vec2(0.5, 0.5) * parameters_.side, Vec2(1, 0)}; }
  [[nodiscard]] int across() const override { return 1; }
  [[nodiscard]] double length() const override { return parameters_.side; }

 private:
  /// The table for the Reynolds number U L/nu, or for the fluid; empty where there is none.
  [[nodiscard]] std::vector<reference::CavityPoint> published() const;
  /// This project's; null where there is none.
  [[nodiscard]] const CavityTable* own_table() const;

  [[nodiscard]] std::optional<double> reynolds() const;

  LidDrivenCavityParameters parameters_;
};

}  // namespace verification

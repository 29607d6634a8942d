#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/incompressible/wall_shares.hpp"
#include "solver/scene/scene.hpp"

namespace verification {

using mpm::Vec2;

/// How finely a flow is resolved. "Across" is the direction in which the solution varies, "along" the other.
struct Discretisation {
  int cells = 0;  ///< across the flow's characteristic length
  int cells_along = 1;
  int particles_across = 2, particles_along = 2;  ///< a cell
};

/// Unit vector along x (0) or y (1).
inline Vec2 unit(int axis) {
  return axis == 0 ? Vec2(1, 0) : Vec2(0, 1);
}

/// Where a velocity was taken: on the grid field or at a particle.
enum class Location { Grid, Particles };
std::string name(Location location);

/// What a run is compared with.
class ExactField {
 public:
  virtual ~ExactField() = default;
  /// Velocity [m/s] at a point [m] and time [s].
  [[nodiscard]] virtual Vec2 velocity(const Vec2& x, double t, Location location) const = 0;
  /// Shear rate |du/dy| of a channel [1/s]; none for other flows.
  [[nodiscard]] virtual std::optional<double> shear_rate(const Vec2&, double) const { return std::nullopt; }
  /// Density [kg/m3] at a point; none where it is not of interest.
  [[nodiscard]] virtual std::optional<double> density(const Vec2&, double) const { return std::nullopt; }
  /// Pressure of mean zero of an incompressible flow [Pa]; none where it is not of interest.
  [[nodiscard]] virtual std::optional<double> pressure(const Vec2&, double) const { return std::nullopt; }
  /// Where the fluid that is at `start` [m] at t = 0 is at time t [s], not wrapped into the box; none where
  /// no closed form is known.
  [[nodiscard]] virtual std::optional<Vec2> path(const Vec2& start, double t) const {
    static_cast<void>(start), static_cast<void>(t);
    return std::nullopt;
  }
  /// Kinetic energy of the whole scene per unit depth [J/m]; none where it is not known.
  [[nodiscard]] virtual std::optional<double> kinetic_energy(double) const { return std::nullopt; }
  /// One line: what it is, and the error that it states for itself.
  [[nodiscard]] virtual std::string description() const = 0;
};

/// A point that histories follow, and the velocity component recorded there.
struct Probe {
  Vec2 point;      ///< [m]
  Vec2 direction;  ///< unit vector
};

/// A motion exp(-decay_rate t) cos(angular_frequency t + phase).
struct Oscillation {
  double angular_frequency = 0;  ///< [rad/s]
  double decay_rate = 0;         ///< [1/s]
};

/// How a heap of fluid spreads: its front [m] at a time t [s] of the run goes as (age + t)^exponent.
struct Spreading {
  double age = 0;  ///< at t = 0 [s]
  double exponent = 0;
  double front_at_start = 0;  ///< [m]

  [[nodiscard]] double front(double t) const { return front_at_start * std::pow(1 + t / age, exponent); }
};

/// A reference that takes long to compute. Whoever asks for one of the same name that ends no later finds it
/// done.
struct CostlyReference {
  std::string name;
  double end = 0;  ///< [s]
};

/// A flow problem: what is solved, and what the answer is. Adding one: a class here, its reader in the table
/// of flows/flow_reader.cpp.
class Flow {
 public:
  virtual ~Flow() = default;

  /// The solver's scene at a resolution, fluid included.
  [[nodiscard]] virtual mpm::Scene scene(const Discretisation& discretisation) const = 0;

  /// Of walls whose velocity varies along them, for the incompressible method.
  [[nodiscard]] virtual mpm::WallShares wall_shares() const { return {}; }

  /// Whether exact() gives one.
  [[nodiscard]] virtual bool has_exact() const { return true; }
  /// The exact or reference solution of the differential equations, good at the given times [s] and between;
  /// null where none is known. May take seconds to compute, once a process.
  [[nodiscard]] virtual std::shared_ptr<const ExactField> exact(const std::vector<double>& times) const = 0;

  /// The reference that exact() has to compute for these times, where that takes long. None where exact() is
  /// at hand.
  [[nodiscard]] virtual std::optional<CostlyReference> costly_reference(
      const std::vector<double>& times) const {
    static_cast<void>(times);
    return std::nullopt;
  }

  /// Where exact() is known, of flows known at the points of a table alone [m]: there the grid field is
  /// taken, and components of which exact() is NaN are not compared. Empty for flows known everywhere.
  [[nodiscard]] virtual mpm::VectorField tabulated_points() const { return {}; }

  /// The exact solution of the Newtonian USF linear FLIP scheme itself, for steps of dt [s]; null where none
  /// is known.
  [[nodiscard]] virtual std::shared_ptr<const ExactField> exact_discrete(const Discretisation&,
                                                                         double dt) const {
    static_cast<void>(dt);
    return nullptr;
  }

  /// The exact steady nodal values of the linear scheme, for any fluid; null where none are known.
  [[nodiscard]] virtual std::shared_ptr<const ExactField> steady_nodes(const Discretisation&) const {
    return nullptr;
  }

  /// The steady flow of the ideal fluid that a regularised yield stress stands for; null for other fluids.
  [[nodiscard]] virtual std::shared_ptr<const ExactField> ideal() const { return nullptr; }
  /// Edges of the plug in it, along the direction across [m]; none where there is no plug.
  [[nodiscard]] virtual std::optional<std::pair<double, double>> ideal_plug() const { return std::nullopt; }
  /// Largest root mean square velocity [m/s] that the fluid can still have at time t [s], from the one at t =
  /// 0, by an inequality that its equations obey; NaN where none is known.
  [[nodiscard]] virtual double speed_bound(double initial_speed, double t) const {
    static_cast<void>(initial_speed), static_cast<void>(t);
    return std::numeric_limits<double>::quiet_NaN();
  }

  /// Velocity that errors are divided by, unless it changes with time [m/s].
  [[nodiscard]] virtual double velocity_scale() const = 0;
  /// Pressure that pressure errors are divided by [Pa]; NaN where there is none.
  [[nodiscard]] virtual double pressure_scale() const;
  /// How the probe oscillates: freely, or (decay rate 0) as it is driven; none for other flows.
  [[nodiscard]] virtual std::optional<Oscillation> oscillation() const { return std::nullopt; }
  /// How its front spreads; none for other flows.
  [[nodiscard]] virtual std::optional<Spreading> spreading() const { return std::nullopt; }
  /// Time before which a run must end [s], because the solution ends there.
  [[nodiscard]] virtual double latest() const { return std::numeric_limits<double>::infinity(); }
  /// The same at time t [s], for flows that decay or grow [m/s].
  [[nodiscard]] virtual double velocity_scale_at(double t) const {
    static_cast<void>(t);
    return velocity_scale();
  }
  /// Whether shear rate and viscosity across the flow are of interest (channels).
  [[nodiscard]] virtual bool has_shear_profile() const { return false; }
  /// Velocity at the probe in the steady state [m/s]; NaN where there is none.
  [[nodiscard]] virtual double steady_probe() const;
  [[nodiscard]] virtual Probe probe() const = 0;

  /// Direction that the solution varies in: 0 for x, 1 for y. The velocity shown in profiles is
  /// probe().direction.
  [[nodiscard]] virtual int across() const = 0;
  /// Characteristic length [m]: cells are counted along it.
  [[nodiscard]] virtual double length() const = 0;
  /// Points of the line on which the exact solution is drawn.
  [[nodiscard]] std::vector<Vec2> exact_line() const;

  /// Unit of signed particle bias, h^2 F/nu [m/s] for a channel; NaN where it has no meaning.
  [[nodiscard]] virtual double bias_unit(double cell_size) const;
};

}  // namespace verification

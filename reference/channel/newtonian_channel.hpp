#pragma once

#include <string>

#include "reference/channel/channel_solution.hpp"

namespace reference {

/// What drives a Newtonian channel and what resists it. SI units.
struct NewtonianChannelParameters {
  double height = 0.0;               ///< H [m] > 0
  double kinematic_viscosity = 0.0;  ///< nu [m2/s] > 0
  double body_acceleration = 0.0;    ///< F [m/s2], any sign, constant from t = 0
  double plate_velocity = 0.0;       ///< V0 [m/s] of the plate at y = H, any sign, constant from t = 0
};

// The two start-ups, each as the Fourier series (fast for nu t/H^2 large) and as the series of images (fast
// for nu t/H^2 small). Source: Zhou & Sun 2019, Eqs. 26 and 27, with their misprints put right; the images
// are the Laplace inverses of the same problems (Carslaw & Jaeger). 0 <= y <= H; every series stops when a
// bound on what it leaves out is below 1e-18 of its scale. `t` > 0 for the Fourier series, finite t >= 0 for
// the images. Out-of-range arguments throw std::invalid_argument.

/// Poiseuille start-up, velocity [m/s], Fourier series.
double poiseuille_fourier(double y, double t, double height, double nu, double body_acceleration);
/// Poiseuille start-up, du/dy [1/s], Fourier series.
double poiseuille_fourier_gradient(double y, double t, double height, double nu, double body_acceleration);
/// Poiseuille start-up, velocity [m/s], image series.
double poiseuille_images(double y, double t, double height, double nu, double body_acceleration);
/// Poiseuille start-up, du/dy [1/s], image series.
double poiseuille_images_gradient(double y, double t, double height, double nu, double body_acceleration);
/// Couette start-up, velocity [m/s], Fourier series.
double couette_fourier(double y, double t, double height, double nu, double plate_velocity);
/// Couette start-up, du/dy [1/s], Fourier series.
double couette_fourier_gradient(double y, double t, double height, double nu, double plate_velocity);
/// Couette start-up, velocity [m/s], image series.
double couette_images(double y, double t, double height, double nu, double plate_velocity);
/// Couette start-up, du/dy [1/s], image series; at t = 0 infinite at the plate itself.
double couette_images_gradient(double y, double t, double height, double nu, double plate_velocity);

/// Start-up from rest of a Newtonian fluid under a body acceleration and an impulsively started upper plate:
/// the sum of the two exact solutions, images up to nu t/H^2 = 0.1 and Fourier series beyond (either is exact
/// on both sides). Velocities at y = 0 and y = H are 0 and V0 to the last bit. t may be infinite (steady
/// state).
class NewtonianChannel : public ChannelSolution {
 public:
  /// Throws std::invalid_argument for non-positive or non-finite H or nu, or a non-finite F or V0.
  explicit NewtonianChannel(const NewtonianChannelParameters& parameters);

  [[nodiscard]] double velocity(double y, double t) const override;
  [[nodiscard]] double gradient(double y, double t) const override;
  /// Largest |steady u|, inside the gap or at the plate; 0 if nothing drives the flow.
  [[nodiscard]] double steady_maximum() const override { return steady_maximum_; }
  /// Round-off alone: at most about ten terms, none above twice the steady maximum, each good to a few 1e-16.
  [[nodiscard]] double stated_error() const override { return 1e-14; }
  [[nodiscard]] std::string description() const override;

  [[nodiscard]] const NewtonianChannelParameters& parameters() const { return parameters_; }

 private:
  [[nodiscard]] bool early(double t) const;

  NewtonianChannelParameters parameters_;
  double steady_maximum_;
};

}  // namespace reference

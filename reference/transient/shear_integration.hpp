#pragma once

#include <vector>

#include "reference/transient/gradient_history.hpp"
#include "reference/transient/shear_diffusion.hpp"

namespace reference {

/// What the time integration of a ShearDiffusion needs beside the equation itself.
struct ShearIntegration {
  double start_time = 0.0;  ///< [s]
  double end_time = 0.0;    ///< [s], reached or passed by the last step
  double first_step = 0.0;  ///< [s]
  double accurate_from =
      0.0;  ///< [s]: pointwise errors count from here on; before, the error in displacement
  double velocity_scale = 0.0;  ///< [m/s]
  double tolerance = 0.0;       ///< on the extrapolation indicator, see integrate_shear
  double least_rate = 0.0;      ///< [1/s]: gradients' errors are relative to no less: for flows that die out
};

/// Integrates from the nodal gradients `w` at start_time; returns the states after every step (the start
/// itself is left out: it may be a point source, or at rest). Steps are chosen by how far the extrapolated
/// collocation polynomial of the step before misses the new state - a fourth-order quantity, while the
/// method's own error is of order six a step - measured in velocity: its mean over the line from the start,
/// and pointwise as `accurate_from` comes near, with the gradient beside. Throws std::runtime_error if
/// Newton's method fails even with the smallest step.
GradientHistory integrate_shear(const ShearDiffusion& diffusion, const SpectralLine& line,
                                std::vector<double> w, const ShearIntegration& settings);

}  // namespace reference

#pragma once

#include <vector>

#include "reference/channel/channel_problem.hpp"

namespace reference {

/// What finite_volume_channel returns: values at its coarsest mesh's points, and the error it estimates for
/// itself.
struct FiniteVolumeProfile {
  std::vector<double> node_heights;  ///< y [m], plates included
  std::vector<double> velocity;      ///< u [m/s] there
  std::vector<double> face_heights;  ///< y [m] between the nodes
  std::vector<double> gradient;      ///< du/dy [1/s] there
  double velocity_error = 0.0;       ///< [m/s], largest
  double gradient_error = 0.0;       ///< [1/s], largest
};

/// The start-up of a channel at one time (`problem.times` is not looked at), by a second method that shares
/// nothing with TransientChannel but the flow curve: nodal velocities and face stresses of second order on a
/// mesh graded smoothly towards plates and middle, over the whole gap and from the impulsive (or steady)
/// start on; TR-BDF2 on steps graded towards t = 0; and Richardson extrapolation over three levels, each
/// three times as fine as the last in space and time, so that nodes and faces coincide. The error is the
/// difference between the two extrapolations that three levels allow. `cells` and `steps` are those of the
/// coarsest level. Throws std::invalid_argument for a bad problem, t <= 0, cells < 4 or odd, steps < 2;
/// std::runtime_error if Newton's method fails.
FiniteVolumeProfile finite_volume_channel(const ChannelProblem& problem, double t, int cells, int steps);

}  // namespace reference

#include "reference/channel/channel_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reference/require.hpp"

namespace reference {

void ChannelProblem::check() const {
  require(std::isfinite(height) && height > 0.0, "channel: the height must be positive and finite");
  require(std::isfinite(body_acceleration), "channel: the body acceleration must be finite");
  require(std::isfinite(plate_velocity), "channel: the plate velocity must be finite");
  require(std::isfinite(initial_acceleration), "channel: the acceleration before t = 0 must be finite");
  require(initial_acceleration == 0.0 || plate_velocity == 0.0,
          "channel: a flow that begins steady needs plates at rest");
  require(std::isfinite(pull), "channel: the stress that pulls must be finite");
  require(pull == 0.0 || (body_acceleration == 0.0 && plate_velocity == 0.0 && initial_acceleration == 0.0),
          "channel: a side that is pulled goes with no other drive");
  require(pull != 0.0 || body_acceleration != 0.0 || plate_velocity != 0.0 || initial_acceleration != 0.0,
          "channel: nothing drives the flow");
  require(std::all_of(times.begin(), times.end(), [](double t) { return std::isfinite(t) && t >= 0.0; }),
          "channel: times must be finite and not negative");
}

std::string ChannelProblem::describe_flow() const {
  std::string before;
  if (initial_acceleration != 0.0) before = fmt::format("F(t<0)={:.17g} ", initial_acceleration);
  if (pull != 0.0) return fmt::format("H={:.17g} pull={:.17g} {}", height, pull, curve.describe());
  return fmt::format("H={:.17g} F={:.17g} V0={:.17g} {}{}", height, body_acceleration, plate_velocity, before,
                     curve.describe());
}

std::string ChannelProblem::describe() const {
  std::string text = describe_flow() + " t=";
  for (const double t : times) text += fmt::format("{:.17g},", t);
  return text;
}

double ChannelProblem::first_time() const {
  double first = 0.0;
  for (const double t : times) {
    if (t > 0.0 && (first == 0.0 || t < first)) first = t;
  }
  return first;
}

double ChannelProblem::last_time() const {
  return times.empty() ? 0.0 : *std::max_element(times.begin(), times.end());
}

double ChannelProblem::accurate_from() const {
  const double first = first_time();
  if (first == 0.0) return 0.0;
  const double decade = std::pow(10.0, std::floor(std::log10(first)));
  return decade <= first ? decade : 0.1 * decade;
}

}  // namespace reference

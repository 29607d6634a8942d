#include "reference/channel/discrete_usf_channel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/require.hpp"

namespace reference {

DiscreteUsfChannel::DiscreteUsfChannel(const DiscreteUsfChannelParameters& parameters)
    : parameters_(parameters), q_(0.0) {
  const auto& [height, cells, per_cell, nu, force, plate, dt] = parameters_;
  require(std::isfinite(height) && height > 0.0, "discrete channel: the height must be positive and finite");
  require(cells >= 2, "discrete channel: at least two cells are needed");
  require(per_cell >= 1, "discrete channel: at least one particle a cell is needed");
  require(std::isfinite(nu) && nu > 0.0, "discrete channel: the viscosity must be positive and finite");
  require(std::isfinite(force) && std::isfinite(plate), "discrete channel: the drive must be finite");
  require(std::isfinite(dt) && dt > 0.0, "discrete channel: the time step must be positive and finite");

  for (int i = 0; i < per_cell; ++i) {
    const double xi = (i + 0.5) / per_cell;
    q_ += xi * (1.0 - xi) / per_cell;
  }
  for (int m = 0; m < 2 * cells; ++m) {
    // Reduced to the first quarter turn, so that the modes are exactly odd and even where they should be.
    const int half = m % cells;
    const double value = std::sin(std::numbers::pi * std::min(half, cells - half) / cells);
    sine_.push_back(m < cells ? value : -value);
  }

  const double h = height / cells;
  std::vector<double> parabola(cells + 1), start(cells + 1);
  for (int j = 0; j <= cells; ++j) {
    parabola[j] = 0.5 * force / nu * h * h * j * (cells - j);
    steady_.push_back(parabola[j] + plate * j / cells);
    start[j] = (j == cells - 1 ? q_ * plate : 0.0) - steady_[j];
  }
  start_.assign(cells, 0.0);
  parabola_.assign(cells, 0.0);
  for (int k = 1; k < cells; ++k) {
    for (int j = 1; j < cells; ++j) {
      const double mode = 2.0 / cells * sine_[(long(k) * j) % (2 * cells)];
      start_[k] += mode * start[j];
      parabola_[k] += mode * parabola[j];
    }
  }
}

double DiscreteUsfChannel::symbol(int k) const {
  const double s = std::sin(0.5 * std::numbers::pi * k / parameters_.cells);
  return 1.0 - 4.0 * q_ * s * s;
}

double DiscreteUsfChannel::growth(int k, long step) const {
  const double h = parameters_.height / parameters_.cells;
  const double s = std::sin(0.5 * std::numbers::pi * k / parameters_.cells);
  const double x =
      parameters_.time_step * symbol(k) * 4.0 * parameters_.kinematic_viscosity / (h * h) * s * s;
  // log1p keeps a slowly decaying mode exact over very many steps, where powers of the rounded 1 - x would
  // not.
  if (x < 1.0) return std::exp(step * std::log1p(-x));
  const double magnitude = std::pow(x - 1.0, step);
  return step % 2 == 0 ? magnitude : -magnitude;
}

std::vector<double> DiscreteUsfChannel::from_modes(const std::vector<double>& modes) const {
  const int cells = parameters_.cells;
  std::vector<double> nodes(cells + 1, 0.0);
  for (int j = 1; j < cells; ++j) {
    for (int k = 1; k < cells; ++k) nodes[j] += modes[k] * sine_[(long(k) * j) % (2 * cells)];
  }
  return nodes;
}

std::vector<double> DiscreteUsfChannel::node_velocity(long step) const {
  require(step >= 0, "discrete channel: the step must not be negative");
  std::vector<double> modes(start_);
  for (int k = 1; k < parameters_.cells; ++k) modes[k] *= growth(k, step);
  std::vector<double> v = from_modes(modes);
  for (std::size_t j = 0; j < v.size(); ++j) v[j] += steady_[j];
  return v;
}

std::vector<double> DiscreteUsfChannel::particle_velocity(long step) const {
  require(step >= 0, "discrete channel: the step must not be negative");
  const auto& [height, cells, per_cell, nu, force, plate, dt] = parameters_;
  // S leaves the straight line V0 y/H as it is, and what remains of A vanishes at both walls: S is diagonal
  // in modes.
  std::vector<double> modes(cells, 0.0);
  for (int k = 1; k < cells; ++k) modes[k] = (parabola_[k] + start_[k] * growth(k, step)) / symbol(k);
  std::vector<double> a = from_modes(modes);
  for (int j = 0; j <= cells; ++j) a[j] += plate * j / cells;
  std::vector<double> v;
  for (int c = 0; c < cells; ++c) {
    for (int i = 0; i < per_cell; ++i) {
      const double xi = (i + 0.5) / per_cell;
      v.push_back((1.0 - xi) * a[c] + xi * a[c + 1]);
    }
  }
  return v;
}

std::vector<double> DiscreteUsfChannel::particle_height() const {
  std::vector<double> y;
  for (int row = 0; row < parameters_.cells * parameters_.particles_per_cell; ++row) {
    y.push_back((row + 0.5) * parameters_.height / (parameters_.cells * parameters_.particles_per_cell));
  }
  return y;
}

}  // namespace reference

#include "reference/cavity/cavity_features.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace reference {
namespace {

/// Ghia, Ghia & Shin, J. Comput. Phys. 48 (1982) 387, Tables I and II, without the walls.
constexpr std::array ghia_y{0.0547, 0.0625, 0.0703, 0.1016, 0.1719, 0.2813, 0.4531, 0.5,
                            0.6172, 0.7344, 0.8516, 0.9531, 0.9609, 0.9688, 0.9766};
constexpr std::array ghia_x{0.0625, 0.0703, 0.0781, 0.0938, 0.1563, 0.2266, 0.2344, 0.5,
                            0.8047, 0.8594, 0.9063, 0.9453, 0.9531, 0.9609, 0.9688};

template <std::size_t N>
std::vector<double> places(const std::array<double, N>& ghia) {
  std::vector<double> all(ghia.begin(), ghia.end());
  for (int k = 1; k < 16; ++k) all.push_back(k / 16.0);
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

struct Extremum {
  double place, value;
};

/// The least value of a function on (0, 1), by halving steps about the least of many samples and a parabola
/// at the end: a place to some 1e-7.
template <class Function>
Extremum least(const Function& f) {
  double best = 0.5, lowest = std::numeric_limits<double>::infinity();
  double step = 1.0 / 256;
  for (int k = 1; k < 256; ++k)
    if (const double value = f(k * step); value < lowest) lowest = value, best = k * step;
  // Steps of 1e-3, at which six digits of the second difference are there.
  for (int round = 0; round < 40; ++round) {
    const double left = f(best - step), middle = f(best), right = f(best + step);
    const double bend = left - 2 * middle + right;
    if (!(bend > 0)) break;
    const double move = std::clamp(0.5 * step * (left - right) / bend, -step, step);
    best += move;
    if (step > 1e-3)
      step *= 0.5;
    else if (std::abs(move) < 1e-9)
      break;
  }
  return {best, f(best)};
}

/// Where the fluid is at rest, from the least stream function of many places by Newton's method.
std::array<double, 2> vortex(const CavityFlow& flow) {
  Eigen::Vector2d best(0.5, 0.5);
  double lowest = std::numeric_limits<double>::infinity();
  for (int j = 1; j < 32; ++j)
    for (int i = 1; i < 32; ++i)
      if (const double psi = flow.stream(i / 32.0, j / 32.0); psi < lowest)
        lowest = psi, best = {i / 32.0, j / 32.0};
  const auto velocity = [&](const Eigen::Vector2d& at) {
    const auto v = flow.velocity(at.x(), at.y());
    return Eigen::Vector2d(v[0], v[1]);
  };
  constexpr double step = 1e-4;
  for (int round = 0; round < 20; ++round) {
    Eigen::Matrix2d gradient;
    for (const int axis : {0, 1}) {
      const Eigen::Vector2d ahead = step * Eigen::Vector2d::Unit(axis);
      gradient.col(axis) = (velocity(best + ahead) - velocity(best - ahead)) / (2 * step);
    }
    const Eigen::Vector2d move = -gradient.inverse() * velocity(best);
    if (!(move.norm() < 0.1)) break;
    best += move;
    if (move.norm() < 1e-11) return {best.x(), best.y()};
  }
  return {std::nan(""), std::nan("")};
}

}  // namespace

std::vector<CavityFeature> cavity_features(const CavityFlow& flow) {
  std::vector<CavityFeature> features;
  for (const double y : places(ghia_y)) features.push_back({"u", 0.5, y, flow.velocity(0.5, y)[0]});
  for (const double x : places(ghia_x)) features.push_back({"v", x, 0.5, flow.velocity(x, 0.5)[1]});
  const Extremum u_min = least([&](double y) { return flow.velocity(0.5, y)[0]; });
  features.push_back({"u_min", 0.5, u_min.place, u_min.value});
  features.push_back({"u_min_y", 0.5, u_min.place, u_min.place});
  for (const double sign : {-1.0, 1.0}) {
    const Extremum found = least([&](double x) { return sign * flow.velocity(x, 0.5)[1]; });
    const std::string name = sign < 0 ? "v_max" : "v_min";
    features.push_back({name, found.place, 0.5, sign * found.value});
    features.push_back({name + "_x", found.place, 0.5, found.place});
  }
  const auto [x, y] = vortex(flow);
  features.push_back({"psi_min", x, y, flow.stream(x, y)});
  features.push_back({"psi_min_x", x, y, x});
  features.push_back({"psi_min_y", x, y, y});
  return features;
}

}  // namespace reference

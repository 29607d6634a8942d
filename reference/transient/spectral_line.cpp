#include "reference/transient/spectral_line.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/require.hpp"

namespace reference {
namespace {

struct LegendrePair {
  double value;     // P_p
  double previous;  // P_(p-1)
};

LegendrePair legendre_pair(int p, double x) {
  double previous = 1.0, value = x;
  if (p == 0) return {1.0, 0.0};
  for (int k = 2; k <= p; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
    previous = value;
    value = next;
  }
  return {value, previous};
}

}  // namespace

GaussLobatto::GaussLobatto(int p) : degree(p) {
  const int n = p + 1;
  for (int i = 0; i < n; ++i) {
    // The zeros of (1 - x^2) P_p' by Newton from the Chebyshev points: (1-x^2) P_p' = p (P_(p-1) - x P_p),
    // and its derivative is -p (p+1) P_p.
    double x = -std::cos(std::numbers::pi * i / p);
    for (int it = 0; it < 50 && i > 0 && i < p; ++it) {
      const auto [value, previous] = legendre_pair(p, x);
      const double step = (previous - x * value) / ((p + 1) * value);
      x += step;
      if (std::abs(step) < 1e-16) break;
    }
    nodes.push_back(i == 0 ? -1.0 : i == p ? 1.0 : x);
  }
  for (int i = 0; i < n; ++i) {
    nodes[i] = i < p - i ? nodes[i] : (i == p - i ? 0.0 : -nodes[p - i]);
    const double value = legendre_pair(p, nodes[i]).value;
    weights.push_back(2.0 / (p * (p + 1) * value * value));
  }
  derivative.assign(n * n, 0.0);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (i == j) continue;
      derivative[i * n + j] =
          legendre_pair(p, nodes[i]).value / (legendre_pair(p, nodes[j]).value * (nodes[i] - nodes[j]));
      derivative[i * n + i] -= derivative[i * n + j];  // a constant has derivative zero, to the last bit
    }
  }
  // Discrete orthogonality; the quadrature's norm of P_p is 2/p, not 2/(2p+1).
  legendre.assign(n * n, 0.0);
  for (int k = 0; k < n; ++k) {
    const double norm = k < p ? 2.0 / (2 * k + 1) : 2.0 / p;
    for (int j = 0; j < n; ++j) {
      legendre[k * n + j] = weights[j] * legendre_pair(k, nodes[j]).value / norm;
    }
  }
}

SpectralLine::SpectralLine(std::vector<double> sizes, int degree)
    : lobatto_((require(degree >= 2, "spectral line: the degree must be at least 2"), degree)),
      sizes_(std::move(sizes)) {
  require(!sizes_.empty(), "spectral line: at least one element is needed");
  edges_.push_back(0.0);
  nodes_.push_back(0.0);
  mass_.push_back(0.0);
  for (const double h : sizes_) {
    require(h > 0.0, "spectral line: elements must have positive sizes");
    for (int a = 1; a <= degree; ++a) nodes_.push_back(edges_.back() + 0.5 * h * (1.0 + lobatto_.nodes[a]));
    edges_.push_back(edges_.back() + h);
    for (int a = 0; a <= degree; ++a) {
      if (a > 0) mass_.push_back(0.0);
      mass_[mass_.size() - 1] += 0.5 * h * lobatto_.weights[a];
    }
  }
}

SpectralLine::Place SpectralLine::locate(double s) const {
  const auto above = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, s);
  const int e = static_cast<int>(above - edges_.begin()) - 1;
  return {e, std::clamp(2.0 * (s - edges_[e]) / sizes_[e] - 1.0, -1.0, 1.0)};
}

std::vector<double> SpectralLine::coefficients(const double* values) const {
  const int n = lobatto_.degree + 1;
  std::vector<double> c(n, 0.0);
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) c[k] += lobatto_.legendre[k * n + j] * values[j];
  }
  return c;
}

double SpectralLine::interpolate(const double* values, double xi) const {
  const std::vector<double> c = coefficients(values);
  double sum = c[0], previous = 1.0, value = xi;
  for (int k = 1; k < static_cast<int>(c.size()); ++k) {
    sum += c[k] * value;
    const double next = ((2 * k + 1) * xi * value - k * previous) / (k + 1);
    previous = value;
    value = next;
  }
  return sum;
}

double SpectralLine::integrate(const double* values, double xi, double h) const {
  // The integral of P_k from -1 is (P_(k+1) - P_(k-1))/(2k+1), that of P_0 is 1 + xi.
  const std::vector<double> c = coefficients(values);
  double sum = c[0] * (1.0 + xi), previous = 1.0, value = xi;
  for (int k = 1; k < static_cast<int>(c.size()); ++k) {
    const double next = ((2 * k + 1) * xi * value - k * previous) / (k + 1);
    sum += c[k] * (next - previous) / (2 * k + 1);
    previous = value;
    value = next;
  }
  return 0.5 * h * sum;
}

std::vector<double> graded_sizes(double length, double smallest, double largest, double ratio) {
  require(length > 0.0 && smallest > 0.0 && largest > 0.0 && ratio > 1.0,
          "graded sizes: all must be positive");
  std::vector<double> sizes;
  double filled = 0.0;
  for (double h = smallest; filled < length; h *= ratio) {
    sizes.push_back(std::min(h, largest));
    filled += sizes.back();
  }
  // Stretched rather than cut, so that no sliver is left at the far end.
  for (double& h : sizes) h *= length / filled;
  return sizes;
}

}  // namespace reference

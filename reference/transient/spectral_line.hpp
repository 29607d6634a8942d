#pragma once

#include <vector>

namespace reference {

/// Gauss-Lobatto-Legendre points on [-1, 1] and what polynomials of degree p through them need. Matrices are
/// row-major, (p+1) x (p+1).
struct GaussLobatto {
  explicit GaussLobatto(int degree);

  int degree;
  std::vector<double> nodes;       ///< ascending, with -1 and 1
  std::vector<double> weights;     ///< of the quadrature, exact to degree 2p - 1
  std::vector<double> derivative;  ///< values at the nodes -> derivative at the nodes
  std::vector<double> legendre;    ///< values at the nodes -> Legendre coefficients of the interpolant
};

/// An interval [0, length] cut into elements, each carrying a polynomial of one degree: nodal values on
/// `size()` nodes, neighbours sharing theirs. Built from element sizes, so that tiny elements at the origin
/// lose no digits.
class SpectralLine {
 public:
  /// `sizes` [m], from s = 0 on, all positive; degree >= 2. Throws std::invalid_argument otherwise.
  SpectralLine(std::vector<double> sizes, int degree);

  [[nodiscard]] int degree() const { return lobatto_.degree; }
  [[nodiscard]] int elements() const { return static_cast<int>(sizes_.size()); }
  [[nodiscard]] int size() const { return elements() * degree() + 1; }
  [[nodiscard]] double element_size(int e) const { return sizes_[e]; }
  [[nodiscard]] double length() const { return edges_.back(); }
  [[nodiscard]] const GaussLobatto& lobatto() const { return lobatto_; }
  /// Node positions [m].
  [[nodiscard]] const std::vector<double>& nodes() const { return nodes_; }
  /// Quadrature weights at the nodes [m], shared ones added up: the lumped mass.
  [[nodiscard]] const std::vector<double>& mass() const { return mass_; }

  struct Place {
    int element;
    double xi;  // in [-1, 1]
  };
  /// Element and local coordinate of s, clamped to the line.
  [[nodiscard]] Place locate(double s) const;
  /// Value at xi of the interpolant through the p + 1 values of one element.
  [[nodiscard]] double interpolate(const double* values, double xi) const;
  /// Integral of that interpolant over the element from its left end to xi, for an element of size `h`.
  [[nodiscard]] double integrate(const double* values, double xi, double h) const;

 private:
  [[nodiscard]] std::vector<double> coefficients(const double* values) const;

  GaussLobatto lobatto_;
  std::vector<double> sizes_, edges_, nodes_, mass_;
};

/// Element sizes that grow from `smallest` at the origin by the factor `ratio` up to at most `largest`, and
/// fill `length`.
std::vector<double> graded_sizes(double length, double smallest, double largest, double ratio);

}  // namespace reference

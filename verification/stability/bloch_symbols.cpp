#include "verification/stability/bloch_symbols.hpp"

#include <gsl/gsl_integration.h>

#include <cmath>
#include <complex>
#include <memory>

namespace verification {
namespace {

using Complex = std::complex<double>;

/// Cardinal B-spline of a degree, centred at zero (de Boor's recursion for uniform knots).
double spline(int degree, double x) {
  if (degree == 0) return x >= -0.5 && x < 0.5 ? 1 : 0;
  const double half = 0.5 * (degree + 1);
  return ((half + x) * spline(degree - 1, x + 0.5) + (half - x) * spline(degree - 1, x - 0.5)) / degree;
}

double spline_slope(int degree, double x) {
  return spline(degree - 1, x + 0.5) - spline(degree - 1, x - 0.5);
}

/// One axis at one particle: sums over nodes j of exp(i theta j) times the function, its slope, its distance
/// to the particle, and the second moment of the functions.
struct AxisSums {
  Complex value, slope, offset;
  double second_moment;
};

AxisSums axis_sums(int degree, double x, double theta) {
  // Nodes stand on cell corners for odd degrees and in the middle of cells for even ones.
  const double shift = degree % 2 == 0 ? 0.5 : 0;
  AxisSums sums{0, 0, 0, 0};
  const int centre = static_cast<int>(std::floor(x));
  for (int j = centre - degree - 1; j <= centre + degree + 1; ++j) {
    const double distance = j + shift - x;
    const Complex phase = std::polar(1.0, theta * j);
    const double n = spline(degree, -distance);
    sums.value += n * phase;
    sums.slope += spline_slope(degree, -distance) * phase;
    sums.offset += n * distance * phase;
    sums.second_moment += n * distance * distance;
  }
  return sums;
}

struct Seat {
  double position, weight;
};

std::vector<Seat> seats(int count, bool gauss, double offset) {
  std::vector<Seat> list;
  if (gauss) {
    const std::unique_ptr<gsl_integration_glfixed_table, decltype(&gsl_integration_glfixed_table_free)> table(
        gsl_integration_glfixed_table_alloc(static_cast<std::size_t>(count)),
        gsl_integration_glfixed_table_free);
    for (int i = 0; i < count; ++i) {
      Seat seat{};
      gsl_integration_glfixed_point(0, 1, static_cast<std::size_t>(i), &seat.position, &seat.weight,
                                    table.get());
      list.push_back({seat.position + offset, seat.weight});
    }
    return list;
  }
  for (int i = 0; i < count; ++i) list.push_back({(i + 0.5) / count + offset, 1.0 / count});
  return list;
}

}  // namespace

std::array<double, 2> ParticleLattice::period() const {
  return {gauss ? 1.0 : 1.0 / per_cell[0], gauss ? 1.0 : 1.0 / per_cell[1]};
}

BlochSymbols bloch_symbols(mpm::Scheme::Basis basis, const ParticleLattice& lattice,
                           const std::array<double, 2>& theta) {
  const int degree = 1 + static_cast<int>(basis);
  BlochSymbols symbols{0, 0, 0, Eigen::Matrix2cd::Zero(), Eigen::Matrix2cd::Zero()};
  struct Row {
    double weight;
    AxisSums sums;
  };
  std::vector<Row> along_y;
  for (const Seat& seat : seats(lattice.per_cell[1], lattice.gauss, lattice.offset[1]))
    along_y.push_back({seat.weight, axis_sums(degree, seat.position, theta[1])});
  for (const Seat& seat_x : seats(lattice.per_cell[0], lattice.gauss, lattice.offset[0])) {
    const AxisSums x = axis_sums(degree, seat_x.position, theta[0]);
    for (const auto& [weight_y, y] : along_y) {
      const double mass = seat_x.weight * weight_y;  // and volume, the density being one
      const Complex n = x.value * y.value;
      const Eigen::Vector2cd g(x.slope * y.value, x.value * y.slope);
      symbols.consistent_mass += mass * std::norm(n);

      // A row of C_p is u times `affine`: the gradient for the linear basis, B D^-1 else; P2G then weighs the
      // offsets x_i - x_p once more.
      const Eigen::Vector2cd offset(x.offset * y.value, x.value * y.offset);
      Eigen::Vector2cd affine = g;
      if (degree > 1) affine = Eigen::Vector2cd(offset[0] / x.second_moment, offset[1] / y.second_moment);
      symbols.affine_remap += mass * (std::norm(n) + offset.dot(affine).real());

      // sigma grad N with L = u g^T: (u g^T + g u^T - 2/3 (g.u) I) conj(g), the virtual work of a wave.
      symbols.viscous += mass * (g.squaredNorm() * Eigen::Matrix2cd::Identity() + g * g.adjoint() -
                                 2.0 / 3.0 * g.conjugate() * g.transpose());
      symbols.dilation += mass * g.conjugate() * g.transpose();
    }
  }
  symbols.remap = symbols.consistent_mass;  // the lumped mass of every node is one
  return symbols;
}

}  // namespace verification

#include "verification/stability/amplification.hpp"

#include <gsl/gsl_eigen.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <numbers>

#include "reference/gsl_quiet.hpp"
#include "verification/config/config_error.hpp"

namespace verification {
namespace {

using Scheme = mpm::Scheme;
using Vector = Eigen::Vector2cd;

/// What one step carries to the next.
struct WaveState {
  Vector u = Vector::Zero();  ///< nodal velocity of the particles
  Vector q = Vector::Zero();  ///< nodal force of the densities, over c^2
  Vector s = Vector::Zero();  ///< viscous nodal force of the stress that particles hold (USL, MUSL)
};

/// One time step on symbols, dt being one; the steps repeat those of the literature that solver/ implements.
class WaveStep {
 public:
  WaveStep(const Scheme& scheme, const BlochSymbols& symbols, const StepSize& step)
      : scheme_(scheme),
        symbols_(symbols),
        step_(step),
        full_mass_(scheme.transfer == Scheme::Transfer::FullMass),
        keeps_(scheme.transfer == Scheme::Transfer::Flip || scheme.transfer == Scheme::Transfer::FlipBlend),
        mass_(full_mass_ ? symbols.consistent_mass : 1) {
    if (scheme.stepping == Scheme::Stepping::ImplicitEuler) factorise(1);
    if (scheme.stepping == Scheme::Stepping::ImplicitSdirk2) factorise(gamma);
  }

  [[nodiscard]] WaveState operator()(const WaveState& old) const {
    switch (scheme_.stepping) {
      case Scheme::Stepping::Usf:
        return usf(old);
      case Scheme::Stepping::Usl:
      case Scheme::Stepping::Musl:
        return stress_last(old);
      case Scheme::Stepping::Leapfrog:
        return leapfrog(old);
      case Scheme::Stepping::ImplicitEuler:
        return implicit_euler(old);
      case Scheme::Stepping::ImplicitSdirk2:
        return implicit_sdirk2(old);
    }
    return old;
  }

 private:
  static constexpr double gamma = 1 - 0.5 * std::numbers::sqrt2;  // of SDIRK2

  [[nodiscard]] Vector viscous(const Vector& u) const { return -step_.r * (symbols_.viscous * u); }
  [[nodiscard]] Vector pressure(const Vector& q) const { return step_.cfl * step_.cfl * q; }
  [[nodiscard]] Vector compressed(const Vector& q, const Vector& u, double dt) const {
    return q - dt * (symbols_.dilation * u);
  }
  [[nodiscard]] Vector acceleration(const Vector& force) const { return force / mass_; }

  /// The particles take the grid's end velocity or its increment; what the next P2G makes of it.
  [[nodiscard]] Vector taken(const Vector& begin, const Vector& end) const {
    const Vector flip = begin + symbols_.remap * (end - begin), pic = symbols_.remap * end;
    switch (scheme_.transfer) {
      case Scheme::Transfer::Flip:
        return flip;
      case Scheme::Transfer::Pic:
        return pic;
      case Scheme::Transfer::FlipBlend:
        return scheme_.flip_fraction * flip + (1 - scheme_.flip_fraction) * pic;
      case Scheme::Transfer::Apic:
        return symbols_.affine_remap * end;
      case Scheme::Transfer::FullMass:
        return end;
    }
    return end;
  }

  [[nodiscard]] WaveState usf(const WaveState& old) const {
    WaveState next;
    next.q = compressed(old.q, old.u, 1);
    const Vector end = old.u + acceleration(viscous(old.u) + pressure(next.q));
    next.u = taken(old.u, end);
    return next;
  }

  [[nodiscard]] WaveState stress_last(const WaveState& old) const {
    WaveState next;
    const Vector end = old.u + acceleration(old.s + pressure(old.q));
    next.u = taken(old.u, end);
    const Vector strains = scheme_.stepping == Scheme::Stepping::Musl ? next.u : end;
    next.q = compressed(old.q, strains, 1);
    next.s = viscous(strains);
    return next;
  }

  [[nodiscard]] WaveState leapfrog(const WaveState& old) const {
    WaveState next;
    const Vector q = compressed(old.q, old.u, 0.5);
    Vector stage = acceleration(viscous(old.u) + pressure(q));
    if (keeps_) stage *= symbols_.remap;
    const Vector middle = old.u + 0.5 * stage;
    const Vector end = old.u + acceleration(viscous(middle) + pressure(q));
    next.u = taken(old.u, end);
    next.q = compressed(q, keeps_ ? next.u : end, 0.5);
    return next;
  }

  void factorise(double dt) {
    inverse_ = (mass_ * Eigen::Matrix2cd::Identity() + dt * step_.r * symbols_.viscous).inverse();
  }
  /// M (v - start) = dt (force - nu K v), for the dt of the inverse.
  [[nodiscard]] Vector implicit(const Vector& start, const Vector& force, double dt) const {
    return inverse_ * (mass_ * start + dt * force);
  }

  [[nodiscard]] WaveState implicit_euler(const WaveState& old) const {
    WaveState next;
    next.q = compressed(old.q, old.u, 1);
    next.u = taken(old.u, implicit(old.u, pressure(next.q), 1));
    return next;
  }

  [[nodiscard]] WaveState implicit_sdirk2(const WaveState& old) const {
    WaveState next;
    const Vector q = compressed(old.q, old.u, 0.5);
    const Vector first = implicit(old.u, pressure(q), gamma);
    const Vector stage = old.u + (1 - gamma) / gamma * (first - old.u);
    const Vector end = implicit(stage, pressure(q), gamma);
    next.u = taken(old.u, end);
    next.q = compressed(q, keeps_ ? next.u : end, 0.5);
    return next;
  }

  Scheme scheme_;
  const BlochSymbols& symbols_;
  StepSize step_;
  bool full_mass_, keeps_;
  double mass_;
  Eigen::Matrix2cd inverse_;  // of the implicit steppings
};

/// In modulus, of A + i B: those of the real matrix (A, -B; B, A) are its own and their conjugates. GSL,
/// which has no complex matrices that are not Hermitian; Eigen's take five seconds to compile.
double largest_eigenvalue(const Amplification& matrix) {
  const Eigen::Index n = matrix.rows();
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, 12, 12> real(2 * n, 2 * n);
  real << matrix.real(), -matrix.imag(), matrix.imag(), matrix.real();
  std::array<double, 24> values{};  // real and imaginary parts in turn
  const auto size = static_cast<std::size_t>(2 * n);
  gsl_matrix_view of_matrix = gsl_matrix_view_array(real.data(), size, size);
  gsl_vector_complex_view of_values = gsl_vector_complex_view_array(values.data(), size);
  const std::unique_ptr<gsl_eigen_nonsymm_workspace, decltype(&gsl_eigen_nonsymm_free)> room(
      gsl_eigen_nonsymm_alloc(size), &gsl_eigen_nonsymm_free);
  reference::quiet_gsl();
  if (gsl_eigen_nonsymm(&of_matrix.matrix, &of_values.vector, room.get()) != GSL_SUCCESS)
    return std::numeric_limits<double>::infinity();  // unknown: no step may count as stable by it
  double largest = 0;
  for (std::size_t k = 0; k < size; ++k)
    largest = std::max(largest, std::hypot(values[2 * k], values[2 * k + 1]));
  return largest;
}

/// A power of a matrix, filled up with zeros to the size of the largest; by real and imaginary parts:
/// products of complex numbers would look for infinities.
class Power {
 public:
  explicit Power(const Amplification& matrix) {
    real_.topLeftCorner(matrix.rows(), matrix.cols()) = matrix.real();
    imaginary_.topLeftCorner(matrix.rows(), matrix.cols()) = matrix.imag();
  }

  void square() {
    const Part real = real_ * real_ - imaginary_ * imaginary_;
    imaginary_ = (real_ * imaginary_ + imaginary_ * real_).eval();
    real_ = real;
  }
  [[nodiscard]] double norm() const { return std::sqrt(real_.squaredNorm() + imaginary_.squaredNorm()); }
  [[nodiscard]] double trace() const { return std::hypot(real_.trace(), imaginary_.trace()); }

 private:
  using Part = Eigen::Matrix<double, 6, 6>;
  Part real_ = Part::Zero(), imaginary_ = Part::Zero();
};

}  // namespace

std::string name(Waves waves) {
  switch (waves) {
    case Waves::Shear:
      return "shear";
    case Waves::Longitudinal:
      return "longitudinal";
    default:
      return "plane";
  }
}

Waves waves_named(const std::string& text) {
  for (const Waves waves : {Waves::Shear, Waves::Longitudinal, Waves::Plane})
    if (name(waves) == text) return waves;
  throw ConfigError("waves '" + text + "' are not known; choose of: shear, longitudinal, plane");
}

Amplification amplification_matrix(const Scheme& scheme, const BlochSymbols& symbols, Waves waves,
                                   const StepSize& step) {
  const int first = waves == Waves::Longitudinal ? 1 : 0, last = waves == Waves::Shear ? 0 : 1;
  const bool carries_stress =
      step.r > 0 && (scheme.stepping == Scheme::Stepping::Usl || scheme.stepping == Scheme::Stepping::Musl);
  std::array<Vector WaveState::*, 3> fields{&WaveState::u};
  std::size_t count = 1;
  if (step.cfl > 0) fields[count++] = &WaveState::q;
  if (carries_stress) fields[count++] = &WaveState::s;

  const WaveStep advance(scheme, symbols, step);
  const int per_field = last - first + 1;
  const auto size = static_cast<Eigen::Index>(count) * per_field;
  Amplification matrix(size, size);
  for (Eigen::Index column = 0; column < size; ++column) {
    WaveState unit;
    (unit.*fields[static_cast<std::size_t>(column / per_field)])[first + column % per_field] = 1;
    const WaveState image = advance(unit);
    for (Eigen::Index row = 0; row < size; ++row)
      matrix(row, column) =
          (image.*fields[static_cast<std::size_t>(row / per_field)])[first + row % per_field];
  }
  return matrix;
}

double spectral_radius(const Amplification& matrix) {
  if (!matrix.allFinite()) return std::numeric_limits<double>::infinity();
  if (matrix.rows() == 1) return std::abs(matrix(0, 0));
  if (matrix.rows() == 2) {  // most waves along a line: by the quadratic, a tenth of the general cost
    const std::complex<double> mean = 0.5 * (matrix(0, 0) + matrix(1, 1)),
                               half = 0.5 * (matrix(0, 0) - matrix(1, 1)),
                               root = std::sqrt(half * half + matrix(0, 1) * matrix(1, 0));
    return std::max(std::abs(mean + root), std::abs(mean - root));
  }
  return largest_eigenvalue(matrix);
}

bool grows(const Amplification& matrix, double allowance) {
  // rho^m <= |A^m|, and |tr A^m| <= n rho^m. What is computed lies within `error` of A^m, all in Frobenius'
  // norm: squaring takes the error along, and adds round-off of twelve products an entry in real and
  // imaginary parts.
  constexpr double round_off = 16 * std::numeric_limits<double>::epsilon(), most_error = 0.1;
  if (matrix.rows() > 2 && matrix.allFinite()) {
    const auto n = static_cast<double>(matrix.rows());
    Power power(matrix);
    double error = 0;
    for (double m = 1; m <= 65536 && error < most_error; m *= 2) {
      const double norm = power.norm();
      if (norm + error < 1) return false;
      if (power.trace() - std::sqrt(n) * error > n * std::pow(1 + allowance, m)) return true;
      error = (2 * norm + error) * error + round_off * norm * norm;
      power.square();
    }
  }
  return spectral_radius(matrix) > 1 + allowance;
}

}  // namespace verification

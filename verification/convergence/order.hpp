#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace verification {

/// How a refinement ladder behaves. A ladder is classified before an order is fitted to it.
enum class Convergence {
  Monotone,     ///< the errors, or the differences of a functional, shrink without changing sign
  Oscillatory,  ///< the differences of a functional shrink and alternate in sign
  Divergent,    ///< they do not shrink
  Floor,        ///< too few levels lie clear of the floor (round-off, time error) to observe an order
  Invalid       ///< a NaN or an infinity in the data
};

/// "monotone", "oscillatory", "divergent", "floor" or "invalid".
std::string_view to_string(Convergence convergence);

/// Every ladder here runs from coarse to fine: `steps` (cell size h in m, or time step dt in s) are positive,
/// finite and strictly decreasing. Throws std::invalid_argument otherwise, or if fewer than `minimum`;
/// `caller` opens the message.
void check_ladder(const std::vector<double>& steps, std::size_t minimum, std::string_view caller);

/// Behaviour of a solution functional phi on three or more grids without an exact value (coarse to fine).
///
/// For each triplet (fine 1, medium 2, coarse 3): R = e21/e32, e21 = phi_2 - phi_1, e32 = phi_3 - phi_2;
/// 0 < R < 1 monotone, -1 < R < 0 oscillatory, else divergent (Celik et al., J. Fluids Eng. 130 (2008)
/// 078001; Roache). |e21| <= floor is Floor. Of several triplets the worst counts (Invalid, Divergent, Floor,
/// Oscillatory, Monotone). The bound R < 1 supposes one constant refinement ratio.
/// Throws std::invalid_argument for fewer than three values or a floor that is negative or not finite.
Convergence classify_functional(const std::vector<double>& values, double floor = 0.0);

/// The same for any refinement ratios: monotone then means 0 < R < ln r21 / ln r32, which is p > 0 exactly
/// (and R < 1 for a constant ratio). Throws as check_ladder(), and if the sizes differ.
Convergence classify_functional(const std::vector<double>& steps, const std::vector<double>& values,
                                double floor = 0.0);

/// Behaviour of errors against an exact solution, coarse to fine: Monotone if strictly decreasing, else
/// Divergent; Invalid with a NaN or infinity; Floor with fewer than two errors above zero.
/// Throws std::invalid_argument for a negative error.
Convergence classify_errors(const std::vector<double>& errors);

/// Settings of the order fits.
struct OrderOptions {
  double floor = 0.0;          ///< error that remains at zero step, in the unit of the errors; >= 0
  double floor_factor = 10.0;  ///< a level with error <= floor_factor * floor is dropped; >= 1
  double confidence = 0.95;    ///< two-sided confidence of the interval, in (0, 1)
};

/// Observed order of convergence.
struct OrderEstimate {
  Convergence convergence = Convergence::Invalid;
  double order;                  ///< least-squares order; NaN for Floor and Invalid
  double lower;                  ///< confidence interval of `order`; NaN if has_interval is false
  double upper;                  ///< see lower
  bool has_interval;             ///< false with fewer than three used levels: no degree of freedom is left
  double log_coefficient;        ///< ln C of the fitted e = C h^p; NaN for Floor and Invalid
  std::vector<double> pairwise;  ///< order of each neighbouring pair of levels, used or not; NaN if undefined
  std::vector<bool> used;        ///< per level: took part in the fit
  std::size_t used_count = 0;    ///< number of used levels
};

/// Order of errors against an exact solution, e = C h^p: slope of ln e on ln h by least squares, with the
/// confidence interval of the slope from Student's t with n - 2 degrees of freedom (simple linear regression,
/// e.g. Montgomery & Runger, Applied Statistics and Probability for Engineers, 11-5).
///
/// `steps`: coarse to fine, any ratios; `errors`: >= 0, one a step.
/// A NaN or an infinity anywhere gives Invalid and order NaN. Levels at the floor (an error of exactly zero
/// always is) are dropped; with fewer than two left the result is Floor and order NaN. If the used errors do
/// not strictly decrease the result is Divergent; its slope is still given. The interval speaks of scatter
/// about a straight line only: the bias of a ladder that is not yet asymptotic is outside it. Throws
/// std::invalid_argument for a bad ladder (check_ladder, at least 2), sizes that differ, a negative error or
/// bad options.
OrderEstimate estimate_order(const std::vector<double>& steps, const std::vector<double>& errors,
                             const OrderOptions& options = {});

/// The coarser step of each neighbouring pair: the abscissa for successive differences. Only if the ratio of
/// neighbouring steps is constant do differences |u_k - u_k+1| = C (dt_k^p - dt_k+1^p) have the slope p
/// over it; for other ladders use estimate_order_from_differences().
/// Throws std::invalid_argument for a bad ladder (check_ladder, at least 2).
std::vector<double> successive_steps(const std::vector<double>& steps);

/// Order from norms of successive differences, d_k = |u_k - u_k+1| on `steps` k and k+1 (one difference fewer
/// than steps), without an exact solution: on one mesh the space error cancels and the time order remains.
///
/// Fits ln d_k = c + ln|dt_k^p - dt_k+1^p| for p and c by least squares, exactly for any ratios; for a
/// constant ratio this is the regression of estimate_order() on successive_steps(). The interval is
/// linearised about the solution. `pairwise` (one fewer than the differences) holds the p that two
/// neighbouring differences give. Monotone if every neighbouring pair of used differences has p > 0, else
/// Divergent. Flags and dropping as in estimate_order(), per difference. Throws std::invalid_argument as
/// estimate_order(), with at least 3 steps.
OrderEstimate estimate_order_from_differences(const std::vector<double>& steps,
                                              const std::vector<double>& differences,
                                              const OrderOptions& options = {});

/// Order p from three grids with ratios r21, r32 > 1 and ratio |e32/e21| > 0 of their differences: the root
/// of
///   |e32/e21| = r21^p (r32^p - s) / (r21^p - s),  s = +1 monotone, s = -1 oscillatory,
/// which is Celik et al. (2008), eqs. (5)-(7), solved by bracketing instead of fixed-point iteration. The
/// right side increases with p for either s, so the root is unique; it is negative for a divergent ladder
/// (Celik's absolute value would hide that). Throws std::invalid_argument for arguments outside these ranges.
double three_grid_order(double r21, double r32, double difference_ratio, int sign);

}  // namespace verification

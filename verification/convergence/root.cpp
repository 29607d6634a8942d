#include "verification/convergence/root.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

#include <cmath>
#include <limits>
#include <memory>

#include "verification/not_a_number.hpp"

namespace verification {

namespace {

double call(double x, void* function) {
  return (*static_cast<const std::function<double(double)>*>(function))(x);
}

}  // namespace

double find_root(const std::function<double(double)>& function, double guess, double width) {
  for (int doubling = 0; doubling < 20; ++doubling, width *= 2.0) {
    const double root = find_root_between(function, guess - width, guess + width);
    if (!std::isnan(root)) return root;
  }
  return nan;
}

double find_root_between(const std::function<double(double)>& function, double lower, double upper) {
  const double at_lower = function(lower);
  const double at_upper = function(upper);
  if (at_lower == 0.0) return lower;
  if (at_upper == 0.0) return upper;
  // GSL would call its error handler, which aborts by default, for a bracket without a sign change.
  if (!std::isfinite(at_lower) || !std::isfinite(at_upper) || (at_lower < 0.0) == (at_upper < 0.0))
    return nan;

  gsl_function target{&call, const_cast<std::function<double(double)>*>(&function)};
  const std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), &gsl_root_fsolver_free);
  if (gsl_root_fsolver_set(solver.get(), &target, lower, upper) != GSL_SUCCESS) return nan;
  constexpr int most_iterations = 200;
  for (int i = 0; i < most_iterations; ++i) {
    if (gsl_root_fsolver_iterate(solver.get()) != GSL_SUCCESS) return nan;
    const double a = gsl_root_fsolver_x_lower(solver.get());
    const double b = gsl_root_fsolver_x_upper(solver.get());
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    if (std::abs(b - a) <= 4.0 * epsilon * (1.0 + std::abs(a))) break;
  }
  return gsl_root_fsolver_root(solver.get());
}

}  // namespace verification

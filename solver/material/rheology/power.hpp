#pragma once

#include <algorithm>
#include <cmath>

// Its name is enough here: the vector kernels, which have arrays of their own, do without the library.
namespace Eigen {
template <typename Derived>
class ArrayBase;
}

namespace mpm {

// Powers of a non-negative number, for one double or for a whole Eigen array at a time: rheologies are
// compiled for the cheapest that their exponent allows, and no scalar pow is called for a particle.

struct SquareRoot {
  template <class Real>
  Real operator()(const Real& x) const {
    using std::sqrt;
    return sqrt(x);
  }
};

struct RealPower {
  double exponent = 0;

  template <class Real>
  Real operator()(const Real& x) const {
    using std::exp;
    using std::log;
    return exp(exponent * log(x));
  }
};

/// max(x, bound), element by element.
inline double at_least(double x, double bound) {
  return std::max(x, bound);
}
template <class Derived>
typename Derived::PlainObject at_least(const Eigen::ArrayBase<Derived>& x, double bound) {
  return x.max(bound);
}

/// a where x < bound, else b, element by element.
inline double choose_below(double x, double bound, double a, double b) {
  return x < bound ? a : b;
}
template <class Derived>
typename Derived::PlainObject choose_below(const Eigen::ArrayBase<Derived>& x, double bound,
                                           const typename Derived::PlainObject& a,
                                           const typename Derived::PlainObject& b) {
  return (x < bound).select(a, b);
}

}  // namespace mpm

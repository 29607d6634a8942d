#pragma once

#include <functional>

namespace verification {

/// Root of a continuous function of one variable by GSL's Brent method, to the last few digits. The bracket
/// is sought around `guess`, `width` to either side at first and doubled until the sign changes. NaN if no
/// sign change is found within |x - guess| of about 1e6 width, or if the function yields a NaN there.
double find_root(const std::function<double(double)>& function, double guess, double width);

/// The same in a given bracket [lower, upper]; NaN if the signs at its ends do not differ.
double find_root_between(const std::function<double(double)>& function, double lower, double upper);

}  // namespace verification

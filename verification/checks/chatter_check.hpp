#pragma once

#include "verification/checks/check_reader.hpp"

namespace verification {

/// Shear rate [1/s] below which explicit steps of a power law chatter: where its tangent viscosity
/// n nu_0 gdot^(n-1) makes nu dt/h^2 exceed the limit r, gdot_crit = (r h^2/(n nu_0 dt))^(1/(n-1)), n < 1.
/// h [m], dt [s], nu_0 [m2/s] at 1/s.
double critical_shear_rate(double limit, double h, double dt, double nu, double index);

/// Largest shear rate [1/s] of a cell that chatters at time t: one at which the difference of shear rates
/// between `run` and `calm`, a run on the same mesh without a viscous limit, swings from cell to cell by more
/// than `amplitude` [1/s], that is |d_(j-1) - 2 d_j + d_(j+1)|/4 does, which smooth differences pass. The
/// rate is that of `calm`. 0 when no cell chatters; NaN without samples.
double chattering_shear_rate(const RunData& run, const RunData& calm, double t, double amplitude);

/// Adds the kind "chatter": the band of shear rates in which explicit steps of a power law with n < 1
/// chatter, in units of gdot_crit. Keys: against (an implicit variant), t, stability_limit, lower, upper.
void add_chatter_kind(std::vector<CheckKind>& kinds);

}  // namespace verification

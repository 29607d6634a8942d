#pragma once

#include <variant>

#include "solver/material/rheology/carreau_yasuda.hpp"
#include "solver/material/rheology/cross.hpp"
#include "solver/material/rheology/herschel_bulkley.hpp"
#include "solver/material/rheology/newtonian.hpp"
#include "solver/material/rheology/power_law.hpp"

namespace mpm {

// A rheology policy says whether it needs the shear rate at all, and gives the dynamic viscosity [Pa s] from
// gdot^2 = 2 D:D [1/s2], for one particle or for an array of them, and the largest viscosity that an explicit
// step must resolve. The stress update is compiled once for each, so that a Newtonian scene computes neither
// shear rate nor viscosity.

/// Every fluid that the solver knows. Adding one: a short file in rheology/, its name here.
using Rheology =
    std::variant<Newtonian, Cross<SquareRoot>, Cross<RealPower>, PowerLaw, CarreauYasuda, HerschelBulkley>;

}  // namespace mpm

#pragma once

#include "solver/grid/axis.hpp"
#include "solver/kernel/full_mass/full_mass_kernel.hpp"

namespace mpm {

/// What a line's mass matrix is, and the matrix T of 2 reach + 1 diagonals that comes nearest to its inverse:
/// column by column the least |I - M T|. Entries of the inverse itself fall off with the distance from the
/// diagonal by 0.27, 0.43 and 0.54 a node for degree 1 to 3; cut off at the same reach it leaves 2.3 times as
/// much for degree 3. A longer reach costs more than the iterations that it saves. Where walls prescribe the
/// values of their functions, these are left out: the solves are for the others.
LineMass line_mass(const Axis& axis, bool walls_prescribe);

}  // namespace mpm

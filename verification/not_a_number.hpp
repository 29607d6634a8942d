#pragma once

#include "reports/records/not_a_number.hpp"

namespace verification {

using reports::nan;

}  // namespace verification

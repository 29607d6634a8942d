#pragma once

#include "verification/checks/check_reader.hpp"

namespace verification {

/// Adds the kind that a [scoreboard] implies: one check a scheme, that what became of it is what the study
/// declared. An unexpected survival fails like an unexpected failure.
void add_outcome_kind(std::vector<CheckKind>& kinds);

}  // namespace verification

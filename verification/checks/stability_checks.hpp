#pragma once

#include "verification/checks/check_reader.hpp"

namespace verification {

/// Adds the kinds of a study with [stability]:
///   stability-limit   measured over predicted limit of every scheme, waves, motion and ray in a band; where
///                     nothing is predicted to grow, nothing may; a stream just below is stable throughout
///   automatic-step    measured limit over the step that mpm::automatic_time_step() takes on the ray
///   published-limit   a limit on one ray equals a published number, as predicted and as measured
void add_stability_kinds(std::vector<CheckKind>& kinds);

/// Whether a kind is one of these.
bool is_stability_kind(const std::string& kind);

}  // namespace verification

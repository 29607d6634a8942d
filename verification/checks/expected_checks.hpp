#pragma once

#include <optional>

#include "verification/study/study.hpp"

namespace verification {

/// How many checks a [[check]] makes, known from the study alone; none for limits of stability, whose number
/// depends on what is found. A kind that is not counted here is an error of ours (std::logic_error).
std::optional<std::size_t> expected_checks(const CheckSpec& spec, const Study& study);

/// Values that a [validation] compares: each is a check of its own.
std::size_t expected_gates(const Study& study);

/// Checks of the whole study, with those of [validation] and the one that every run completes; none where any
/// part has none.
std::optional<std::size_t> expected_checks(const Study& study);

/// Whether the study says itself which of its runs break down.
bool declares_fate(const Study& study);

}  // namespace verification

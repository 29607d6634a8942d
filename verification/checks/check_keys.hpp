#pragma once

#include "verification/runs/run_data.hpp"

namespace verification {

// Keys that several kinds of checks read, and how they choose runs.

/// An upper bound must be given; the lower one is `lower` if absent.
void require_upper(TomlTable& table, CheckSpec& spec, double lower);
/// Both bounds must be given.
void require_band(TomlTable& table);
void read_locations(TomlTable& table, const Study& study, CheckSpec& spec);
void read_norm(TomlTable& table, CheckSpec& spec);
/// `times`, each an output time of every run spoken of; all of them if absent.
void read_times(TomlTable& table, const Study& study, CheckSpec& spec);
/// `level` = "finest", "coarsest", "all", or the end of a run's name, e.g. "n20".
void read_level(TomlTable& table, const Study& study, CheckSpec& spec);
/// `against`: another variant.
void read_against(TomlTable& table, const Study& study, CheckSpec& spec);

/// `relative_to`: what errors are judged against, in place of the flow's own scale.
void read_scale(TomlTable& table, CheckSpec& spec);

/// A scale this many times the fastest exact velocity of its time hides errors.
inline constexpr double large_scale = 3;
/// The check's norm of an error, relative to what the check says.
double relative_error(const CheckSpec& spec, const RunData& run, const reports::ErrorRecord& error);
/// The check with a word on its scale, where that is not the usual one or hides errors.
CheckSpec with_scale(CheckSpec spec, const reports::ErrorRecord& error);

/// Runs of a variant at the level chosen.
std::vector<const RunData*> levels_of(const CheckSpec& spec, const StudyData& data,
                                      const std::string& variant);
/// "variant: ", or "" where the study has none.
std::string label(const std::string& variant);
/// "variant.n20: " where a check speaks of several levels or of one by its name.
std::string label(const CheckSpec& spec, const RunData& run);

/// Adds the kinds that compare scalars: scalar, ordering, ratio, crossing (checks/quantity_checks.cpp).
void add_quantity_kinds(std::vector<struct CheckKind>& kinds);

/// Whether a run is at the level that run names end with, e.g. "n20".
bool is_level(const PlannedRun& run, const std::string& tag);

}  // namespace verification

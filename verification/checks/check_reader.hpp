#pragma once

#include "verification/runs/run_data.hpp"

namespace verification {

/// A kind of check: which keys it reads and what it observes. Adding one: two functions, one line in the
/// table.
struct CheckKind {
  const char* name;
  void (*read)(TomlTable& table, const Study& study, CheckSpec& spec);
  void (*evaluate)(const CheckSpec& spec, const StudyData& data, std::vector<reports::CheckRecord>& records);
};

/// What a check reads of every run that it speaks of.
std::vector<Record> records_of(const CheckSpec& spec);

/// All kinds (checks/check_kinds.cpp).
const std::vector<CheckKind>& check_kinds();

/// Reads one [[check]]: kind, reason, bounds, variants, and the keys of its kind. Throws ConfigError.
CheckSpec read_check(TomlTable& table, const Study& study);

/// Judges every check of the study, and that each run completed unless a check says what else should become
/// of it.
void evaluate_checks(StudyData& data);

/// Fails the study if it has made another number of checks, those of [validation] included, than it says, or
/// than it must by its [[check]]s.
void require_all_checks(StudyData& data);

/// lower <= observed <= upper; a NaN fails.
reports::CheckRecord judge(const CheckSpec& spec, const StudyData& data, const std::string& check,
                           double observed, const std::string& unit);

}  // namespace verification

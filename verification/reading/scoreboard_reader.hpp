#pragma once

#include "verification/study/study.hpp"

namespace verification {

/// Reads [scoreboard] and [[expect]] of a study whose variants are known, and adds the check of kind
/// "outcome" that judges them. Throws ConfigError: a part of a scheme that is not known, a scheme of which
/// nothing is expected, an expectation without a reason or of no scheme.
void read_scoreboard(TomlTable& root, Study& study);

/// What of a study runs in a suite: all of it, or, of a scoreboard case that belongs to a greater suite, the
/// schemes that it names for this one. False when nothing does.
bool restrict_to(Study& study, Suite suite);

}  // namespace verification

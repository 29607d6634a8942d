#pragma once

#include "verification/study/study.hpp"

namespace verification {

/// Reads one [[figure]]: kind, title, and what to draw. Throws ConfigError.
reports::FigureRecord read_figure(TomlTable& table, const Study& study);

}  // namespace verification

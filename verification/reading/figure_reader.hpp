#pragma once

#include "verification/study/study.hpp"

namespace verification {

/// Reads one [[figure]]: kind, title, and what to draw. Throws ConfigError.
reports::FigureRecord read_figure(TomlTable& table, const Study& study);

/// What figures of a kind are drawn from.
Record record_of_figure(const std::string& kind);

}  // namespace verification

#pragma once

#include <string>

namespace verification {

/// The text of a TOML file. Throws ConfigError for what is no readable file, and for more than 16 MiB.
std::string read_toml_text(const std::string& path);

/// Refuses what a parser had better not see, with the line: bytes that are no UTF-8, control characters,
/// letters beyond ASCII in bare keys (toml++ 3.3 looks them up outside its tables), and keys, brackets or
/// braces nested more than `deepest_nesting` deep (parsers recurse). `origin` stands for the file. Throws
/// ConfigError.
void require_sound_toml(const std::string& text, const std::string& origin);

inline constexpr int deepest_nesting = 32;

}  // namespace verification

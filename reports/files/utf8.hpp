#pragma once

#include <cstddef>
#include <string_view>

namespace reports {

/// Length in bytes of the well-formed UTF-8 character at `i` that a text may hold (RFC 3629; no surrogate,
/// and neither U+FFFE nor U+FFFF, which XML forbids); 0 if there is none.
std::size_t character_length(std::string_view text, std::size_t i);

/// Where the first byte stands that belongs to no such character; npos where all do.
std::size_t first_broken_byte(std::string_view text);

/// Whether a byte is a control character that a text has no use for: any but tab and newline.
bool is_control(char c);

}  // namespace reports

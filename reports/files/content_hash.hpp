#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace reports {

/// 64-bit hash of bytes, eight at a time (multiply and fold, as in FNV-1a over words). Tells files and
/// damaged files apart; no defence against an adversary.
std::uint64_t content_hash(std::string_view bytes, std::uint64_t seed = 14695981039346656037u);

/// The same as 16 hexadecimal digits.
std::string content_name(std::string_view bytes);

}  // namespace reports

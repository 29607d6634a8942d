#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace reports {

/// A document; keys keep their order.
using Json = nlohmann::ordered_json;

// Reading and writing text is most of what the library has to be compiled for: it is, once.

/// Throws Json::exception where the text is no JSON.
Json parse_json(const std::string& text);

/// What becomes of bytes that are no UTF-8 in a string.
enum class InvalidText { Refused, Replaced };

/// With `indent` spaces a level and a newline at the end. Throws Json::exception of what is refused.
std::string json_text(const Json& json, int indent, InvalidText invalid);

}  // namespace reports

#include "verification/config/toml_print.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string_view>

namespace verification {
namespace {

std::string quoted(const std::string& text) {
  std::string literal = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') literal += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      literal += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      literal += c;
  }
  return literal + "\"";
}

/// A key as it is, or in quotes where it holds more than letters, digits, dashes and underscores.
std::string printed_key(std::string_view key) {
  constexpr std::string_view bare = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  const bool plain = !key.empty() && key.find_first_not_of(bare) == key.npos;
  return plain ? std::string(key) : quoted(std::string(key));
}

std::string printed(const toml::node& node) {
  if (const auto* text = node.as_string()) return quoted(text->get());
  if (const auto* integer = node.as_integer()) return fmt::format("{}", integer->get());
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  if (const auto* number = node.as_floating_point()) {
    const std::string text =
        fmt::format("{}", number->get());  // shortest form that reads back to the same bits
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
  }
  std::string list;
  if (const auto* table = node.as_table()) {
    for (const auto& [key, value] : *table)
      list += (list.empty() ? "" : ", ") + printed_key(key.str()) + " = " + printed(value);
    return "{" + list + "}";
  }
  if (const auto* array = node.as_array()) {
    for (const toml::node& entry : *array) list += (list.empty() ? "" : ", ") + printed(entry);
    return "[" + list + "]";
  }
  std::ostringstream date;  // of some kind: none of our keys takes one, a foreign solver's options may
  node.visit([&](const auto& value) {
    if constexpr (toml::is_date<decltype(value)> || toml::is_time<decltype(value)> ||
                  toml::is_date_time<decltype(value)>)
      date << value.get();
  });
  return date.str();
}

void print_table(std::string& text, const std::string& path, const toml::table& table) {
  for (const auto& [key, value] : table)
    if (!value.is_table()) text += printed_key(key.str()) + " = " + printed(value) + "\n";
  for (const auto& [key, value] : table) {
    if (!value.is_table()) continue;
    const std::string name = (path.empty() ? "" : path + ".") + printed_key(key.str());
    text += "\n[" + name + "]\n";
    print_table(text, name, *value.as_table());
  }
}

}  // namespace

std::string printed_toml(const toml::table& table) {
  std::string text;
  print_table(text, "", table);
  return text;
}

}  // namespace verification

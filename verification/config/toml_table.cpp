#include "verification/config/toml_table.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <sstream>
#include <utility>

#include "reports/files/utf8.hpp"
#include "verification/config/config_error.hpp"
#include "verification/config/key_journal.hpp"
#include "verification/config/toml_text.hpp"

namespace verification {

struct TomlTable::Data {
  toml::table table;
  std::string origin;  // file, and variant if any
  std::string path;    // dotted prefix of this table
  std::set<std::string> read;
};

namespace {

std::string line_of(const toml::node* node) {
  if (!node || !node->source().begin) return "";
  return ":" + std::to_string(node->source().begin.line);
}

/// Levenshtein distance.
std::size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j)
      diagonal =
          std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])}));
  }
  return row.back();
}

void overlay(toml::table& base, const toml::table& overrides) {
  for (const auto& [key, value] : overrides) {
    toml::table* into = base[key.str()].as_table();
    if (into && value.is_table())
      overlay(*into, *value.as_table());
    else
      base.insert_or_assign(key, value);
  }
}

template <class Value>
void set_at(toml::table& root, const std::string& path, Value value) {
  toml::table* table = &root;
  std::size_t begin = 0;
  for (std::size_t dot = path.find('.'); dot != std::string::npos;
       begin = dot + 1, dot = path.find('.', begin)) {
    const std::string key = path.substr(begin, dot - begin);
    if (!table->get_as<toml::table>(key)) table->insert_or_assign(key, toml::table{});
    table = table->get_as<toml::table>(key);
  }
  table->insert_or_assign(path.substr(begin), value);
}

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
  if (const auto* array = node.as_array())
    for (const toml::node& entry : *array) list += (list.empty() ? "" : ", ") + printed(entry);
  return "[" + list + "]";
}

/// Values first, then the sub-tables under their full names. (The library's own formatter has undefined
/// behaviour for arrays of numbers below 0.1: it casts a negative logarithm to an unsigned width.)
void print_table(std::string& text, const std::string& path, const toml::table& table) {
  for (const auto& [key, value] : table)
    if (!value.is_table()) text += std::string(key.str()) + " = " + printed(value) + "\n";
  for (const auto& [key, value] : table) {
    if (!value.is_table()) continue;
    const std::string name = (path.empty() ? "" : path + ".") + std::string(key.str());
    text += "\n[" + name + "]\n";
    print_table(text, name, *value.as_table());
  }
}

}  // namespace

TomlTable::TomlTable(std::shared_ptr<Data> data) : data_(std::move(data)) {}

TomlTable TomlTable::from_file(const std::string& path) {
  return from_text(read_toml_text(path), path);
}

TomlTable TomlTable::from_text(const std::string& text, const std::string& origin) {
  require_sound_toml(text, origin);
  try {
    auto data = std::make_shared<Data>();
    data->table = toml::parse(text);
    data->origin = origin;
    return TomlTable(data);
  } catch (const toml::parse_error& error) {
    std::ostringstream where;
    where << origin << ':' << error.source().begin.line << ':' << error.source().begin.column;
    throw ConfigError(where.str() + ": not valid TOML: " + std::string(error.description()));
  }
}

void TomlTable::fail(const std::string& key, const std::string& problem) const {
  throw ConfigError(data_->origin + line_of(data_->table.get(key)) + ": key '" + data_->path + key +
                    "': " + problem);
}

void TomlTable::fail_missing(const std::string& key, const std::string& remedy) const {
  for (const auto& [other, value] : data_->table) {
    const std::string name(other.str());
    if (!data_->read.contains(name) && edits(name, key) <= 2)
      fail(name, "is not known here; did you mean '" + key + "'?");
  }
  fail(key, "is missing; " + remedy);
}

bool TomlTable::has(const std::string& key) {
  accept(key);
  return data_->table.contains(key);
}

bool TomlTable::is_text(const std::string& key) {
  return has(key) && data_->table.get(key)->is_string();
}

std::vector<std::string> TomlTable::keys() {
  std::vector<std::string> found;
  for (const auto& entry : data_->table) found.emplace_back(entry.first.str());
  for (const std::string& key : found) accept(key);
  return found;
}

void TomlTable::accept(const std::string& key) {
  data_->read.insert(key);
}

namespace {

constexpr double smallest_number = 1e-30, largest_number = 1e30;

double finite_number(const TomlTable& table, const std::string& key, const toml::node* node) {
  const auto value = node ? node->value<double>() : std::nullopt;
  if (!value || node->is_boolean()) table.fail(key, "must be a number");
  if (!std::isfinite(*value)) table.fail(key, "must be finite");
  // In SI units nothing here is that small or large, and products of such numbers would under- or overflow.
  if (*value != 0 && !(std::abs(*value) >= smallest_number && std::abs(*value) <= largest_number))
    table.fail(key, fmt::format("is {}: must be 0 or lie between {:g} and {:g} in size", *value,
                                smallest_number, largest_number));
  return *value;
}

int whole_number(const TomlTable& table, const std::string& key, const toml::node* node) {
  const double value = finite_number(table, key, node);
  if (value != std::floor(value) || std::abs(value) > 1e9)
    table.fail(key, "must be a whole number below 1e9");
  return static_cast<int>(value);
}

std::string word(const TomlTable& table, const std::string& key, const toml::node* node) {
  if (!node || !node->is_string()) table.fail(key, "must be a text in quotes");
  const std::string text = *node->value<std::string>();
  // TOML's escapes can make what the file itself may not hold.
  if (std::ranges::any_of(text, reports::is_control) || reports::first_broken_byte(text) != std::string::npos)
    table.fail(key, "must not hold control characters or what is no character");
  return text;
}

template <class Element>
auto list(const TomlTable& table, const std::string& key, const toml::node* node, Element&& element) {
  std::vector<decltype(element(table, key, node))> values;
  if (!node || !node->is_array()) table.fail(key, "must be a list in brackets");
  for (const toml::node& entry : *node->as_array()) values.push_back(element(table, key, &entry));
  if (values.empty()) table.fail(key, "must not be empty");
  return values;
}

}  // namespace

double TomlTable::number(const std::string& key) {
  KeyJournal::asked(data_->path + key, "number");
  if (!has(key)) fail_missing(key, "give a number");
  return finite_number(*this, key, data_->table.get(key));
}

int TomlTable::integer(const std::string& key) {
  KeyJournal::asked(data_->path + key, "integer");
  if (!has(key)) fail_missing(key, "give a whole number");
  return whole_number(*this, key, data_->table.get(key));
}

std::string TomlTable::text(const std::string& key) {
  KeyJournal::asked(data_->path + key, "text");
  if (!has(key)) fail_missing(key, "give a text in quotes");
  return word(*this, key, data_->table.get(key));
}

std::vector<double> TomlTable::numbers(const std::string& key) {
  KeyJournal::asked(data_->path + key, "numbers");
  if (!has(key)) fail_missing(key, "give a list of numbers");
  return list(*this, key, data_->table.get(key), finite_number);
}

std::vector<int> TomlTable::integers(const std::string& key) {
  KeyJournal::asked(data_->path + key, "integers");
  if (!has(key)) fail_missing(key, "give a list of whole numbers");
  return list(*this, key, data_->table.get(key), whole_number);
}

std::vector<std::string> TomlTable::texts(const std::string& key) {
  KeyJournal::asked(data_->path + key, "texts");
  if (!has(key)) fail_missing(key, "give a list of texts");
  return list(*this, key, data_->table.get(key), word);
}

double TomlTable::number(const std::string& key, double absent) {
  KeyJournal::absent(data_->path + key, "number", fmt::format("{:g}", absent));
  return has(key) ? number(key) : absent;
}
int TomlTable::integer(const std::string& key, int absent) {
  KeyJournal::absent(data_->path + key, "integer", std::to_string(absent));
  return has(key) ? integer(key) : absent;
}
std::string TomlTable::text(const std::string& key, const std::string& absent) {
  KeyJournal::absent(data_->path + key, "text", absent);
  return has(key) ? text(key) : absent;
}

bool TomlTable::flag(const std::string& key, bool absent) {
  KeyJournal::absent(data_->path + key, "flag", absent ? "true" : "false");
  if (!has(key)) return absent;
  if (!data_->table.get(key)->is_boolean()) fail(key, "must be true or false");
  return *data_->table.get(key)->value<bool>();
}

double TomlTable::positive(const std::string& key) {
  const double value = number(key);
  if (!(value > 0)) fail(key, "must be positive");
  return value;
}

double TomlTable::positive(const std::string& key, double absent) {
  KeyJournal::absent(data_->path + key, "number", fmt::format("{:g}", absent));
  return has(key) ? positive(key) : absent;
}

TomlTable TomlTable::table(const std::string& key) {
  KeyJournal::asked(data_->path + key, "table");
  auto data = std::make_shared<Data>();
  data->origin = data_->origin;
  data->path = data_->path + key + ".";
  if (has(key)) {
    if (!data_->table.get(key)->is_table()) fail(key, "must be a table [" + key + "]");
    data->table = *data_->table.get(key)->as_table();
  }
  return TomlTable(data);
}

std::vector<TomlTable> TomlTable::tables(const std::string& key) {
  KeyJournal::asked(data_->path + key, "tables");
  std::vector<TomlTable> result;
  if (!has(key)) return result;
  const toml::array* array = data_->table.get(key)->as_array();
  if (!array || !array->is_homogeneous<toml::table>()) fail(key, "must be a list of tables [[" + key + "]]");
  for (const toml::node& entry : *array) {
    auto data = std::make_shared<Data>();
    data->origin = data_->origin + line_of(&entry);
    data->path = data_->path + key + ".";
    data->table = *entry.as_table();
    result.push_back(TomlTable(data));
  }
  return result;
}

void TomlTable::refuse_unknown_keys() const {
  for (const auto& [key, value] : data_->table) {
    if (data_->read.contains(std::string(key.str()))) continue;
    std::string known;
    for (const std::string& name : data_->read) known += (known.empty() ? "" : ", ") + name;
    fail(std::string(key.str()), "is not known here; known keys: " + known);
  }
}

TomlTable TomlTable::overlaid_with(const TomlTable& overrides, const std::string& name) const {
  auto data = std::make_shared<Data>();
  data->table = data_->table;
  data->origin = data_->origin + (name.empty() ? "" : " (" + name + ")");
  data->path = data_->path;
  overlay(data->table, overrides.data_->table);
  return TomlTable(data);
}

TomlTable TomlTable::restricted_to(const std::vector<std::string>& keys) const {
  auto data = std::make_shared<Data>();
  data->origin = data_->origin;
  data->path = data_->path;
  for (const std::string& key : keys)
    if (const toml::node* node = data_->table.get(key)) data->table.insert_or_assign(key, *node);
  return TomlTable(data);
}

void TomlTable::set(const std::string& path, double value) {
  set_at(data_->table, path, value);
}
void TomlTable::set(const std::string& path, int value) {
  set_at(data_->table, path, static_cast<std::int64_t>(value));
}

std::string TomlTable::print() const {
  std::string text;
  print_table(text, "", data_->table);
  return text;
}

}  // namespace verification

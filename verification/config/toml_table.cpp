#include "verification/config/toml_table.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <sstream>
#include <type_traits>
#include <utility>

#include "reports/files/utf8.hpp"
#include "verification/config/config_error.hpp"
#include "verification/config/key_journal.hpp"
#include "verification/config/toml_print.hpp"
#include "verification/config/toml_text.hpp"

namespace verification {

struct TomlTable::Data {
  toml::table table;
  std::string origin;  // file, and variant if any
  std::string path;    // dotted prefix of this table
  std::set<std::string> read;
  std::shared_ptr<toml::table> defaults;  // noted, by full path; null unless asked for

  template <class Value>
  Value absent(const std::string& key, const Value& value);
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
  table->insert_or_assign(path.substr(begin), std::move(value));
}

}  // namespace

template <class Value>
Value TomlTable::Data::absent(const std::string& key, const Value& value) {
  if (defaults) {
    if constexpr (std::is_same_v<Value, int>)
      set_at(*defaults, path + key, static_cast<std::int64_t>(value));
    else
      set_at(*defaults, path + key, value);
  }
  return value;
}

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
  if (has(key)) return number(key);
  return std::isfinite(absent) ? data_->absent(key, absent) : absent;
}
int TomlTable::integer(const std::string& key, int absent) {
  KeyJournal::absent(data_->path + key, "integer", std::to_string(absent));
  return has(key) ? integer(key) : data_->absent(key, absent);
}
std::string TomlTable::text(const std::string& key, const std::string& absent) {
  KeyJournal::absent(data_->path + key, "text", absent);
  return has(key) ? text(key) : data_->absent(key, absent);
}
bool TomlTable::flag(const std::string& key, bool absent) {
  KeyJournal::absent(data_->path + key, "flag", absent ? "true" : "false");
  if (!has(key)) return data_->absent(key, absent);
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
  if (has(key)) return positive(key);
  // A default that could not be written (0 or infinity: "without") is none to write out.
  return absent > 0 && std::isfinite(absent) ? data_->absent(key, absent) : absent;
}

TomlTable TomlTable::table(const std::string& key) {
  KeyJournal::asked(data_->path + key, "table");
  auto data = std::make_shared<Data>();
  data->origin = data_->origin;
  data->path = data_->path + key + ".";
  data->defaults = data_->defaults;
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

bool TomlTable::erase(const std::string& path) {
  const auto key = path.rfind('.') + 1;  // 0 where there is no dot
  toml::table* table = key == 0 ? &data_->table : data_->table.at_path(path.substr(0, key - 1)).as_table();
  return table && table->erase(path.substr(key)) > 0;
}

void TomlTable::set(const std::string& path, double value) {
  set_at(data_->table, path, value);
}
void TomlTable::set(const std::string& path, int value) {
  set_at(data_->table, path, static_cast<std::int64_t>(value));
}
void TomlTable::set(const std::string& path, const std::string& value) {
  set_at(data_->table, path, value);
}
void TomlTable::set(const std::string& path, const std::vector<double>& values) {
  toml::array list;
  for (const double value : values) list.push_back(value);
  set_at(data_->table, path, std::move(list));
}
void TomlTable::note_defaults() {
  data_->defaults = std::make_shared<toml::table>();
}

TomlTable TomlTable::with_defaults() const {
  auto data = std::make_shared<Data>(Data{{}, data_->origin, data_->path, {}, nullptr});
  if (data_->defaults) data->table = *data_->defaults;
  overlay(data->table, data_->table);
  return TomlTable(data);
}
std::string TomlTable::print() const {
  return printed_toml(data_->table);
}
std::string TomlTable::print_as(const std::string& name) const {
  toml::table outer;
  set_at(outer, name, toml::table(data_->table));
  return printed_toml(outer);
}

}  // namespace verification

#include "verification/schema/study_schema.hpp"

#include <fmt/format.h>

#include <vector>

#include "reports/files/json_text.hpp"
#include "verification/scene/scene_config.hpp"
#include "verification/schema/schema_text.hpp"

namespace verification {
namespace {

using reports::Json;

const Json& schema() {
  static const Json parsed = reports::parse_json(study_schema_text);
  return parsed;
}

/// The properties of a table, or of the tables of an array; null for a value.
const Json* properties_of(const Json& node) {
  const Json& table = node.contains("items") && node["items"].contains("properties") ? node["items"] : node;
  return table.contains("properties") ? &table["properties"] : nullptr;
}

std::set<std::string> types_of(const Json& node) {
  if (!node.contains("type")) return {"object"};  // a reference to one of the scene's tables
  if (node["type"].is_array()) return node["type"].get<std::set<std::string>>();
  return {node["type"].get<std::string>()};
}

std::string default_of(const Json& node) {
  if (!node.contains("default")) return "";
  const Json& value = node["default"];
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  return fmt::format("{:g}", value.get<double>());
}

void collect(const Json& node, const std::string& path, std::map<std::string, SchemaKey>& keys) {
  const Json* properties = properties_of(node);
  if (!properties) return;
  if (node.contains("additionalProperties") && node["additionalProperties"].is_object())
    keys[path + "*"] = {{"string"}, ""};
  for (const auto& [key, value] : properties->items()) {
    keys[path + key] = {types_of(value), default_of(value)};
    collect(value, path + key + ".", keys);
  }
}

/// A type as TOML has it.
std::string type_in_words(const Json& node) {
  static const std::map<std::string, std::string> words = {{"number", "number"}, {"integer", "whole number"},
                                                           {"string", "text"},   {"boolean", "true or false"},
                                                           {"array", "list"},    {"object", "table"}};
  std::string text;
  for (const std::string& type : types_of(node)) text += (text.empty() ? "" : " or ") + words.at(type);
  if (text == "list" && node["items"].contains("properties")) return "tables";
  if (text == "list" && node["items"].contains("type"))
    return "list: " + words.at(node["items"]["type"].get<std::string>());
  return text;
}

/// The values that a text may take.
std::string choices_of(const Json& node) {
  const Json& values = node.contains("items") ? node["items"] : node;
  std::string text;
  if (values.contains("enum"))
    for (const Json& value : values["enum"])
      text += (text.empty() ? "`" : ", `") + value.get<std::string>() + "`";
  return text;
}

std::string row_of(const std::string& key, const Json& node) {
  const std::string choices = choices_of(node), absent = default_of(node);
  return fmt::format("| `{}` | {} | {} | {} | {}{} |\n", key, type_in_words(node), node.value("unit", ""),
                     absent.empty() ? "" : "`" + absent + "`", node.value("description", ""),
                     choices.empty() ? "" : ". One of " + choices);
}

void add_section(const std::string& path, const Json& node, std::string& page) {
  const Json* properties = properties_of(node);
  if (!properties || properties->empty()) return;
  const bool listed = node.contains("items");
  const std::string heading = path.empty() ? "A study" : listed ? "`[[" + path + "]]`" : "`[" + path + "]`";
  page += fmt::format("\n## {}\n\n{}.\n\n| key | type | unit | default | meaning |\n|---|---|---|---|---|\n",
                      heading, node.value("description", ""));
  std::vector<std::pair<std::string, const Json*>> tables;
  for (const auto& [key, value] : properties->items()) {
    const bool is_table = properties_of(value) && !properties_of(value)->empty();
    if (is_table) tables.emplace_back((path.empty() ? "" : path + ".") + key, &value);
    if (value.contains("$ref")) continue;  // said in the section's first sentence
    page += row_of(key, value);
  }
  for (const auto& [name, table] : tables) add_section(name, *table, page);
}

}  // namespace

std::string study_schema() {
  return reports::json_text(schema(), 1, reports::InvalidText::Refused);
}

std::string scene_schema() {
  Json scene = schema();
  scene["title"] = "mpm-verify scene";
  scene["description"] = "One simulation: what flows, of what, on which grid, by which scheme, until when";
  scene["required"] = {"scene", "fluid", "discretisation", "time"};
  Json properties;
  for (const std::string& table : scene_tables()) properties[table] = scene["properties"][table];
  scene["properties"] = properties;
  return reports::json_text(scene, 1, reports::InvalidText::Refused);
}

std::string keys_page() {
  std::string page =
      "# Keys\n\nEvery key of a study; a scene has the tables `scene`, `fluid`, `discretisation`, `scheme` "
      "and "
      "`time` alone. What they are for: [scenes-and-studies.md](scenes-and-studies.md). Made by\n`mpm-verify "
      "schema --markdown` from the JSON Schema that `mpm-verify schema` prints for editors; a test holds it "
      "against "
      "the readers.\nA key that is not here is refused.\n";
  add_section("", schema(), page);
  return page;
}

std::map<std::string, SchemaKey> schema_keys() {
  std::map<std::string, SchemaKey> keys;
  collect(schema(), "", keys);
  return keys;
}

}  // namespace verification

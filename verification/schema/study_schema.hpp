#pragma once

#include <map>
#include <set>
#include <string>

// What may stand in a study or a scene, as data: for editors, which complete and check by it, and for the
// page of all keys. A test holds it against the readers, key by key, and against every study that comes with
// the program.
namespace verification {

/// JSON Schema (draft 7) of a study file, with the keywords "unit" (SI) and "default" beside the standard's.
std::string study_schema();

/// The same of a scene file: its five tables alone.
std::string scene_schema();

/// Every key with type, unit, default and meaning: docs/keys.md.
std::string keys_page();

/// A key of the schema as tests see it.
struct SchemaKey {
  std::set<std::string> types;  ///< of JSON: number, integer, string, boolean, array, object
  std::string default_text;     ///< as TOML text, empty without
};

/// By dotted path; entries of an array of tables share theirs ("check.kind"), a table with free keys is
/// "path.*".
std::map<std::string, SchemaKey> schema_keys();

}  // namespace verification

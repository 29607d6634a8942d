#include "verification/schema/study_schema.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "tests/scratch_directory.hpp"
#include "tests/study_text.hpp"
#include "tests/unit/verification/read_text.hpp"
#include "verification/config/config_error.hpp"
#include "verification/config/key_journal.hpp"
#include "verification/reading/study_folder.hpp"

using namespace verification;

namespace {

const std::string any_check = "[[check]]\nkind = \"divergence\"\nlower = 0\nupper = 9\nreason = \"any\"\n";

std::string box(const std::string& lines) {
  return study_text("T", "C",
                    "[scene]\nflow = \"box\"\nwidth = 1e-3\nheight = 1e-3\nvelocity_scale = 1\n" + lines +
                        "[fluid]\nkinematic_viscosity = 1e-6\npressure = false\n[discretisation]\ncells = 4\n"
                        "[time]\ndt = 1e-5\nend = 1e-4\n") +
         any_check;
}

/// Studies that ask for what no study of ours needs.
std::vector<std::string> further_studies() {
  const std::string channel = study_text("T", "C", couette_scene());
  const std::string walls = "[scene.walls]\nleft = [0, 0]\nright = [0, 0]\nbottom = [0, 0]\ntop = [0, 0]\n";
  return {
      channel + "[scheme]\nmethod = \"sph\"\nwall = \"morris\"\nwall_limit = 1.5\nsmoothing = 1\n" +
          any_check,
      channel +
          "[matrix]\nmethod = \"sph\"\nkernel = [\"cubic\"]\nwall = [\"mirror\"]\n"
          "density = [\"continuity\"]\n" +
          any_check,
      channel +
          "[solver]\ncommand = [\"true\"]\nenvironment = {A = \"b\"}\ndelivers = [\"profile\"]\n"
          "locations = [\"grid\"]\npoints_across = 4\npoints_reason = \"any\"\n" +
          any_check,
      channel + "[solver]\ncommand = \"true\"\nversion = \"true\"\noptions = {a = 1}\ninputs = [\".\"]\n" +
          any_check,
      channel + "[solver]\nresults = \"theirs/{run}\"\n" + any_check,
      "compare_with = \"gone.csv\"\n" + channel + "[compare_table]\nuncertainty = 1\n" + any_check,
      "expected_checks = 1\n" + channel + any_check,
      channel + "[[check]]\nkind = \"error\"\nrelative_to = \"present\"\nupper = 1\nreason = \"any\"\n" +
          "[[check]]\nkind = \"error\"\nrelative_to = 1e-4\nupper = 1\nreason = \"any\"\n",
      channel +
          "[validation]\nvelocity = 1\nlength = 1\nvariants = [\"\"]\n[[validation.input]]\n"
          "key = \"fluid.density\"\nuncertainty = 1\nsource = \"any\"\n[[validation.quantity]]\n"
          "name = \"u\"\nlargest_error = 1\nreason = \"any\"\ny = 5e-4\npredict_at = [0.1]\n"
          "[ladder]\naxis = \"space\"\ncells = [4, 8]\ntheoretical = 2\n",
      study_text("T", "C",
                 couette_scene("cells = 8", "dt = \"auto\"\ntime_error_fraction = 0.2\nend = 0.1")) +
          any_check,
      box("initial_velocity = [1, 0]\nbody_acceleration = [0, -1]\n" + walls +
          "[scene.slip_length]\nleft = 1e-4\nright = 1e-4\nbottom = 1e-4\ntop = 1e-4\n"
          "[[scene.fluid_region]]\npolygon = [0, 0, 1, 0, 0, 1]\n[[scene.fluid_region]]\n"
          "below = [0, 5e-4, 0, 1]\n"),
  };
}

/// What the readers ask of our studies and of those above. A refusal is of no matter: the keys up to it are
/// asked.
std::map<std::string, KeyJournal::Asked> asked_keys() {
  const KeyJournal journal;
  (void)read_studies(MPM_STUDIES, 1);  // a journal is of one thread
  for (const std::string& text : further_studies()) try {
      (void)read_study_text(text, "further");
    } catch (const ConfigError&) {
    }
  return journal.keys();
}

const std::set<std::string> kinds_of_object = {"table", "tables"};

std::string json_type(const std::string& kind) {
  if (kind == "number" || kind == "integer") return kind;
  if (kind == "text") return "string";
  if (kind == "flag") return "boolean";
  return kind == "table" ? "object" : "array";
}

nlohmann::json json_of(const std::string& toml_text) {
  std::ostringstream text;
  text << toml::json_formatter{toml::parse(toml_text)};
  return nlohmann::json::parse(text.str());
}

/// Complaints of an independent validator, none for a document that the schema allows.
std::vector<std::string> complaints(const nlohmann::json& document, const std::string& schema_text) {
  const nlohmann::json schema_json = nlohmann::json::parse(schema_text);
  valijson::Schema schema;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7)
      .populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), schema);
  valijson::Validator validator;
  valijson::ValidationResults results;
  const valijson::adapters::NlohmannJsonAdapter target(document);
  std::vector<std::string> found;
  if (validator.validate(schema, target, &results)) return found;
  valijson::ValidationResults::Error error;
  while (results.popError(error)) {
    std::string where;
    for (const std::string& part : error.context) where += part;
    found.push_back(where + ": " + error.description);
  }
  return found;
}

}  // namespace

TEST_CASE("the schema has exactly the keys that the readers ask for, with their types and defaults",
          "[schema]") {
  const auto asked = asked_keys();
  const auto keys = schema_keys();
  for (const auto& [path, how] : asked) {
    INFO("the readers ask for '" << path << "': add it to verification/schema/study.schema.json");
    const bool is_free = std::ranges::any_of(keys, [&path = path](const auto& key) {
      return key.first.ends_with("*") && path.starts_with(key.first.substr(0, key.first.size() - 1));
    });
    if (is_free) continue;
    REQUIRE(keys.contains(path));
    const SchemaKey& key = keys.at(path);
    for (const std::string& kind : how.kinds) {
      INFO("reads it as " << kind);
      CHECK((key.types.contains(json_type(kind)) || (kind == "number" && key.types.contains("integer"))));
    }
    if (!key.default_text.empty()) CHECK(how.defaults.contains(key.default_text));
    // The name of a solver is that of its command, where nothing is said.
    const bool one_default = how.defaults.size() == 1 && !how.defaults.begin()->empty() &&
                             how.defaults.begin()->find("inf") == std::string::npos;
    if (one_default && path != "solver.name") CHECK(key.default_text == *how.defaults.begin());
  }
  for (const auto& [path, key] : keys) {
    if (path.ends_with("*") || path.starts_with("variant.")) continue;
    INFO("no reader asks for '" << path << "': take it out of the schema, or let further_studies() read it");
    CHECK(asked.contains(path));
  }
}

TEST_CASE("every study that comes with the program obeys the schema", "[schema]") {
  const std::string schema = study_schema();
  int studies = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(MPM_STUDIES)) {
    if (entry.path().extension() != ".toml") continue;
    ++studies;
    INFO(entry.path());
    for (const std::string& complaint : complaints(json_of(content_of(entry.path())), schema))
      FAIL_CHECK(complaint);
  }
  CHECK(studies > 100);
}

TEST_CASE("every study that comes with the program says how many checks it makes", "[schema]") {
  for (const Study& study : read_studies(MPM_STUDIES)) {
    INFO(study.name);
    CHECK(study.declared_checks.has_value());
  }
}

TEST_CASE("the schema refuses what the readers refuse", "[schema]") {
  const std::string good = study_text("T", "C", couette_scene()) + any_check;
  CHECK(complaints(json_of(good), study_schema()).empty());
  CHECK_FALSE(complaints(json_of(replaced(good, "cells = 8", "cell = 8")), study_schema()).empty());
  CHECK_FALSE(complaints(json_of(replaced(good, "cells = 8", "cells = 0")), study_schema()).empty());
  CHECK_FALSE(complaints(json_of(replaced(good, "\"couette\"", "\"coette\"")), study_schema()).empty());
  CHECK_FALSE(complaints(json_of(replaced(good, "reason = \"any\"", "")), study_schema()).empty());
  CHECK(complaints(json_of(couette_scene()), scene_schema()).empty());
  CHECK_FALSE(complaints(json_of(good), scene_schema()).empty());
}

TEST_CASE("docs/keys.md is what the schema says", "[schema]") {
  CHECK(content_of(std::filesystem::path(MPM_DOCS) / "keys.md") == keys_page());
}

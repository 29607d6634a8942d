#include "verification/suite/shards/manifest.hpp"

#include <algorithm>

#include "reports/files/atomic_file.hpp"
#include "reports/files/io_error.hpp"
#include "reports/files/json_text.hpp"
#include "verification/config/config_error.hpp"
#include "verification/scene/handed_scene.hpp"

namespace verification {
namespace {

namespace fs = std::filesystem;
using reports::Json;

Json json_of(const PlannedSuite& suite) {
  return {{"studies_directory", suite.studies.string()}, {"studies", suite.names}, {"suite", suite.suite}};
}

PlannedSuite suite_of(const Json& json) {
  return {json.at("studies_directory").get<std::string>(), json.at("studies").get<std::vector<std::string>>(),
          json.at("suite").get<std::string>()};
}

Json parsed(const fs::path& file, const char* remedy) {
  std::string text;
  try {
    text = reports::read_file(file);
  } catch (const reports::IoError&) {
    throw ConfigError(file.string() + " is not there: " + remedy);
  }
  try {
    Json json = reports::parse_json(text);
    if (json.at("protocol").get<int>() != protocol_version)
      throw ConfigError(file.string() + " is of another version of the protocol: make it anew");
    return json;
  } catch (const Json::exception& error) {
    throw ConfigError(file.string() + " cannot be read: " + error.what());
  }
}

}  // namespace

PlannedSuite PlannedSuite::of(const fs::path& studies, const std::vector<std::string>& names,
                              const std::string& suite) {
  PlannedSuite planned{fs::absolute(studies), names, suite};
  for (std::string& name : planned.names)
    if (name.ends_with(".toml")) name = fs::absolute(name).string();
  return planned;
}

void write_manifest(const fs::path& directory, const Manifest& manifest) {
  Json json = {{"protocol", protocol_version},
               {"plan", json_of(manifest.suite)},
               {"program", manifest.program},
               {"shards", manifest.shards}};
  Json runs = Json::array();
  for (const PlannedEntry& entry : manifest.runs) {
    Json run = {{"run", entry.run},          {"study", entry.study},     {"scene", entry.scene},
                {"key", entry.key},          {"seconds", entry.seconds}, {"results", "results/" + entry.run},
                {"delivers", entry.delivers}};
    if (entry.shard > 0) run["shard"] = entry.shard;
    runs.push_back(run);
  }
  json["runs"] = runs;
  reports::write_file(directory / "manifest.json",
                      reports::json_text(json, 1, reports::InvalidText::Refused));
}

Manifest read_manifest(const fs::path& directory) {
  const Json json = parsed(directory / "manifest.json", "`mpm-verify plan ... --out DIR` writes it");
  Manifest manifest;
  try {
    manifest.suite = suite_of(json.at("plan"));
    manifest.program = json.at("program");
    manifest.shards = json.at("shards");
    for (const Json& run : json.at("runs"))
      manifest.runs.push_back({run.at("run"), run.at("study"), run.at("scene"), run.at("key"),
                               run.at("delivers").get<std::vector<std::string>>(), run.at("seconds"),
                               run.value("shard", 0)});
  } catch (const Json::exception& error) {
    throw ConfigError((directory / "manifest.json").string() + " cannot be read: " + error.what());
  }
  return manifest;
}

void write_shard(const fs::path& directory, const ShardState& state) {
  const Json json = {{"protocol", protocol_version},
                     {"plan", json_of(state.suite)},
                     {"program", state.program},
                     {"kernels", state.kernels},
                     {"machine", state.machine},
                     {"shard", state.index},
                     {"of", state.count},
                     {"runs", state.runs},
                     {"complete", state.complete},
                     {"failures", state.failures}};
  reports::write_file(directory / "shard.json", reports::json_text(json, 1, reports::InvalidText::Refused));
}

ShardState read_shard(const fs::path& directory) {
  const Json json = parsed(directory / "shard.json", "`mpm-verify run --shard K/N --out DIR` writes it");
  try {
    return {
        suite_of(json.at("plan")), json.at("program"),  json.at("kernels"),
        json.at("machine"),        json.at("shard"),    json.at("of"),
        json.at("runs"),           json.at("complete"), json.at("failures").get<std::vector<std::string>>()};
  } catch (const Json::exception& error) {
    throw ConfigError((directory / "shard.json").string() + " cannot be read: " + error.what());
  }
}

bool is_complete(const fs::path& directory) {
  try {
    return read_shard(directory).complete;
  } catch (const ConfigError&) {
    return false;
  }
}

std::vector<fs::path> shard_directories(const std::vector<fs::path>& given) {
  std::vector<fs::path> found;
  for (const fs::path& directory : given) {
    if (fs::exists(directory / "shard.json")) {
      found.push_back(directory);
      continue;
    }
    std::error_code error;
    std::vector<fs::path> below;
    for (const auto& entry : fs::directory_iterator(directory, error))
      if (fs::exists(entry.path() / "shard.json")) below.push_back(entry.path());
    if (below.empty())
      throw ConfigError(
          directory.string() +
          ": no shard.json there, nor right below; give directories that `run --shard K/N --out "
          "DIR` wrote");
    std::ranges::sort(below);
    found.insert(found.end(), below.begin(), below.end());
  }
  return found;
}

CacheOrigin origin_of(const fs::path& directory, const ShardState& state) {
  return {directory / "cache", state.program, state.kernels};
}

}  // namespace verification

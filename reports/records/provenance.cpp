#include "reports/records/provenance.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <ctime>
#include <fstream>

#include "reports/files/atomic_file.hpp"
#include "reports/files/io_error.hpp"
#include "reports/files/json_text.hpp"

namespace reports {
namespace {

// The value behind `key` in a file of "key <separator> value" lines; "" if there is none.
std::string value_in(const char* file, const std::string& key, char separator) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t at = line.find(separator);
    if (at == line.npos || line.compare(0, key.size(), key) != 0) continue;
    if (line.find_first_not_of(" \t", key.size()) != at) continue;
    const std::size_t begin = line.find_first_not_of(" \t\"", at + 1);
    if (begin == line.npos) return "";
    return line.substr(begin, line.find_last_not_of(" \t\"") + 1 - begin);
  }
  return "";
}

}  // namespace

MachineFacts this_machine() {
  MachineFacts machine;
  machine.cpu = value_in("/proc/cpuinfo", "model name", ':');
  utsname name{};
  const bool named = uname(&name) == 0;
  if (machine.cpu.empty()) machine.cpu = named ? name.machine : "unknown";
  machine.cores = std::max(0L, sysconf(_SC_NPROCESSORS_ONLN));
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  if (pages > 0 && page > 0) machine.memory_bytes = static_cast<long long>(pages) * page;
  machine.os = value_in("/etc/os-release", "PRETTY_NAME", '=');
  if (named) machine.os += fmt::format("{}{} {}", machine.os.empty() ? "" : ", ", name.sysname, name.release);
  if (machine.os.empty()) machine.os = "unknown";
  return machine;
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[sizeof "2026-01-31T23:59:59Z" + 40];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

void write_provenance(const std::filesystem::path& dir, const Provenance& provenance, Durability durability) {
  const Json json = {
      {"version", provenance.build.version},
      {"commit", provenance.build.commit},
      {"compiler", provenance.build.compiler},
      {"flags", provenance.build.flags},
      {"build_type", provenance.build.build_type},
      {"machine",
       {{"cpu", provenance.machine.cpu},
        {"cores", provenance.machine.cores},
        {"memory_bytes", provenance.machine.memory_bytes},
        {"os", provenance.machine.os}}},
      {"command", provenance.command},
      {"started", provenance.started},
  };
  // A command line may hold any bytes; what is no UTF-8 is replaced rather than refused.
  write_file(dir / "provenance.json", json_text(json, 2, InvalidText::Replaced), durability);
}

std::optional<Provenance> read_provenance(const std::filesystem::path& dir) {
  const std::filesystem::path path = dir / "provenance.json";
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  try {
    const Json json = parse_json(read_file(path));
    Provenance provenance;
    json.at("version").get_to(provenance.build.version);
    json.at("commit").get_to(provenance.build.commit);
    json.at("compiler").get_to(provenance.build.compiler);
    json.at("flags").get_to(provenance.build.flags);
    json.at("build_type").get_to(provenance.build.build_type);
    const Json& machine = json.at("machine");
    machine.at("cpu").get_to(provenance.machine.cpu);
    machine.at("cores").get_to(provenance.machine.cores);
    machine.at("memory_bytes").get_to(provenance.machine.memory_bytes);
    machine.at("os").get_to(provenance.machine.os);
    json.at("command").get_to(provenance.command);
    json.at("started").get_to(provenance.started);
    return provenance;
  } catch (const Json::exception& e) {
    throw IoError(fmt::format("{}: {}", path.string(), e.what()));
  }
}

}  // namespace reports

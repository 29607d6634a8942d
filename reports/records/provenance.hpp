#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "reports/files/atomic_file.hpp"

namespace reports {

/// What the program was built from; the caller knows.
struct BuildFacts {
  std::string version, commit, compiler, flags, build_type;
};

/// What it ran on.
struct MachineFacts {
  std::string cpu;             ///< model name
  long cores = 0;              ///< online
  long long memory_bytes = 0;  ///< physical
  std::string os;              ///< distribution and kernel
};

/// What made the results of a directory.
struct Provenance {
  BuildFacts build;
  MachineFacts machine;
  std::string command;  ///< the command line
  std::string started;  ///< UTC, ISO 8601
};

/// The machine this runs on; a fact that the system does not tell is "unknown" or 0.
MachineFacts this_machine();

/// Now, UTC, as 2026-01-31T23:59:59Z.
std::string utc_now();

/// provenance.json of `dir`. @throws IoError
void write_provenance(const std::filesystem::path& dir, const Provenance& provenance,
                      Durability durability = Durability::Synced);

/// provenance.json of `dir`; none if there is no such file. @throws IoError if it is there and not what it
/// should be.
std::optional<Provenance> read_provenance(const std::filesystem::path& dir);

}  // namespace reports

#pragma once

#include <string>
#include <vector>

#include "solver/scene/scheme.hpp"
#include "verification/config/toml_table.hpp"

namespace verification {

/// Combinations of scheme parts, each a variant of a study: [matrix] basis, transfer, stepping, each a list
/// of names.
struct MatrixEntry {
  std::string variant;                    ///< "cubic_full-mass_leapfrog"
  std::string basis, transfer, stepping;  ///< names
  double flip_fraction = 0;               ///< flip-blend only

  /// The entry as a TOML table [scheme].
  [[nodiscard]] std::string toml() const;
};

/// Names of parts listed under a key, all of them where it is absent; one that is not known is refused
/// (ConfigError).
std::vector<std::string> part_names(TomlTable& table, const std::string& key,
                                    const std::vector<mpm::SchemePart>& parts);

/// Reads [matrix]. Throws ConfigError.
std::vector<MatrixEntry> read_matrix(TomlTable table);

}  // namespace verification

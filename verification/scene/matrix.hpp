#pragma once

#include <string>
#include <vector>

#include "solver/scene/scheme.hpp"
#include "verification/config/toml_table.hpp"

namespace verification {

/// Combinations of scheme parts, each a variant of a study: [matrix] basis, transfer, stepping, each a list
/// of names; with method = "sph" kernel, wall, density.
struct MatrixEntry {
  std::string variant;                    ///< "cubic_full-mass_leapfrog", "sph_quintic_mirror_continuity"
  std::string basis, transfer, stepping;  ///< names; empty for SPH
  double flip_fraction = 0;               ///< flip-blend only
  std::string kernel, wall, density;      ///< names; of SPH only

  /// The entry as a TOML table [scheme].
  [[nodiscard]] std::string toml() const;
  [[nodiscard]] bool is_sph() const { return !kernel.empty(); }
};

/// Names of parts listed under a key, all of them where it is absent; one that is not known is refused
/// (ConfigError).
std::vector<std::string> part_names(TomlTable& table, const std::string& key,
                                    const std::vector<mpm::SchemePart>& parts);

/// Reads [matrix]. Throws ConfigError.
std::vector<MatrixEntry> read_matrix(TomlTable table);

}  // namespace verification

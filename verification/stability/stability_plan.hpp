#pragma once

#include <string>
#include <vector>

#include "reports/records/records.hpp"
#include "verification/config/toml_table.hpp"
#include "verification/stability/measured_limit.hpp"

namespace verification {

/// What the particles do while a limit is measured. Seats: at rest where they are seeded. Offset: at rest
/// where they are least stable. Streaming: there, carried on by a slow stream, and at a little below the
/// limit through a whole period of offsets. StreamingX: the same along x alone, as a flow along plates.
enum class Passage { Seats, Offset, Streaming, StreamingX };
std::string name(Passage passage);

/// One unit of work: a scheme, its waves and its motion, along every ray.
struct StabilityCase {
  std::string variant;  ///< of the study, "linear_flip_usf"
  mpm::Scheme scheme;
  Waves waves = Waves::Shear;
  Passage passage = Passage::Seats;

  /// Unique name, safe as a file name's part.
  [[nodiscard]] std::string name() const;
};

/// [stability] of a study: which limits to measure. Every scheme of its [matrix] with every kind of waves and
/// every motion.
struct StabilityPlan {
  std::string toml;  ///< text that reproduces it
  ParticleLattice lattice;
  std::vector<double> acoustic_shares;  ///< rays r : CFL = (1 - share) : share; 0 viscosity alone
  int boundary_points = 0;              ///< rays of the predicted boundary in a map; 0: none
  std::vector<StabilityCase> cases;

  /// All that decides what becomes of a case, as text.
  [[nodiscard]] std::string content(const StabilityCase& one) const {
    return "limits of " + one.name() + "\n" + toml;
  }
  /// What a case costs, in particle-steps, roughly.
  [[nodiscard]] double cost(const StabilityCase& one) const;
};

/// Reads [stability], for the schemes of a [matrix]; leaves a plan without cases when there are none. Throws
/// ConfigError.
struct MatrixEntry;
StabilityPlan read_stability(TomlTable table, const std::vector<MatrixEntry>& matrix);

/// Measures and predicts the limits of a case along all rays, then predicts the boundary.
std::vector<reports::StabilityRecord> measure_case(const std::string& study, const StabilityPlan& plan,
                                                   const StabilityCase& one);

}  // namespace verification

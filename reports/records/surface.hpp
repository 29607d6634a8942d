#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace reports {

/// profiles/<run>.surface.csv: how far a fluid with a free surface reaches, and its energies per unit depth;
/// one row a sample of the history.
struct SurfaceRow {
  double t = 0;                 ///< [s]
  double front = 0;             ///< largest x that the fluid reaches [m]
  double column_height = 0;     ///< largest y in the first column of cells [m]
  double kinetic_energy = 0;    ///< of the particles [J/m]
  double potential_energy = 0;  ///< under the body acceleration, zero at the origin [J/m]
  double elastic_energy = 0;    ///< of compression, by the equation of state [J/m]

  [[nodiscard]] double energy() const { return kinetic_energy + potential_energy + elastic_energy; }
};

/// @throws IoError
std::vector<SurfaceRow> read_surface(const std::filesystem::path& dir, const std::string& run);
void write_surface(const std::filesystem::path& dir, const std::string& run,
                   const std::vector<SurfaceRow>& rows);

}  // namespace reports

#include "reports/records/surface.hpp"

#include "reports/files/csv.hpp"
#include "reports/records/directory/result_files.hpp"

namespace reports {
namespace {

constexpr auto surface_columns = std::make_tuple(               //
    column("t", &SurfaceRow::t),                                //
    column("front", &SurfaceRow::front),                        //
    column("column_height", &SurfaceRow::column_height),        //
    column("kinetic_energy", &SurfaceRow::kinetic_energy),      //
    column("potential_energy", &SurfaceRow::potential_energy),  //
    column("elastic_energy", &SurfaceRow::elastic_energy));

std::filesystem::path surface_path(const std::filesystem::path& dir, const std::string& run) {
  return dir / "profiles" / (require_plain_name("run", run) + ".surface.csv");
}

}  // namespace

std::vector<SurfaceRow> read_surface(const std::filesystem::path& dir, const std::string& run) {
  return read_csv(surface_path(dir, run), surface_columns);
}

void write_surface(const std::filesystem::path& dir, const std::string& run,
                   const std::vector<SurfaceRow>& rows) {
  const auto path = surface_path(dir, run);
  ensure_directory(path.parent_path());
  keep_file(path, csv_text(surface_columns, rows));
}

}  // namespace reports

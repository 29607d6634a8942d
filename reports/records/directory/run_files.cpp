#include "reports/records/directory/run_files.hpp"

#include "reports/files/csv.hpp"
#include "reports/records/directory/result_files.hpp"

namespace reports {
namespace {

// As in result_files.cpp: the order is that of the columns.
constexpr auto shear_columns = std::make_tuple(   //
    column("t", &ShearRow::t),                    //
    column("location", &ShearRow::location),      //
    column("place", &ShearRow::place),            //
    column("shear_rate", &ShearRow::shear_rate),  //
    column("viscosity_ratio", &ShearRow::viscosity_ratio));

constexpr auto state_columns = std::make_tuple(         //
    column("t", &StateRow::t),                          //
    column("location", &StateRow::location),            //
    column("x", &StateRow::x),                          //
    column("y", &StateRow::y),                          //
    column("density", &StateRow::density),              //
    column("density_exact", &StateRow::density_exact),  //
    column("pressure", &StateRow::pressure),            //
    column("pressure_exact", &StateRow::pressure_exact));

constexpr auto profile_columns = std::make_tuple(  //
    column("t", &ProfileRow::t),                   //
    column("location", &ProfileRow::location),     //
    column("x", &ProfileRow::x),                   //
    column("y", &ProfileRow::y),                   //
    column("u", &ProfileRow::u),                   //
    column("v", &ProfileRow::v),                   //
    column("u_exact", &ProfileRow::u_exact),       //
    column("v_exact", &ProfileRow::v_exact));

constexpr auto history_columns = std::make_tuple(     //
    column("t", &HistoryRow::t),                      //
    column("probe", &HistoryRow::probe),              //
    column("probe_exact", &HistoryRow::probe_exact),  //
    column("mass", &HistoryRow::mass),                //
    column("momentum_x", &HistoryRow::momentum_x),    //
    column("momentum_y", &HistoryRow::momentum_y),    //
    column("impulse_x", &HistoryRow::impulse_x),      //
    column("impulse_y", &HistoryRow::impulse_y),      //
    column("kinetic_energy", &HistoryRow::kinetic_energy),
    column("kinetic_energy_exact", &HistoryRow::kinetic_energy_exact));

std::filesystem::path profile_path(const std::filesystem::path& dir, const std::string& run,
                                   const char* ending) {
  return dir / "profiles" / (require_plain_name("run", run) + ending);
}

}  // namespace

std::vector<ProfileRow> read_profile(const std::filesystem::path& dir, const std::string& run) {
  return read_csv(profile_path(dir, run, ".csv"), profile_columns);
}

void write_profile(const std::filesystem::path& dir, const std::string& run,
                   const std::vector<ProfileRow>& rows) {
  const auto path = profile_path(dir, run, ".csv");
  ensure_directory(path.parent_path());
  keep_file(path, csv_text(profile_columns, rows));
}

std::vector<HistoryRow> read_history(const std::filesystem::path& dir, const std::string& run) {
  return read_csv(profile_path(dir, run, ".history.csv"), history_columns);
}

void write_history(const std::filesystem::path& dir, const std::string& run,
                   const std::vector<HistoryRow>& rows) {
  const auto path = profile_path(dir, run, ".history.csv");
  ensure_directory(path.parent_path());
  keep_file(path, csv_text(history_columns, rows));
}

std::vector<ShearRow> read_shear(const std::filesystem::path& dir, const std::string& run) {
  return read_csv(profile_path(dir, run, ".shear.csv"), shear_columns);
}

void write_shear(const std::filesystem::path& dir, const std::string& run,
                 const std::vector<ShearRow>& rows) {
  const auto path = profile_path(dir, run, ".shear.csv");
  ensure_directory(path.parent_path());
  keep_file(path, csv_text(shear_columns, rows));
}

std::vector<StateRow> read_state(const std::filesystem::path& dir, const std::string& run) {
  return read_csv(profile_path(dir, run, ".state.csv"), state_columns);
}

void write_state(const std::filesystem::path& dir, const std::string& run,
                 const std::vector<StateRow>& rows) {
  const auto path = profile_path(dir, run, ".state.csv");
  ensure_directory(path.parent_path());
  keep_file(path, csv_text(state_columns, rows));
}

}  // namespace reports

#include "reports/records/directory/time_step_files.hpp"

#include "reports/files/csv.hpp"

namespace reports {
namespace {

constexpr auto time_step_columns = std::make_tuple(                       //
    column("run", &TimeStepRecord::run),                                  //
    column("study", &TimeStepRecord::study),                              //
    column("variant", &TimeStepRecord::variant),                          //
    column("h", &TimeStepRecord::h),                                      //
    column("dt", &TimeStepRecord::dt),                                    //
    column("bound", &TimeStepRecord::bound),                              //
    column("fraction", &TimeStepRecord::fraction),                        //
    column("stable", &TimeStepRecord::stable),                            //
    column("time_coefficient", &TimeStepRecord::time_coefficient),        //
    column("time_order", &TimeStepRecord::time_order),                    //
    column("observed_time_order", &TimeStepRecord::observed_time_order),  //
    column("space_coefficient", &TimeStepRecord::space_coefficient),      //
    column("space_order", &TimeStepRecord::space_order),                  //
    column("time_error", &TimeStepRecord::time_error),                    //
    column("space_error", &TimeStepRecord::space_error),                  //
    column("remark", &TimeStepRecord::remark));

constexpr auto pilot_columns = std::make_tuple(    //
    column("run", &PilotRecord::run),              //
    column("study", &PilotRecord::study),          //
    column("variant", &PilotRecord::variant),      //
    column("cells", &PilotRecord::cells),          //
    column("particles", &PilotRecord::particles),  //
    column("dt", &PilotRecord::dt),                //
    column("steps", &PilotRecord::steps),          //
    column("status", &PilotRecord::status),        //
    column("error", &PilotRecord::error));

}  // namespace

void read_time_steps(const std::filesystem::path& dir, Results& results) {
  if (!std::filesystem::exists(dir / "time-steps.csv")) return;
  results.time_steps = read_csv(dir / "time-steps.csv", time_step_columns);
  results.pilots = read_csv(dir / "pilots.csv", pilot_columns);
}

void write_time_steps(const std::filesystem::path& dir, const Results& results, Durability durability) {
  if (results.time_steps.empty()) return;
  write_csv(dir / "time-steps.csv", time_step_columns, results.time_steps, durability);
  write_csv(dir / "pilots.csv", pilot_columns, results.pilots, durability);
}

}  // namespace reports

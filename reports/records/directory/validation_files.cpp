#include "reports/records/directory/validation_files.hpp"

#include "reports/files/csv.hpp"

namespace reports {
namespace {

constexpr auto point_columns = std::make_tuple(           //
    column("study", &ValidationRecord::study),            //
    column("variant", &ValidationRecord::variant),        //
    column("quantity", &ValidationRecord::quantity),      //
    column("unit", &ValidationRecord::unit),              //
    column("t", &ValidationRecord::t),                    //
    column("x", &ValidationRecord::x),                    //
    column("y", &ValidationRecord::y),                    //
    column("measured", &ValidationRecord::measured),      //
    column("u_data", &ValidationRecord::u_data),          //
    column("simulated", &ValidationRecord::simulated),    //
    column("error", &ValidationRecord::error),            //
    column("u_num", &ValidationRecord::u_num),            //
    column("u_input", &ValidationRecord::u_input),        //
    column("u_val", &ValidationRecord::u_val),            //
    column("k", &ValidationRecord::coverage),             //
    column("largest", &ValidationRecord::largest),        //
    column("area_above", &ValidationRecord::area_above),  //
    column("area_below", &ValidationRecord::area_below),  //
    column("verdict", &ValidationRecord::verdict),        //
    column("borne", &ValidationRecord::borne),            //
    column("reason", &ValidationRecord::reason),          //
    column("note", &ValidationRecord::note),              //
    column("source", &ValidationRecord::source));

constexpr auto joint_columns = std::make_tuple(                    //
    column("study", &JointValidationRecord::study),                //
    column("variant", &JointValidationRecord::variant),            //
    column("quantity", &JointValidationRecord::quantity),          //
    column("unit", &JointValidationRecord::unit),                  //
    column("points", &JointValidationRecord::points),              //
    column("d2", &JointValidationRecord::distance_squared),        //
    column("p_value", &JointValidationRecord::p_value),            //
    column("bias", &JointValidationRecord::bias),                  //
    column("scatter", &JointValidationRecord::scatter),            //
    column("data_scatter", &JointValidationRecord::data_scatter),  //
    column("source", &JointValidationRecord::source),              //
    column("obtained", &JointValidationRecord::obtained),          //
    column("licence", &JointValidationRecord::licence));

constexpr auto bias_columns = std::make_tuple(            //
    column("quantity", &ValidationBiasRecord::quantity),  //
    column("studies", &ValidationBiasRecord::studies),    //
    column("pairs", &ValidationBiasRecord::pairs),        //
    column("bias", &ValidationBiasRecord::bias),          //
    column("scatter", &ValidationBiasRecord::scatter),    //
    column("data_scatter", &ValidationBiasRecord::data_scatter));

}  // namespace

void read_validation(const std::filesystem::path& dir, Results& results) {
  results.validation = read_csv(dir / "validation.csv", point_columns);
  results.joint_validation = read_csv(dir / "validation-joint.csv", joint_columns);
  results.validation_bias = read_csv(dir / "validation-bias.csv", bias_columns);
}

void write_validation(const std::filesystem::path& dir, const Results& results, Durability durability) {
  write_csv(dir / "validation.csv", point_columns, results.validation, durability);
  write_csv(dir / "validation-joint.csv", joint_columns, results.joint_validation, durability);
  write_csv(dir / "validation-bias.csv", bias_columns, results.validation_bias, durability);
}

}  // namespace reports

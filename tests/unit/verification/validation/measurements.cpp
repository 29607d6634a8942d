#include "verification/validation/measurements.hpp"

#include <cmath>

#include "reports/files/io_error.hpp"
#include "tests/catch.hpp"
#include "tests/scratch_directory.hpp"
#include "tests/study_text.hpp"
#include "verification/config/config_error.hpp"

using namespace verification;

namespace {

const std::string good = R"(# source: a book, 1999, table 3
# obtained: read from the print,
#   twice
# licence: facts
quantity,t,x,y,value,uncertainty,unit,note
u,0.5,,0.2e-3,1.5e-3,2e-5,m/s,

u,0.5,,0.4e-3,1.7e-3,2e-5,m/s,"a note, with a comma"
flow-rate,0.5,,,6.6e-7,1e-9,m2/s,
)";

MeasurementTable read(const std::string& text) {
  const ScratchDirectory scratch;
  return read_measurements(scratch.write("data.csv", text));
}

std::string refusal(const std::string& from, const std::string& to) {
  try {
    read(replaced(good, from, to));
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("Measurements: a table is read with its header and lines", "[validation]") {
  const MeasurementTable table = read(good);
  CHECK(table.source == "a book, 1999, table 3");
  CHECK(table.obtained == "read from the print, twice");
  CHECK_FALSE(table.scaled);
  REQUIRE(table.rows.size() == 3);
  CHECK(table.rows[1].note == "a note, with a comma");
  CHECK(table.rows[1].line == 8);
  CHECK(table.rows[1].y == 0.4e-3);
  CHECK(std::isnan(table.rows[1].x));
  CHECK(table.rows[0].shared == 0);
}

TEST_CASE("Measurements: an uncertainty that all values share is read, and refused where it is negative",
          "[validation]") {
  const std::string shared = replaced(good, ",uncertainty,unit", ",uncertainty,shared_uncertainty,unit");
  const std::string first = replaced(shared, "2e-5,m/s,\n\n", "2e-5,3e-5,m/s,\n\n");
  const std::string both = replaced(first, "2e-5,m/s,\"", "2e-5,,m/s,\"");
  const std::string all = replaced(both, "1e-9,m2/s", "1e-9,0,m2/s");
  const MeasurementTable table = read(all);
  REQUIRE(table.rows.size() == 3);
  CHECK(table.rows[0].shared == 3e-5);
  CHECK(table.rows[1].shared == 0);
  CHECK_THROWS_WITH(read(replaced(all, "3e-5", "-3e-5")),
                    contains("data.csv:6: column 'shared_uncertainty': -3e-5 is negative"));
}

TEST_CASE("Measurements: bad data are refused with file, row and remedy", "[validation]") {
  CHECK_THAT(refusal("2e-5,m/s,\n\n", ",m/s,\n\n"), contains("data.csv:6: column 'uncertainty' is empty"));
  CHECK_THAT(refusal("2e-5,m/s,\n\n", "0,m/s,\n\n"), contains("data.csv:6: column 'uncertainty': 0 is not"));
  CHECK_THAT(refusal("2e-5,m/s,\"", "-2e-5,m/s,\""), contains("data.csv:8: column 'uncertainty': -2e-5"));
  CHECK_THAT(refusal("2e-5,m/s,\"", "nan,m/s,\""), contains("is not a finite number"));
  CHECK_THAT(refusal("m/s,\"", "mm/s,\""),
             contains("data.csv:8: column 'unit': 'mm/s' is not the unit of 'u'"));
  CHECK_THAT(refusal("m2/s", "1"), contains("# scales: velocity length"));
  CHECK_THAT(refusal("0.4e-3", "0.2e-3"),
             contains("data.csv:8: the same quantity, time and place as in line 6"));
  CHECK_THAT(refusal("0.4e-3", ""), contains("column 'y': 'u' is measured at a place"));
  CHECK_THAT(refusal("flow-rate,0.5,,", "flow-rate,0.5,,1"), contains("has no place"));
  CHECK_THAT(refusal("flow-rate,0.5", "flow-rate,"), contains("column 't'"));
  CHECK_THAT(refusal("flow-rate", "flowrate"), contains("choose one of: u, v, flow-rate"));
  CHECK_THAT(refusal("flow-rate,0.5", "flow-rate,-0.5"), contains("data.csv:9: column 't'"));
  CHECK_THAT(refusal("1.7e-3", "nan"), contains("data.csv:8: column 'value': 'nan' is not a finite number"));
  CHECK_THAT(refusal("1.7e-3", "1.7 mm"), contains("data.csv:8: column 'value': '1.7 mm'"));
  CHECK_THAT(refusal("1.7e-3", ""), contains("data.csv:8: column 'value': ''"));
  CHECK_THAT(refusal("# licence: facts\n", ""), contains("# licence:"));
  CHECK_THROWS_AS(
      read("# source: a\n# obtained: b\n# licence: c\nquantity,t,x,y,value,uncertainty,unit,note\n"),
      ConfigError);
  CHECK_THROWS_AS(read(replaced(good, ",uncertainty,", ",sigma,")), reports::IoError);
  CHECK_THROWS_AS(read_measurements("no such file.csv"), reports::IoError);
}

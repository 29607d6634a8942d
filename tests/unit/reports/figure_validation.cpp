#include <cmath>

#include "reports/figures/figures.hpp"
#include "tests/catch.hpp"

using namespace reports;

namespace {

/// A prediction of 2 with u_num = 0.03, u_input = 0.04 and nothing measured beside it.
Results prediction() {
  ValidationRecord point;
  point.study = "s";
  point.quantity = "flow-rate";
  point.unit = "m2/s";
  point.t = 1;
  point.x = point.y = point.measured = point.u_data = point.error = std::nan("");
  point.simulated = 2;
  point.u_num = 0.03;
  point.u_input = 0.04;
  point.u_val = 0.05;
  point.coverage = 2;
  Results results;
  results.validation = {point};
  return results;
}

FigureRecord record() {
  FigureRecord record;
  record.study = "s";
  record.component = "flow-rate";
  record.figure = "f";
  record.title = "T";
  return record;
}

}  // namespace

TEST_CASE("Figure of one predicted value: it has its bar of k u, which a band over one place cannot show") {
  const std::string script = validation_figure(record(), prediction()).script;
  CHECK_THAT(script, contains("1 1.9\n1 2.1\n"));
}

TEST_CASE("Figure of the parts of one u_val: a box alone has a width") {
  const std::string script = validation_parts_figure(record(), prediction()).script;
  CHECK_THAT(script, contains("set boxwidth 0.8 absolute\n") && contains("set xrange [0.4:1.6]\n"));
  CHECK_THAT(script, contains("1 36\n") && contains("1 100\n"));
}

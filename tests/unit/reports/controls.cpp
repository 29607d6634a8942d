#include "reports/pages/sections/controls.hpp"

#include "tests/catch.hpp"

using namespace reports;

namespace {

ControlRecord planted(bool seen) {
  return {"c", "viscosity 1 % off", "l2 error", "l2 error: 0.01", 1, "controls/c", seen};
}

ControlRecord sound() {
  return {"s", "nothing: a sound solver", "", "", 0, "controls/s", true};
}

}  // namespace

TEST_CASE("a fault that no check saw stands out in every list of the controls", "[reports]") {
  const std::vector<ControlRecord> all_seen = {planted(true), sound()},
                                   one_missed = {planted(false), sound()};
  CHECK(controls_line(all_seen) == "Negative controls: 1 of 1 planted faults were seen");
  CHECK(controls_line(one_missed) == "Negative controls: 0 of 1 planted faults were seen");
  CHECK_THAT(markdown_controls(one_missed), contains("| **NOT SEEN** | viscosity 1 % off | l2 error |"));
  CHECK_THAT(markdown_controls(one_missed),
             contains("| seen | nothing: a sound solver | nothing | nothing | 0 |"));
  CHECK_THAT(markdown_controls(all_seen), !contains("NOT SEEN"));
  CHECK_THAT(html_controls(one_missed), contains("<td class=\"fail\">NOT SEEN</td>"));
  CHECK_THAT(html_controls(all_seen), !contains("NOT SEEN"));
  CHECK(markdown_controls({}).empty());
}

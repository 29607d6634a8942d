#include "verification/reading/control_reader.hpp"

namespace verification {

ControlSpec read_control(TomlTable table, const Study& study, const std::filesystem::path& file) {
  ControlSpec control;
  control.file = std::filesystem::absolute(file);
  control.planted = table.text("planted");
  if (control.planted.find_first_not_of(" \t\n") == std::string::npos)
    table.fail("planted", "must say what is wrong with the solver");
  control.exit_code = table.integer("exit_code", control.exit_code);
  if (control.exit_code != 0 && control.exit_code != 1 && control.exit_code != 3)
    table.fail("exit_code", "must be 1 (a check fails), 3 (the solver does), or 0 (nothing may fail)");
  for (TomlTable& one : table.tables("must_fail")) {
    ControlSpec::MustFail must{one.text("check"), one.text("because", ""), 1};
    const int count = one.integer("count", 1);
    if (count < 1) one.fail("count", "must be at least 1");
    if (must.check.empty()) one.fail("check", "is empty: name the check, or a part of its name");
    must.count = static_cast<std::size_t>(count);
    one.refuse_unknown_keys();
    control.must_fail.push_back(must);
  }
  if (control.must_fail.empty() != (control.exit_code == 0))
    table.fail("must_fail", control.exit_code == 0
                                ? "contradicts exit_code = 0, which says that nothing may fail"
                                : "is missing: name the checks that must be red, or set exit_code = 0");
  control.claims_refused = table.integer("claims_refused", 0);
  if (control.claims_refused < 0 || control.claims_refused > static_cast<int>(study.claims.size()))
    table.fail("claims_refused", "must lie between 0 and the number of [[statement]]s");
  if (!study.figures.empty()) table.fail("planted", "a control draws nothing: remove its [[figure]]");
  if (study.validation || study.scoreboard || !study.stability.cases.empty())
    table.fail("planted", "has no meaning beside [validation], [scoreboard] or [stability]");
  table.refuse_unknown_keys();
  return control;
}

void leave_to_control(Study& study) {
  study.runs.clear();
  study.ladder = {};
  study.matrix = false;
  study.variants = {""};
  study.solver.reset();
  study.checks.clear();
  study.claims.clear();
  study.declared_checks = study.control->expected_checks();
}

}  // namespace verification

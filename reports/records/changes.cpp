#include "reports/records/changes.hpp"

#include <fmt/format.h>

#include <map>

#include "reports/records/not_a_number.hpp"

namespace reports {
namespace {

constexpr const char *earlier_file = "provenance.json", *earlier_verdict = "before";

}  // namespace

bool is_the_earlier_run(const ChangeRecord& change) {
  return change.file == earlier_file && change.verdict == earlier_verdict;
}

ChangeRecord the_earlier_run(const std::string& name) {
  return {earlier_file, earlier_verdict, name, nan, nan, "", ""};
}

std::string changes_line(const std::optional<std::vector<ChangeRecord>>& changes) {
  if (!changes) return "nothing to compare with: the directory was empty";
  std::string before = "the run before";
  std::map<std::string, long> counts;
  for (const ChangeRecord& change : *changes) {
    if (is_the_earlier_run(change))
      before = change.name;
    else
      ++counts[change.verdict];
  }
  if (counts.empty()) return "nothing is different from " + before;
  std::string text;
  // What asks for attention first.
  for (const char* verdict : {"worse", "missing", "better", "changed", "new"})
    if (counts.contains(verdict))
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[verdict], verdict);
  return text + " than in " + before;
}

}  // namespace reports

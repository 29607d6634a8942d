#include "reports/compare/earlier_run.hpp"

#include <fmt/format.h>

#include <limits>

#include "reports/files/io_error.hpp"
#include "reports/records/changes.hpp"
#include "reports/records/directory/result_files.hpp"
#include "reports/records/provenance.hpp"

namespace reports {
namespace {

constexpr const char* compared[] = {"checks.csv", "runs.csv", "errors.csv", "orders.csv"};

}  // namespace

EarlierRun::EarlierRun(std::filesystem::path dir) : dir_(std::move(dir)) {
  try {
    for (const char* file : compared) {
      if (!std::filesystem::exists(dir_ / file)) throw IoError("no results");
      files_[file] = read_measured(dir_ / file, {});
    }
    for (const Measured& check : files_["checks.csv"])
      if (check.name == stopped_suite) throw IoError("part of a suite");
    const auto provenance = read_provenance(dir_);
    name_ = provenance ? fmt::format("the run of {} ({})", provenance->started, provenance->build.commit)
                       : "the run before";
  } catch (const IoError&) {
    files_.clear();
  }
}

void EarlierRun::write_changes() const {
  if (files_.empty()) return;
  std::vector<ChangeRecord> changes = {the_earlier_run(name_)};
  for (const auto& [file, before] : files_)
    for (const Change& change : compare_measured(file, before, read_measured(dir_ / file, {})).changes) {
      if (!change.judged) continue;
      const Measured& named = change.verdict == Verdict::Missing ? change.before : change.after;
      const double none = std::numeric_limits<double>::quiet_NaN();
      changes.push_back({file, change.verdict == Verdict::Worse ? "worse" : to_string(change.verdict),
                         named.name, change.verdict == Verdict::New ? none : change.before.value,
                         change.verdict == Verdict::Missing ? none : change.after.value, named.unit,
                         change.note});
    }
  reports::write_changes(dir_, changes);
}

}  // namespace reports

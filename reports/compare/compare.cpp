#include "reports/compare/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "reports/files/io_error.hpp"

namespace reports {
namespace {

namespace fs = std::filesystem;

/// Half width of the band about the earlier value in which a change says nothing; NaN if nobody knows.
double noise_between(const Measured& before, const Measured& after) {
  if (before.unit.empty())
    return before.relative * std::max(std::abs(before.value), std::abs(after.value)) + before.absolute;
  const double together = spreads_of_noise * std::hypot(before.relative, after.relative);
  return std::isnan(together) ? together : std::max(together, least_time_change) * std::abs(before.value);
}

/// How much worse: positive for worse, in the unit of the value.
double loss(const Measured& before, const Measured& after) {
  switch (after.sense) {
    case Sense::LowerIsBetter:
      return after.value - before.value;
    case Sense::HigherIsBetter:
      return before.value - after.value;
    case Sense::NearerIsBetter:
      return std::abs(after.value - after.target) - std::abs(before.value - after.target);
    default:
      return 0;
  }
}

Change judge(const Measured& before, const Measured& after) {
  Change change{Verdict::Same, before, after, ""};
  if (!std::isfinite(before.value) && !std::isfinite(after.value)) return change;
  if (!std::isfinite(after.value) || !std::isfinite(before.value)) {
    const bool lost = !std::isfinite(after.value);
    change.verdict = after.sense == Sense::Neutral ? Verdict::Changed
                     : lost                        ? Verdict::Worse
                                                   : Verdict::Better;
    change.note = lost ? "is no finite number any more" : "was no finite number";
    return change;
  }
  if (before.value == after.value) return change;
  const double noise = noise_between(before, after);
  if (std::isnan(noise)) {
    change.verdict = Verdict::Changed;
    change.note = "not judged: measured once";
    change.judged = false;
    return change;
  }
  if (std::abs(after.value - before.value) <= noise) return change;
  const double lost = loss(before, after);
  change.verdict = after.sense == Sense::Neutral || std::abs(lost) <= noise ? Verdict::Changed
                   : lost > 0                                               ? Verdict::Worse
                                                                            : Verdict::Better;
  return change;
}

/// For sorting: how many times larger or smaller.
double size_of(const Change& change) {
  const double ratio = std::abs(std::log(std::abs(change.after.value / change.before.value)));
  return std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio;
}

int rank(Verdict verdict) {
  switch (verdict) {
    case Verdict::Worse:
      return 0;
    case Verdict::Missing:
      return 1;
    case Verdict::New:
      return 2;
    case Verdict::Better:
      return 3;
    default:
      return 4;
  }
}

}  // namespace

std::string to_string(Verdict verdict) {
  static const char* const names[] = {"same", "better", "WORSE", "changed", "new", "missing"};
  return names[static_cast<int>(verdict)];
}

std::size_t FileComparison::count(Verdict verdict) const {
  return verdict == Verdict::Same
             ? same
             : static_cast<std::size_t>(std::ranges::count(changes, verdict, &Change::verdict));
}

bool FileComparison::regressed() const {
  return count(Verdict::Worse) > 0 || count(Verdict::Missing) > 0;
}

FileComparison compare_measured(const std::string& file, const std::vector<Measured>& before,
                                const std::vector<Measured>& after) {
  FileComparison comparison{file, {}, 0};
  std::unordered_map<std::string, const Measured*> earlier;
  for (const Measured& m : before) earlier[m.name] = &m;
  for (const Measured& m : after) {
    const auto found = earlier.find(m.name);
    if (found == earlier.end()) {
      // A statement that is new and does not hold is as bad as one that no longer holds.
      const bool red = m.statement && m.value == 0;
      comparison.changes.push_back(
          {red ? Verdict::Worse : Verdict::New, {}, m, red ? "new, and failed" : ""});
      continue;
    }
    if (found->second == nullptr) continue;  // a name that stands twice
    Change change = judge(*found->second, m);
    if (change.verdict == Verdict::Same)
      ++comparison.same;
    else
      comparison.changes.push_back(std::move(change));
    found->second = nullptr;
  }
  for (const Measured& m : before) {
    const auto found = earlier.find(m.name);
    if (found->second == &m) comparison.changes.push_back({Verdict::Missing, m, {}, ""});
  }
  std::ranges::stable_sort(comparison.changes, [](const Change& a, const Change& b) {
    if (rank(a.verdict) != rank(b.verdict)) return rank(a.verdict) < rank(b.verdict);
    return size_of(a) > size_of(b);
  });
  return comparison;
}

std::vector<FileComparison> compare_results(const fs::path& before, const fs::path& after,
                                            const CompareOptions& options) {
  if (fs::is_directory(before) != fs::is_directory(after))
    throw IoError(fmt::format("{} and {}: compare two result directories or two files", before.string(),
                              after.string()));
  if (!fs::is_directory(before) && kind_of(before) != kind_of(after))
    throw IoError(fmt::format("{} is a {} and {} a {}: compare two files of the same kind", before.string(),
                              kind_of(before), after.string(), kind_of(after)));
  if (!fs::is_directory(before))
    return {compare_measured(after.filename().string(), read_measured(before, options),
                             read_measured(after, options))};
  std::vector<FileComparison> comparison;
  bool any[2] = {false, false};
  for (const char* name : {"checks.csv", "runs.csv", "errors.csv", "orders.csv", "timing.csv", "bench.csv"}) {
    const auto read = [&](const fs::path& dir, bool& seen) {
      if (!fs::exists(dir / name)) return std::vector<Measured>();
      seen = true;
      return read_measured(dir / name, options);
    };
    const auto old_numbers = read(before, any[0]), new_numbers = read(after, any[1]);
    if (!old_numbers.empty() || !new_numbers.empty())
      comparison.push_back(compare_measured(name, old_numbers, new_numbers));
  }
  for (int i = 0; i < 2; ++i)
    if (!any[i])
      throw IoError(fmt::format("{}: no result files here (checks.csv, errors.csv, ... or bench.csv)",
                                (i == 0 ? before : after).string()));
  return comparison;
}

}  // namespace reports

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reports/files/atomic_file.hpp"
#include "reports/records/records.hpp"

// The files of a result directory. All functions throw IoError.
namespace reports {

/// Every table of `dir` (studies, runs, errors, levels, orders, checks, timing, figures); all must be there.
/// Names of runs and figures become file names, so anything but a plain name is refused here.
Results read_results(const std::filesystem::path& dir);

/// The chapters that a file names, in their order. @throws IoError
std::vector<ChapterRecord> read_chapters(const std::filesystem::path& file);
std::vector<HeadlineRecord> read_headlines(const std::filesystem::path& file);

/// changes.csv of a result directory; none where nothing lay there before. @throws IoError
std::optional<std::vector<ChangeRecord>> read_changes(const std::filesystem::path& dir);
void write_changes(const std::filesystem::path& dir, const std::vector<ChangeRecord>& changes);
void write_results(const std::filesystem::path& dir, const Results& results,
                   Durability durability = Durability::Synced);

/// Removes the tables and reports of an earlier suite, checks.csv first, and what an interrupted write left
/// (*.tmp).
void remove_tables(const std::filesystem::path& dir);

/// True for a name that is safe as a file stem: letters, digits and . _ = -, neither empty nor starting with
/// a dot, not ending in ".history", ".shear", ".state" or ".surface" (those are other files), at most 200
/// characters.
bool is_plain_name(const std::string& name);

/// Returns `name`, or throws IoError if it is no plain name. `what` says whose name it is, e.g. "run".
const std::string& require_plain_name(const char* what, const std::string& name);

}  // namespace reports

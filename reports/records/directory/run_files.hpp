#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/records/records.hpp"

// What a run leaves in `profiles` of a result directory, a table each. All functions throw IoError.
namespace reports {

/// profiles/<run>.csv. Files of runs are not flushed to disk (Durability::Unsynced), and not touched where
/// the bytes are there.
std::vector<ProfileRow> read_profile(const std::filesystem::path& dir, const std::string& run);
void write_profile(const std::filesystem::path& dir, const std::string& run,
                   const std::vector<ProfileRow>& rows);

/// profiles/<run>.history.csv
std::vector<HistoryRow> read_history(const std::filesystem::path& dir, const std::string& run);
void write_history(const std::filesystem::path& dir, const std::string& run,
                   const std::vector<HistoryRow>& rows);

/// profiles/<run>.shear.csv
std::vector<ShearRow> read_shear(const std::filesystem::path& dir, const std::string& run);
void write_shear(const std::filesystem::path& dir, const std::string& run, const std::vector<ShearRow>& rows);

/// profiles/<run>.state.csv
std::vector<StateRow> read_state(const std::filesystem::path& dir, const std::string& run);
void write_state(const std::filesystem::path& dir, const std::string& run, const std::vector<StateRow>& rows);

}  // namespace reports

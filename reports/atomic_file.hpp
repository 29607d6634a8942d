#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace reports {

/// Write `content` to `path` whole or not at all: into a temporary file of the same directory, checked,
/// flushed to disk and renamed over `path`. A reader sees the old file or the new one, never a part.
/// @throws IoError after removing the temporary file; an existing `path` is then as it was.
void write_file(const std::filesystem::path& path, std::string_view content);

/// The whole content of a file. @throws IoError if it is missing, a directory, or unreadable.
std::string read_file(const std::filesystem::path& path);

/// Make `path` and its parents, unless it is a directory already.
/// @throws IoError if that fails or `path` exists and is no directory.
void ensure_directory(const std::filesystem::path& path);

}  // namespace reports

#include "reports/figures/drawing/figure_cache.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <system_error>
#include <vector>

#include "reports/files/atomic_file.hpp"
#include "reports/files/content_hash.hpp"
#include "reports/files/io_error.hpp"

namespace reports {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view header = "mpm-verify figure, format 1\n";  // of every entry

/// One file a figure: its key in full (so that no collision goes unseen), then checksum, size and bytes of
/// each image.
std::string packed(const std::string& key, const std::string& svg, const std::string& png) {
  return fmt::format("{}{} {} {}\n{}{}", key, content_name(svg + png), svg.size(), png.size(), svg, png);
}

struct KeptImages {
  std::string svg, png;
};

std::optional<KeptImages> unpacked(const std::string& key, const std::string& bytes) {
  if (!bytes.starts_with(key)) return std::nullopt;
  const std::size_t end = bytes.find('\n', key.size());
  if (end == bytes.npos) return std::nullopt;
  const std::string head = bytes.substr(key.size(), end - key.size());
  const std::size_t first = head.find(' '), second = head.rfind(' ');
  if (first == head.npos || first == second) return std::nullopt;
  std::size_t sizes[2] = {0, 0};
  std::from_chars(head.data() + first + 1, head.data() + second, sizes[0]);
  std::from_chars(head.data() + second + 1, head.data() + head.size(), sizes[1]);
  const std::string images = bytes.substr(end + 1);
  if (sizes[0] > images.size() || sizes[1] != images.size() - sizes[0] ||
      content_name(images) != head.substr(0, first))
    return std::nullopt;
  return KeptImages{images.substr(0, sizes[0]), images.substr(sizes[0])};
}

void prune(const fs::path& directory) {
  std::vector<std::pair<fs::file_time_type, fs::path>> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory, error)) {
    std::error_code gone;
    if (entry.path().extension() != ".figure" || !is_entry(entry.path(), header)) continue;  // not ours
    files.emplace_back(entry.last_write_time(gone), entry.path());
  }
  if (files.size() <= FigureCache::limit) return;
  std::ranges::sort(files);
  files.resize(files.size() - FigureCache::limit * 3 / 4);
  for (const auto& [time, path] : files) fs::remove(path, error);
}

}  // namespace

FigureCache::FigureCache(const fs::path& directory, const std::string& program) {
  struct stat file {};
  if (directory.empty() || stat(program.c_str(), &file) != 0) return;
  directory_ = directory / "figures";
  program_ = fmt::format("{}{} {} {}.{}\n", header, program, file.st_size, file.st_mtim.tv_sec,
                         file.st_mtim.tv_nsec);
}

fs::path FigureCache::file(const std::string& script) const {
  return directory_ / (content_name(program_ + script) + ".figure");
}

bool FigureCache::fetch(const std::string& script, const fs::path& svg, const fs::path& png) const {
  std::error_code error;
  if (directory_.empty() || !fs::exists(file(script), error)) return false;
  try {
    const auto images = unpacked(program_ + script + "\n", read_entry(file(script)));
    if (!images) return false;
    write_file(svg, images->svg, Durability::Unsynced);
    write_file(png, images->png, Durability::Unsynced);
    return true;
  } catch (const IoError&) {
    fs::remove(svg, error);
    fs::remove(png, error);
    return false;
  }
}

void FigureCache::keep(const std::string& script, const fs::path& svg, const fs::path& png) const {
  if (directory_.empty()) return;
  try {
    std::error_code error;
    fs::create_directories(directory_, error);
    write_file(file(script), packed(program_ + script + "\n", read_file(svg), read_file(png)),
               Durability::Unsynced);
    prune(directory_);
  } catch (const IoError&) {
    // Drawn again next time.
  }
}

}  // namespace reports

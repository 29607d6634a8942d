#pragma once

#include <filesystem>
#include <string>

namespace reports {

/// Drawn figures, found by the content of their script and the program that draws them (path, size, time of
/// change). Threads and processes may share a directory. It is a convenience: what cannot be read is drawn
/// again, what cannot be written is not kept. Holds at most `limit` figures; the oldest go first.
class FigureCache {
 public:
  /// Keeps figures below `directory`/figures; "" for nowhere.
  FigureCache(const std::filesystem::path& directory, const std::string& program);

  /// Copies the images of this script to `svg` and `png`. False, with neither of them there, if it has none.
  bool fetch(const std::string& script, const std::filesystem::path& svg,
             const std::filesystem::path& png) const;
  void keep(const std::string& script, const std::filesystem::path& svg,
            const std::filesystem::path& png) const;

  static constexpr std::size_t limit = 2000;

 private:
  [[nodiscard]] std::filesystem::path file(const std::string& script) const;
  std::filesystem::path directory_;
  std::string program_;  // its facts, part of every key
};

}  // namespace reports

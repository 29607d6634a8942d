#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace reports {

/// `text` as a gnuplot string expression in which nothing is interpreted: no escape, no backquote, no macro.
/// Newlines stay, other control characters become blanks.
std::string gnuplot_text(std::string_view text);

/// The gnuplot program: the one that the environment variable MPM_GNUPLOT names, else `gnuplot` on PATH.
class Gnuplot {
 public:
  /// `cache`: see FigureOptions::cache.
  explicit Gnuplot(std::filesystem::path cache = {});

  bool available() const { return !program_.empty(); }
  /// What was looked for, for messages.
  const std::string& wanted() const { return wanted_; }

  /// Keep `script` as <directory>/<name>.gp and draw <name>.svg and <name>.png beside it, each whole or not
  /// at all. A figure whose script is there unchanged with both images is not drawn again. The program is
  /// started without a shell. Returns "" or, if it fails, one line with what it said.
  /// @throws IoError if the script cannot be written.
  std::string draw(const std::filesystem::path& directory, const std::string& name,
                   const std::string& script) const;

 private:
  std::string wanted_, program_;
  std::filesystem::path cache_;
};

}  // namespace reports

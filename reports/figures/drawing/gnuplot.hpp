#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace reports {

/// `text` as a gnuplot string expression in which nothing is interpreted: no escape, no backquote, no macro.
/// Newlines stay, other control characters become blanks.
std::string gnuplot_text(std::string_view text);

/// A figure to be drawn: its file name without an ending, and what gnuplot is told.
struct Drawing {
  std::string name, script;
};

/// The gnuplot program: the one that the environment variable MPM_GNUPLOT names, else `gnuplot` on PATH.
class Gnuplot {
 public:
  /// `cache`: see FigureOptions::cache.
  explicit Gnuplot(std::filesystem::path cache = {});

  bool available() const { return !program_.empty(); }
  /// What was looked for, for messages.
  const std::string& wanted() const { return wanted_; }

  /// Keep every drawing's script as <directory>/<name>.gp and draw <name>.svg and <name>.png beside it, each
  /// whole or not at all; an empty script is passed over. A figure whose script is there unchanged with both
  /// images is not drawn again. `jobs` programs at a time, started without a shell, share the work: starting
  /// one takes as long as a figure. Returns for every drawing "" or, if it fails, one line with what was
  /// said.
  /// @throws IoError if a script cannot be written.
  std::vector<std::string> draw(const std::filesystem::path& directory, const std::vector<Drawing>& drawings,
                                int jobs) const;
  /// The same for one.
  std::string draw(const std::filesystem::path& directory, const Drawing& drawing) const {
    return draw(directory, {drawing}, 1).front();
  }

 private:
  std::string wanted_, program_;
  std::filesystem::path cache_;
};

}  // namespace reports

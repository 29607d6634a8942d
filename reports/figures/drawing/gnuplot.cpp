#include "reports/figures/drawing/gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>
#include <vector>

#include "reports/figures/drawing/figure_cache.hpp"
#include "reports/files/atomic_file.hpp"
#include "reports/files/io_error.hpp"
#include "reports/files/program.hpp"
#include "reports/files/utf8.hpp"
#include "reports/process/child.hpp"
#include "reports/threads/for_each_index.hpp"

namespace reports {
namespace {

namespace fs = std::filesystem;

constexpr double longest_drawing = 60;  // [s] a figure; a second is usual

struct Outcome {
  bool well = false;
  std::string complaint;  ///< what it printed, or how it ended
};

/// Runs a program in `directory` and waits for it.
Outcome run_program(const std::string& program, const fs::path& directory,
                    const std::vector<std::string>& arguments, const std::string& name, std::size_t figures) {
  const fs::path log = directory / (name + ".log");
  ChildCommand command;
  command.arguments = {program};
  command.arguments.insert(command.arguments.end(), arguments.begin(), arguments.end());
  command.directory = directory;
  command.log = log;
  command.timeout = longest_drawing * static_cast<double>(figures);
  const ChildEnd end = run_child(command);
  Outcome outcome{end.well(), last_lines(log, 20)};
  if (!outcome.well)
    outcome.complaint = end.text() + (outcome.complaint.empty() ? "" : "; " + outcome.complaint);
  std::error_code ignored;
  fs::remove(log, ignored);
  return outcome;
}

bool holds_exactly(const fs::path& path, const std::string& content) {
  std::error_code error;
  return fs::file_size(path, error) == content.size() && !error && read_file(path) == content;
}

/// The two images of a figure. Drawn under a name with ".part" behind it.
struct Images {
  Images(const fs::path& directory, const std::string& name)
      : svg(directory / (name + ".svg")), png(directory / (name + ".png")) {}

  void remove() const {
    std::error_code error;
    for (const fs::path* image : {&svg, &png}) fs::remove(*image, error);
  }

  /// Gives both their names, or leaves neither: whether both had been drawn.
  [[nodiscard]] bool take_parts() const {
    bool drawn = true;
    std::error_code error;
    for (const fs::path* image : {&svg, &png}) {
      const fs::path part = image->string() + ".part";
      if (drawn && fs::exists(part, error) && fs::file_size(part, error) > 0) {
        fs::rename(part, *image, error);
        drawn = !error;
      } else {
        drawn = false;
      }
      fs::remove(part, error);
    }
    if (!drawn) remove();
    return drawn;
  }

  fs::path svg, png;
};

bool is_drawn(const fs::path& directory, const Drawing& drawing) {
  const Images images(directory, drawing.name);
  std::error_code error;
  return holds_exactly(directory / (drawing.name + ".gp"), drawing.script) && fs::exists(images.svg, error) &&
         fs::exists(images.png, error);
}

/// What gnuplot is given to draw a figure, whatever it has drawn before.
std::vector<std::string> drawing_arguments(const Drawing& drawing) {
  return {"-e", "reset session", "-e", "part = '.part'", drawing.name + ".gp"};
}

std::string draw_alone(const std::string& program, const fs::path& directory, const Drawing& drawing) {
  const Outcome outcome = run_program(program, directory, drawing_arguments(drawing), drawing.name, 1);
  const Images images(directory, drawing.name);
  if (images.take_parts() && outcome.well) return "";
  images.remove();
  return fmt::format("{} failed on {}: {}", program, (directory / (drawing.name + ".gp")).string(),
                     outcome.complaint.empty() ? "it wrote no image" : one_line(outcome.complaint));
}

}  // namespace

std::string gnuplot_text(std::string_view text) {
  // Octal escapes in double quotes. Single quotes would be more readable, but gnuplot loses its way in a text
  // that begins with an escaped one.
  static constexpr std::string_view special = "\"'`\\@$;#";
  std::string quoted = "\"";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const std::size_t length = character_length(text, i);
    if (length == 0) {
      quoted += '?';  // no character, or one that XML forbids
    } else if (length > 1) {
      quoted += text.substr(i, length);
      i += length - 1;
    } else if (c == '>' && i >= 2 && text.substr(i - 2, 2) == "]]") {
      quoted += " >";  // "]]>" would end the CDATA that gnuplot writes into an SVG
    } else if (c == '\n') {
      quoted += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      quoted += ' ';
    } else if (special.find(c) != special.npos) {
      quoted += fmt::format("\\{:03o}", static_cast<unsigned>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

Gnuplot::Gnuplot(fs::path cache) : cache_(std::move(cache)) {
  const char* named = std::getenv("MPM_GNUPLOT");
  wanted_ = named && *named ? named : "gnuplot";
  program_ = find_program(wanted_);
}

std::vector<std::string> Gnuplot::draw(const fs::path& directory, const std::vector<Drawing>& drawings,
                                       int jobs) const {
  const FigureCache cache(cache_, program_);
  std::vector<std::string> problems(drawings.size());
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    if (drawings[i].script.empty() || is_drawn(directory, drawings[i])) continue;
    const Images images(directory, drawings[i].name);
    // Images go first, so that an interruption cannot leave them beside a script that they were not drawn
    // from.
    images.remove();
    write_file(directory / (drawings[i].name + ".gp"), drawings[i].script);
    if (!available())
      problems[i] = fmt::format("{} not found", wanted_);
    else if (!cache.fetch(drawings[i].script, images.svg, images.png))
      missing.push_back(i);
  }

  const std::size_t batches = std::min(missing.size(), static_cast<std::size_t>(std::max(1, jobs)));
  for_each_index(batches, jobs, [&](std::size_t first) {
    std::vector<std::string> arguments;
    for (std::size_t k = first; k < missing.size(); k += batches)
      for (const std::string& argument : drawing_arguments(drawings[missing[k]]))
        arguments.push_back(argument);
    // It stops at the first script that it cannot follow, and does not say which.
    const std::size_t share = (missing.size() - first + batches - 1) / batches;
    const bool all_drawn =
        run_program(program_, directory, arguments, "batch" + std::to_string(first), share).well;
    for (std::size_t k = first; k < missing.size(); k += batches) {
      const Drawing& drawing = drawings[missing[k]];
      const Images images(directory, drawing.name);
      if (!all_drawn || !images.take_parts()) problems[missing[k]] = draw_alone(program_, directory, drawing);
      if (problems[missing[k]].empty()) cache.keep(drawing.script, images.svg, images.png);
    }
  });
  return problems;
}

}  // namespace reports

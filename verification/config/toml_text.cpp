#include "verification/config/toml_text.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "reports/files/utf8.hpp"
#include "verification/config/config_error.hpp"

namespace verification {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 24;

/// Walks over a text, knowing where strings and comments are.
class Walk {
 public:
  Walk(const std::string& text, const std::string& origin) : text_(text), origin_(origin) {}

  void run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'') {
        skip_string(c);
      } else if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else {
        outside(c);
        ++at_;
      }
    }
  }

 private:
  /// A character outside of strings and comments.
  void outside(char c) {
    if (static_cast<unsigned char>(c) >= 0x80)
      fail("a letter beyond ASCII outside of quotes: put the key or text in quotes");
    if (c == '[' || c == '{')
      deepen(++brackets_, "brackets");
    else if (c == ']' || c == '}')
      brackets_ = std::max(0, brackets_ - 1);
    // A dotted key is what has no comma, bracket, equals sign or line end in it.
    if (c == '.')
      deepen(++dots_, "keys");
    else if (!std::isalnum(static_cast<unsigned char>(c)) &&
             std::string_view("_-+ \t").find(c) == std::string_view::npos)
      dots_ = 0;
  }

  void deepen(int depth, const char* what) const {
    if (depth > deepest_nesting)
      fail(std::string(what) + " are nested more than " + std::to_string(deepest_nesting) + " deep");
  }

  /// To the end of the string that begins here: """...""" and '''...''' over lines, "..." and '...' within
  /// one.
  void skip_string(char quote) {
    const std::string three(3, quote);
    if (text_.compare(at_, 3, three) == 0) {
      for (at_ += 3; at_ < text_.size() && text_.compare(at_, 3, three) != 0; ++at_)
        if (quote == '"' && text_[at_] == '\\') ++at_;
      at_ = std::min(at_ + 3, text_.size());
      while (at_ < text_.size() && text_[at_] == quote)
        ++at_;  // a quote or two may stand before the last three
      return;
    }
    for (++at_; at_ < text_.size() && text_[at_] != quote && text_[at_] != '\n'; ++at_)
      if (quote == '"' && text_[at_] == '\\') ++at_;
    at_ = std::min(at_ + 1, text_.size());
  }

  [[noreturn]] void fail(const std::string& problem) const {
    const auto line = std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n') + 1;
    throw ConfigError(origin_ + ":" + std::to_string(line) + ": not valid TOML: " + problem);
  }

  const std::string& text_;
  const std::string& origin_;
  std::size_t at_ = 0;
  int brackets_ = 0, dots_ = 0;
};

}  // namespace

std::string read_toml_text(const std::string& path) {
  std::error_code error;
  const auto kind = std::filesystem::status(path, error).type();
  if (kind == std::filesystem::file_type::directory)
    throw ConfigError(path + ": is a directory; give the path of a TOML file");
  std::ifstream in(path, std::ios::binary);
  std::string text;
  if (in && kind != std::filesystem::file_type::character) {
    char block[1 << 16];
    while (in.read(block, sizeof block) || in.gcount() > 0) {
      text.append(block, static_cast<std::size_t>(in.gcount()));
      if (text.size() > most_bytes)
        throw ConfigError(path + ": is larger than 16 MiB; no TOML file of ours is");
    }
  }
  if (!in.eof() || in.bad()) throw ConfigError(path + ": cannot be read; give the path of a TOML file");
  return text;
}

void require_sound_toml(const std::string& text, const std::string& origin) {
  const auto line_of = [&](std::size_t at) {
    return std::to_string(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n') + 1);
  };
  if (const std::size_t at = reports::first_broken_byte(text); at != std::string::npos)
    throw ConfigError(origin + ":" + line_of(at) + ": not valid TOML: a byte that is no UTF-8");
  for (std::size_t i = 0; i < text.size(); ++i)
    if (reports::is_control(text[i]) && !(text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n'))
      throw ConfigError(origin + ":" + line_of(i) + ": not valid TOML: a control character");
  Walk(text, origin).run();
}

}  // namespace verification

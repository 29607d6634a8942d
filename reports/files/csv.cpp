#include "reports/files/csv.hpp"

#include <fmt/compile.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "reports/files/io_error.hpp"

namespace reports::csv {
namespace {

// ASCII "unit separator": stands for a newline inside quotes while the line-oriented reader is at work.
constexpr char newline_mark = '\x1f';

template <class T>
void append_number(std::string& line, T number) {
  char text[32];  // the longest, -1.7976931348623157e+308, has 24
  line.append(text, fmt::format_to(text, FMT_COMPILE("{}"), number));
}

}  // namespace

namespace {

/// Whether a spreadsheet would take a text for a formula: "=...", "@...", and "+..." or "-..." unless they
/// are numbers or a list of them.
bool looks_like_formula(std::string_view text) {
  if (text.empty()) return false;
  if (text.front() == '=' || text.front() == '@') return true;
  return (text.front() == '+' || text.front() == '-') &&
         text.find_first_not_of("0123456789.+-eE;") != text.npos && !text.ends_with("nan") &&
         !text.ends_with("inf");
}

/// The same of what is behind leading apostrophes. Such a text gets an apostrophe more when it is written,
/// which makes it text for a spreadsheet, and loses it when it is read.
bool reads_as_formula(std::string_view text) {
  return looks_like_formula(text.substr(std::min(text.find_first_not_of('\''), text.size())));
}

}  // namespace

void append_field(std::string& line, std::string_view text) {
  const std::string marked = reads_as_formula(text) ? "'" + std::string(text) : std::string();
  if (!marked.empty()) text = marked;
  const bool outer_blank = !text.empty() && (std::string_view(" \t").find(text.front()) != text.npos ||
                                             std::string_view(" \t").find(text.back()) != text.npos);
  if (!outer_blank && text.find_first_of(",\"\n\r") == text.npos) {
    line += text;
    return;
  }
  line += '"';
  for (const char c : text) {
    if (c == '"') line += '"';
    line += c;
  }
  line += '"';
}

void append_field(std::string& line, double number) {
  if (std::isnan(number)) {
    line += "nan";  // a NaN's sign means nothing, and would differ between machines
  } else {
    append_number(line, number);
  }
}

void append_field(std::string& line, long number) {
  if (number != unknown_count) append_number(line, number);
}

void append_field(std::string& line, bool truth) {
  line += truth ? "true" : "false";
}

bool parse_field(std::string_view field, std::string& text) {
  if (field.starts_with('\'') && reads_as_formula(field)) field.remove_prefix(1);
  text = field;
  std::replace(text.begin(), text.end(), newline_mark, '\n');
  return true;
}

namespace {

template <class T>
bool parse_number(std::string_view field, T& number) {
  if (field.size() > 1 && field[0] == '+' && field[1] != '-') field.remove_prefix(1);
  const char* end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, number);
  return error == std::errc() && stop == end;
}

}  // namespace

bool parse_field(std::string_view field, double& number) {
  return parse_number(field, number);
}

bool parse_field(std::string_view field, long& number) {
  if (field.empty()) {
    number = unknown_count;
    return true;
  }
  return parse_number(field, number);
}

bool parse_field(std::string_view field, bool& truth) {
  truth = field == "true" || field == "1";
  return truth || field == "false" || field == "0";
}

long Text::line_of(unsigned reader_line) const {
  if (line_numbers.empty()) return 1;
  const std::size_t index = reader_line == 0 ? 0 : reader_line - 1;
  return line_numbers[std::min(index, line_numbers.size() - 1)];
}

Text load(const std::filesystem::path& path) {
  Text text;
  text.content = read_file(path);
  bool quoted = false;
  long line = 1;
  text.line_numbers.push_back(line);
  for (char& c : text.content) {
    if (c == '\0') fail(path, line, "a zero byte: this is no text file");
    if (c == '"') quoted = !quoted;
    if (c != '\n') continue;
    ++line;
    if (quoted) {
      c = newline_mark;
    } else {
      text.line_numbers.push_back(line);
    }
  }
  if (quoted) fail(path, text.line_numbers.back(), "a quoted text is not closed");
  return text;
}

void fail(const std::filesystem::path& path, long line, const std::string& what) {
  throw IoError(fmt::format("{}:{}: {}", path.string(), line, what));
}

void fail_conversion(const std::filesystem::path& path, long line, const char* column, std::string_view field,
                     const char* type) {
  fail(path, line, fmt::format("column '{}': '{}' is not {}", column, field, type));
}

}  // namespace reports::csv

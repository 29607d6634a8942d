#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

// At -O3 gcc 12 sees, through inlining, that the library cuts file names at 255 characters, as it means to.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wstringop-truncation"
#endif
#include <libfccp/csv.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include "reports/files/atomic_file.hpp"

// CSV with a header, both ways from one declarative table of columns (result_files.cpp). Numbers are written
// in the shortest form that reads back to the same bits; text is quoted when it has a comma, quote, newline
// or outer blank. A text
// that a spreadsheet would take for a formula has an apostrophe before it, which reading takes off.
namespace reports {

/// A whole number that is not known: an empty field.
inline constexpr long unknown_count = std::numeric_limits<long>::min();

/// One column: its name in the header and the member that it holds.
template <class Record, class T>
struct Column {
  using record_type = Record;
  const char* name;
  T Record::*member;
};

template <class Record, class T>
constexpr Column<Record, T> column(const char* name, T Record::*member) {
  return {name, member};
}

namespace csv {

void append_field(std::string& line, std::string_view text);
void append_field(std::string& line, double number);
void append_field(std::string& line, long number);
void append_field(std::string& line, bool truth);

/// Convert a field; false when it does not hold a value of that type and nothing else.
bool parse_field(std::string_view field, std::string& text);
bool parse_field(std::string_view field, double& number);
bool parse_field(std::string_view field, long& number);
bool parse_field(std::string_view field, bool& truth);

/// A file made fit for the line-oriented reader: a newline inside quotes becomes the mark that parse_field
/// turns back.
struct Text {
  std::string content;
  std::vector<long> line_numbers;  ///< in the file, for each line of `content`
  long line_of(unsigned reader_line) const;
};
Text load(const std::filesystem::path& path);

[[noreturn]] void fail(const std::filesystem::path& path, long line, const std::string& what);
[[noreturn]] void fail_conversion(const std::filesystem::path& path, long line, const char* column,
                                  std::string_view field, const char* type);
template <class T>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<T, double>) return "a number";
  if constexpr (std::is_same_v<T, long>) return "a whole number";
  if constexpr (std::is_same_v<T, bool>) return "true or false";
  return "text";
}

}  // namespace csv

/// A header and one line a record.
template <class Record, class... T>
std::string csv_text(const std::tuple<Column<Record, T>...>& columns, const std::vector<Record>& records) {
  std::string content;
  std::apply([&](const auto&... c) { ((content += c.name, content += ','), ...); }, columns);
  content.back() = '\n';
  for (const Record& record : records) {
    std::apply(
        [&](const auto&... c) { ((csv::append_field(content, record.*c.member), content += ','), ...); },
        columns);
    content.back() = '\n';
  }
  return content;
}

/// Write csv_text(), whole or not at all; unsynced only where the file holds something else (keep_file): a
/// file system flushes what replaces another. @throws IoError
template <class Record, class... T>
void write_csv(const std::filesystem::path& path, const std::tuple<Column<Record, T>...>& columns,
               const std::vector<Record>& records, Durability durability = Durability::Synced) {
  if (durability == Durability::Unsynced)
    keep_file(path, csv_text(columns, records));
  else
    write_file(path, csv_text(columns, records));
}

/// Read every record of a loaded text, perhaps cut, of the file `path`. Columns may come in any order and
/// there may be more of them.
/// @throws IoError naming file, line and column: file or column missing, a field too many or too few, no
/// number.
template <class Record, class... T>
std::vector<Record> read_csv(const csv::Text& text, const std::filesystem::path& path,
                             const std::tuple<Column<Record, T>...>& columns) {
  constexpr std::size_t count = sizeof...(T);
  const char* begin = text.content.data();
  io::CSVReader<count, io::trim_chars<' ', '\t', '\r'>, io::double_quote_escape<',', '"'>,
                io::throw_on_overflow, io::empty_line_comment>
      reader(path.string(), begin, begin + text.content.size());
  const auto line = [&] { return text.line_of(reader.get_file_line()); };
  std::vector<Record> records;
  try {
    std::apply([&](const auto&... c) { reader.read_header(io::ignore_extra_column, c.name...); }, columns);
    // The reader's own conversion of floating-point numbers is inexact and knows no nan, so fields come as
    // text.
    std::array<char*, count> fields{};
    while (std::apply([&](auto&... field) { return reader.read_row(field...); }, fields)) {
      Record& record = records.emplace_back();
      std::size_t i = 0;
      const auto convert = [&](const auto& c) {
        const std::string_view field = fields[i++];
        auto& value = record.*c.member;
        if (!csv::parse_field(field, value)) {
          csv::fail_conversion(path, line(), c.name, field, csv::type_name<std::decay_t<decltype(value)>>());
        }
      };
      std::apply([&](const auto&... c) { (convert(c), ...); }, columns);
    }
  } catch (const io::error::missing_column_in_header& e) {
    csv::fail(path, 1, std::string("column '") + e.column_name + "' is missing");
  } catch (const io::error::duplicated_column_in_header& e) {
    csv::fail(path, 1, std::string("column '") + e.column_name + "' stands twice");
  } catch (const io::error::header_missing&) {
    csv::fail(path, 1, "the header is missing (empty file)");
  } catch (const io::error::too_few_columns&) {
    csv::fail(path, line(), "fewer fields than the header has columns");
  } catch (const io::error::too_many_columns&) {
    csv::fail(path, line(), "more fields than the header has columns");
  } catch (const io::error::escaped_string_not_closed&) {
    csv::fail(path, line(), "a quoted text is not closed");
  } catch (const io::error::base& e) {
    csv::fail(path, line(), e.what());
  }
  return records;
}

/// The same of a file.
template <class Record, class... T>
std::vector<Record> read_csv(const std::filesystem::path& path,
                             const std::tuple<Column<Record, T>...>& columns) {
  return read_csv(csv::load(path), path, columns);
}

}  // namespace reports

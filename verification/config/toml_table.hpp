#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace verification {

/// A table of a TOML file that knows where it stands and which of its keys were asked for, so that a wrong
/// value or a key that nobody reads is refused with file and key. Every reader throws ConfigError.
class TomlTable {
 public:
  /// Parses a whole file.
  static TomlTable from_file(const std::string& path);
  /// Parses text; `origin` stands for the file in messages.
  static TomlTable from_text(const std::string& text, const std::string& origin);

  /// Whether the key is there; from now on it counts as known.
  bool has(const std::string& key);
  /// Whether a key is there and holds a text.
  bool is_text(const std::string& key);
  /// All keys of this table, marked as read.
  std::vector<std::string> keys();

  // Required values. A number must be finite, and 0 or between 1e-30 and 1e30 in size; an integer must have
  // no fraction; a text holds no control characters but tabs and newlines.
  double number(const std::string& key);
  int integer(const std::string& key);
  std::string text(const std::string& key);
  std::vector<double> numbers(const std::string& key);
  std::vector<int> integers(const std::string& key);
  std::vector<std::string> texts(const std::string& key);

  // The same with a default for an absent key.
  double number(const std::string& key, double absent);
  int integer(const std::string& key, int absent);
  std::string text(const std::string& key, const std::string& absent);
  bool flag(const std::string& key, bool absent);

  /// A number that must be positive.
  double positive(const std::string& key);
  double positive(const std::string& key, double absent);

  /// Sub-table; an absent one reads as empty.
  TomlTable table(const std::string& key);
  /// Array of tables [[key]]; an absent one is empty.
  std::vector<TomlTable> tables(const std::string& key);

  /// Throws for the first key that was never asked for.
  void refuse_unknown_keys() const;

  /// Throws ConfigError: "file: key 'path.key': problem".
  [[noreturn]] void fail(const std::string& key, const std::string& problem) const;

  /// Throws for a key that must be there; a key of nearly that name is taken for a misspelling.
  [[noreturn]] void fail_missing(const std::string& key, const std::string& remedy) const;

  /// This table with the values of `overrides` laid over it, tables merged key by key. `name` joins the
  /// messages.
  [[nodiscard]] TomlTable overlaid_with(const TomlTable& overrides, const std::string& name) const;

  /// Copy that holds only the named top-level keys, as if the file had no others.
  [[nodiscard]] TomlTable restricted_to(const std::vector<std::string>& keys) const;

  /// Takes the key at a dotted path ("time.dt") away; whether it was there.
  bool erase(const std::string& path);

  /// Marks a key as read without reading it.
  void accept(const std::string& key);

  /// Sets a number at a dotted path ("time.dt"), making tables on the way.
  void set(const std::string& path, double value);
  void set(const std::string& path, int value);
  void set(const std::string& path, const std::string& value);
  void set(const std::string& path, const std::vector<double>& values);

  /// From now on notes every default that is taken for an absent key, here and in sub-tables made later.
  void note_defaults();
  /// This table with the defaults noted so far written out.
  [[nodiscard]] TomlTable with_defaults() const;

  /// The table as TOML text.
  [[nodiscard]] std::string print() const;
  /// The same as a table of that name, "[name]" before it.
  [[nodiscard]] std::string print_as(const std::string& name) const;

 private:
  struct Data;
  explicit TomlTable(std::shared_ptr<Data> data);
  std::shared_ptr<Data> data_;
};

}  // namespace verification

#pragma once

#include <map>
#include <set>
#include <string>

namespace verification {

/// What was asked of the tables of TOML files while it lives: every key under its dotted path, and how. So
/// the schema and the documentation of the keys are held against the readers themselves. One a thread.
class KeyJournal {
 public:
  struct Asked {
    std::set<std::string> kinds;     // number, integer, text, flag, numbers, integers, texts, table, tables
    std::set<std::string> defaults;  // as TOML text; several where a default depends on other keys
  };

  KeyJournal();
  ~KeyJournal();
  KeyJournal(const KeyJournal&) = delete;
  KeyJournal& operator=(const KeyJournal&) = delete;

  /// Writes into the journal of this thread, if there is one.
  static void asked(const std::string& path, const std::string& kind);
  static void absent(const std::string& path, const std::string& kind, const std::string& default_text);

  /// By path; entries of an array of tables share theirs ("check.kind").
  [[nodiscard]] const std::map<std::string, Asked>& keys() const { return keys_; }

 private:
  std::map<std::string, Asked> keys_;
};

}  // namespace verification

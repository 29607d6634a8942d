#include "verification/config/key_journal.hpp"

namespace verification {
namespace {

thread_local KeyJournal* journal = nullptr;

}  // namespace

KeyJournal::KeyJournal() {
  journal = this;
}

KeyJournal::~KeyJournal() {
  journal = nullptr;
}

void KeyJournal::asked(const std::string& path, const std::string& kind) {
  if (journal) journal->keys_[path].kinds.insert(kind);
}

void KeyJournal::absent(const std::string& path, const std::string& kind, const std::string& default_text) {
  if (!journal) return;
  journal->keys_[path].kinds.insert(kind);
  journal->keys_[path].defaults.insert(default_text);
}

}  // namespace verification

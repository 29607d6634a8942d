#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace verification {

/// A fault that is planted in a study on purpose, and what must be said of it: [control]. The study is judged
/// by a program of its own, as anybody's would be, and what that leaves behind is compared with this.
struct ControlSpec {
  /// A check that must be red.
  struct MustFail {
    std::string check;      ///< part of its name
    std::string because;    ///< part of its reason; "" for any
    std::size_t count = 1;  ///< of checks that this holds for
  };

  std::string planted;              ///< what is wrong
  int exit_code = 1;                ///< 0: nothing is, and nothing may be red
  std::vector<MustFail> must_fail;  ///< and no other check may
  int claims_refused = 0;           ///< [[statement]]s that must not stand
  std::filesystem::path file;       ///< of the study

  /// Checks that the control itself makes.
  [[nodiscard]] std::size_t expected_checks() const { return must_fail.size() + 8; }
};

}  // namespace verification

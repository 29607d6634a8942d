#pragma once

#include <filesystem>
#include <string>

namespace reports {

/// The browser that prints pages: $MPM_BROWSER, else the first of chromium, chromium-browser, google-chrome
/// and chrome on $PATH; "" if there is none.
std::string browser();

/// Print a page of a result directory as <dir>/report.pdf. "" when it is there, else why not, in one line.
/// @throws IoError if the directory cannot be written.
std::string print_report(const std::filesystem::path& dir, const std::string& page);

}  // namespace reports

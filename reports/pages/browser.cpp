#include "reports/pages/browser.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <system_error>

#include "reports/files/atomic_file.hpp"
#include "reports/files/io_error.hpp"
#include "reports/files/program.hpp"
#include "reports/process/child.hpp"

namespace reports {
namespace {

/// A directory in which the browser keeps what it thinks it must, gone afterwards.
class BrowserHome {
 public:
  BrowserHome() {
    std::string pattern = (std::filesystem::temp_directory_path() / "mpm-verify-browser-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw IoError("no directory can be made at " + pattern);
    path_ = pattern;
  }
  ~BrowserHome() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  BrowserHome(const BrowserHome&) = delete;
  BrowserHome& operator=(const BrowserHome&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace

std::string browser() {
  if (const char* named = std::getenv("MPM_BROWSER"); named && *named) return find_program(named);
  for (const char* name : {"chromium", "chromium-browser", "google-chrome", "chrome"})
    if (std::string found = find_program(name); !found.empty()) return found;
  return "";
}

std::string print_report(const std::filesystem::path& dir, const std::string& page) {
  const std::filesystem::path pdf = std::filesystem::absolute(dir / "report.pdf");
  std::error_code ignored;
  std::filesystem::remove(pdf, ignored);  // an earlier one would pass for this
  const std::string program = browser();
  if (program.empty())
    return "report.pdf not made: no browser; install chromium or set MPM_BROWSER, and run `mpm-verify report "
           "DIR "
           "--pdf`";
  const BrowserHome home;
  const std::filesystem::path source = home.path() / "report.html";
  write_file(source, page);
  std::vector<std::string> arguments = {"--headless",
                                        "--disable-gpu",
                                        "--no-first-run",
                                        "--disable-extensions",
                                        "--disable-background-networking",
                                        "--disable-component-update",
                                        "--disable-sync",
                                        "--no-pdf-header-footer",
                                        "--user-data-dir=" + (home.path() / "profile").string(),
                                        "--print-to-pdf=" + pdf.string(),
                                        "file://" + source.string()};
  // Its sandbox does not work for root, and the page is our own.
  if (geteuid() == 0) arguments.insert(arguments.begin(), "--no-sandbox");
  ChildCommand command;
  command.arguments = {program};
  command.arguments.insert(command.arguments.end(), arguments.begin(), arguments.end());
  command.directory = home.path();
  command.log = home.path() / "log";
  command.timeout = 180;  // seconds; ten are usual
  const ChildEnd end = run_child(command);
  if (end.well() && std::filesystem::exists(pdf) && std::filesystem::file_size(pdf, ignored) > 0) return "";
  return fmt::format("report.pdf not made: {} failed: {}; {}", program, end.text(),
                     one_line(last_lines(command.log, 5)));
}

}  // namespace reports

#include "verification/suite/build_identity.hpp"

#include <fmt/format.h>
#include <link.h>
#include <sys/stat.h>

#include "reports/files/atomic_file.hpp"
#include "reports/files/content_hash.hpp"
#include "reports/files/io_error.hpp"
#include "reports/records/provenance.hpp"

namespace verification {
namespace {

int append_library(dl_phdr_info* info, std::size_t, void* facts) {
  struct stat file {};
  // The program itself and the kernel's page have no file name here.
  if (info->dlpi_name == nullptr || stat(info->dlpi_name, &file) != 0) return 0;
  *static_cast<std::string*>(facts) +=
      fmt::format("{} {} {}.{}\n", info->dlpi_name, file.st_size, file.st_mtim.tv_sec, file.st_mtim.tv_nsec);
  return 0;
}

std::string compute() {
  std::string facts;
  try {
    facts = reports::content_name(reports::read_file("/proc/self/exe")) + "\n";
  } catch (const reports::IoError&) {
    return "";
  }
  dl_iterate_phdr(append_library, &facts);
  return reports::content_name(facts + reports::this_machine().cpu);
}

}  // namespace

const std::string& program_identity() {
  static const std::string identity = [] {
    try {
      return reports::content_name(reports::read_file("/proc/self/exe"));
    } catch (const reports::IoError&) {
      return std::string();
    }
  }();
  return identity;
}

const std::string& build_identity() {
  static const std::string identity = compute();
  return identity;
}

}  // namespace verification

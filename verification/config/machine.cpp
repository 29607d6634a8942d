#include "verification/config/machine.hpp"

#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>
#include <thread>

namespace verification {
namespace {

namespace fs = std::filesystem;

const fs::path cgroups = "/sys/fs/cgroup";

std::string first_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

/// The group of this process below the control groups' root: "0::/path" (v2), or that of a controller (v1).
std::string own_group(const std::string& controller) {
  std::ifstream in("/proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    if (controllers == "," + std::string() + "," ||
        controllers.find("," + controller + ",") != std::string::npos)
      return line.substr(second + 1);
  }
  return "/";
}

/// The least of what `read` finds in a group and in all above it. A container may see its own group as the
/// root.
std::optional<double> least_upwards(const fs::path& root, const std::string& group,
                                    const std::function<std::optional<double>(const fs::path&)>& read) {
  std::optional<double> least;
  fs::path at = (root / fs::path(group).relative_path()).lexically_normal();
  for (int level = 0; level < 64; ++level) {
    if (const auto found = read(at); found && (!least || *found < *least)) least = found;
    if (at == root || at == at.parent_path()) break;
    at = at.parent_path();
  }
  return least;
}

std::optional<double> number_in(const fs::path& file) {
  std::istringstream text(first_line(file));
  double value = 0;
  return text >> value ? std::optional(value) : std::nullopt;
}

/// Of the machine, and what the control groups leave of it [bytes].
double memory_of_groups() {
  double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  for (const fs::path& root : {cgroups, cgroups / "memory"})
    if (const auto limit = cgroup_memory(root, own_group("memory"))) bytes = std::min(bytes, *limit);
  return bytes;
}

}  // namespace

std::optional<double> cores_of_quota(const std::string& text) {
  std::istringstream words(text);
  double quota = 0, period = 0;
  if (!(words >> quota >> period) || !(quota > 0) || !(period > 0)) return std::nullopt;
  return quota / period;
}

std::optional<double> cgroup_cores(const fs::path& root, const std::string& group) {
  return least_upwards(root, group, [](const fs::path& at) -> std::optional<double> {
    if (const auto v2 = cores_of_quota(first_line(at / "cpu.max"))) return v2;
    return cores_of_quota(first_line(at / "cpu.cfs_quota_us") + " " + first_line(at / "cpu.cfs_period_us"));
  });
}

std::optional<double> cgroup_memory(const fs::path& root, const std::string& group) {
  return least_upwards(root, group, [](const fs::path& at) -> std::optional<double> {
    if (const auto v2 = number_in(at / "memory.max")) return v2;
    return number_in(at / "memory.limit_in_bytes");
  });
}

int available_cores() {
  int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0) cores = std::max(1, CPU_COUNT(&set));
  for (const fs::path& root : {cgroups, cgroups / "cpu"})
    if (const auto quota = cgroup_cores(root, own_group("cpu")))
      cores = std::min(cores, std::max(1, static_cast<int>(std::ceil(std::min(*quota, 1e6) - 1e-9))));
  return cores;
}

double available_memory() {
  // Read once: a suite asks for each of its runs, and the control groups are a dozen small files.
  static const double of_groups = memory_of_groups();
  double bytes = of_groups;
  rlimit own{};
  if (getrlimit(RLIMIT_AS, &own) == 0 && own.rlim_cur != RLIM_INFINITY)
    bytes = std::min(bytes, static_cast<double>(own.rlim_cur));
  return bytes;
}

}  // namespace verification

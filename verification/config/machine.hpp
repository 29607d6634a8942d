#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace verification {

/// Cores that this process may keep busy, at least 1: those that it may run on, or what the quota of its
/// container (cgroup v2 cpu.max, v1 cpu.cfs_quota_us) amounts to, rounded up, if that is less.
int available_cores();

/// Memory that this process may use [B]: the machine's, its container's limit, its own (ulimit -v), whichever
/// is least.
double available_memory();

/// Cores' worth of a quota as the kernel writes it: "max 100000" (none), "150000 100000" (1.5).
std::optional<double> cores_of_quota(const std::string& text);

/// The quota and the memory limit [B] that hold in a tree of control groups for the group `/path` and those
/// above it.
std::optional<double> cgroup_cores(const std::filesystem::path& root, const std::string& group);
std::optional<double> cgroup_memory(const std::filesystem::path& root, const std::string& group);

}  // namespace verification

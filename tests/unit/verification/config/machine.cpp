#include "verification/config/machine.hpp"

#include <filesystem>

#include "tests/catch.hpp"
#include "tests/scratch_directory.hpp"

using namespace verification;

TEST_CASE("a container's quota counts as the cores that it amounts to") {
  CHECK(cores_of_quota("150000 100000") == 1.5);
  CHECK_FALSE(cores_of_quota("max 100000"));
  CHECK_FALSE(cores_of_quota("-1 100000"));  // v1's way to say none
  CHECK_FALSE(cores_of_quota(""));
}

TEST_CASE("limits of control groups hold for all below: the least counts, in either version") {
  const ScratchDirectory root;
  std::filesystem::create_directories(root / "pod/box");
  root.write("pod/cpu.max", "200000 100000\n");
  root.write("pod/box/cpu.max", "max 100000\n");
  root.write("pod/memory.max", "1048576\n");
  root.write("pod/box/memory.max", "max\n");
  CHECK(cgroup_cores(root.path(), "/pod/box") == 2);
  CHECK(cgroup_memory(root.path(), "/pod/box") == 1048576);
  CHECK_FALSE(cgroup_cores(root.path(), "/"));
  root.write("cpu.cfs_quota_us", "50000\n");
  root.write("cpu.cfs_period_us", "100000\n");
  CHECK(cgroup_cores(root.path(), "/") == 0.5);
  CHECK(cgroup_cores(root.path(), "/pod/box") == 0.5);
  CHECK(available_cores() >= 1);
  CHECK(available_memory() > 1e6);
}

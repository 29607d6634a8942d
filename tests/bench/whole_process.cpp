#include "tests/bench/whole_process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <stdexcept>

#include "reports/compare/compare.hpp"
#include "tests/bench/plain/plain_loop.hpp"

namespace bench {
namespace {

namespace fs = std::filesystem;

struct Wall {
  double fastest, spread;  // [s], (median - fastest)/fastest
};

Wall wall_of(int repetitions, const std::function<void()>& work) {
  std::vector<double> walls;
  for (int i = 0; i < repetitions; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    walls.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  std::ranges::sort(walls);
  const double median = walls[walls.size() / 2];
  return {walls.front(),
          walls.size() > 1 ? median / walls.front() - 1 : std::numeric_limits<double>::quiet_NaN()};
}

void paper_run_by_plain_loop() {
  plain::Loop<plain::Newtonian> loop({0.5e-3, 1e-3, 10, 20, 2, 1000, 143, 8e-3, true}, {1e-3});
  for (int step = 0; step < 200'000; ++step) loop.step(5e-6);
  if (!(loop.particles().front().u > 0)) throw std::runtime_error("the plain loop did not move");
}

void solve(const std::string& scene, const fs::path& out) {
  const std::string command = fmt::format("'{}' solve '{}/{}.toml' --no-figures --out '{}' > /dev/null",
                                          MPM_VERIFY_PROGRAM, MPM_SCENES, scene, out.string());
  if (std::system(command.c_str()) != 0) throw std::runtime_error("this failed: " + command);
}

/// Largest relative L2 error of all output times, grid and particles.
double largest_error(const fs::path& out) {
  double largest = 0;
  for (const reports::Measured& error : reports::read_measured(out / "errors.csv", {}))
    if (error.name.ends_with("l2") && !(error.value <= largest)) largest = error.value;
  return largest;
}

}  // namespace

std::vector<reports::BenchRecord> whole_processes() {
  std::vector<reports::BenchRecord> records;
  const Wall plain = wall_of(2, paper_run_by_plain_loop);
  records.push_back({"whole/plain-loop", "wall time of the paper's run", plain.fastest, "s", plain.spread});
  const fs::path out = fs::temp_directory_path() / fmt::format("mpm-bench-{}", std::rand());
  const auto record = [&](const std::string& scene, const Wall& wall) {
    records.push_back({"whole/" + scene, "wall time", wall.fastest, "s", wall.spread});
    records.push_back({"whole/" + scene, "largest relative L2 error", largest_error(out), "1", 0});
  };
  for (const std::string scene : {"poiseuille-paper", "poiseuille-1e-3", "poiseuille-1e-5"}) {
    const Wall wall = wall_of(scene == "poiseuille-paper" ? 3 : 7, [&] { solve(scene, out); });
    record(scene, wall);
    records.push_back({"whole/" + scene, "plain loop's time over it", plain.fastest / wall.fastest, "1",
                       std::hypot(plain.spread, wall.spread)});
  }
  const std::string vortices = "taylor-green-2.5e-4";
  record(vortices, wall_of(7, [&] { solve(vortices, out); }));
  fs::remove_all(out);
  return records;
}

}  // namespace bench

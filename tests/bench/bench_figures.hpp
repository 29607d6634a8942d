#pragma once

#include <filesystem>
#include <string>

#include "tests/bench/collector.hpp"

namespace bench {

/// Draws bench-size (rate against number of particles, with the machine's roofs) and bench-schemes (rate of
/// every basis and fluid) into `directory`. Returns "" or what gnuplot said.
std::string draw_figures(const std::filesystem::path& directory, const Collector& rates);

}  // namespace bench

#pragma once

#include <vector>

#include "tests/bench/collector.hpp"

namespace bench {

/// What the rates say together: speed over the plain loop of the same run, growth of cost with the number of
/// particles, gain by a second thread, part of the machine's peaks. Quantities whose benchmarks did not run
/// (a filter) are left out.
std::vector<reports::BenchRecord> derived(const Collector& rates);

}  // namespace bench

#pragma once

#include <string>
#include <vector>

#include "reports/records/directory/bench_file.hpp"

namespace bench {

/// Whole processes against the plain loop: the paper's own run (800 particles, 200,000 steps), and the
/// shortest way of the program to an error of 1e-3 and 1e-5 at all five output times; and the way to vortices
/// right to 2.5e-4. Every record's benchmark begins with "whole/". Throws std::runtime_error when the program
/// fails.
std::vector<reports::BenchRecord> whole_processes();

}  // namespace bench

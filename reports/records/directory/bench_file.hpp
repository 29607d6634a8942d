#pragma once

#include <string>
#include <tuple>

#include "reports/files/csv.hpp"

namespace reports {

/// bench.csv: one number of a benchmark.
struct BenchRecord {
  std::string benchmark, quantity;
  double value = 0;
  std::string unit;
  double spread = 0;  ///< relative, from the repetitions; NaN for a single one
};

inline constexpr auto bench_columns =
    std::make_tuple(column("benchmark", &BenchRecord::benchmark), column("quantity", &BenchRecord::quantity),
                    column("value", &BenchRecord::value), column("unit", &BenchRecord::unit),
                    column("spread", &BenchRecord::spread));

}  // namespace reports

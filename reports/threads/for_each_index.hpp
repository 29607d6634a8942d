#pragma once

#include <cstddef>
#include <functional>

namespace reports {

/// Calls body(i) for every i below `count` on `jobs` threads. The first exception ends it and is thrown.
void for_each_index(std::size_t count, int jobs, const std::function<void(std::size_t)>& body);

}  // namespace reports

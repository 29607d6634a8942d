#include "reports/threads/for_each_index.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace reports {

void for_each_index(std::size_t count, int jobs, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr cause;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        body(i);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!cause) cause = std::current_exception();
        next = count;
      }
    }
  };
  {
    std::vector<std::jthread> pool;
    try {
      for (int i = 1; i < jobs; ++i) pool.emplace_back(work);
    } catch (const std::system_error&) {
      // A limit on processes: those that there are share out the work.
    }
    work();
  }
  if (cause) std::rethrow_exception(cause);
}

}  // namespace reports

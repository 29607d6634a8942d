#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace mpm {

/// Threads that stay ready from one loop to the next. Who does which share of a loop is left to chance; what
/// each share is, is not, so results do not depend on the number of threads.
class ThreadTeam {
 public:
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  /// task(context, k) for every k in [0, shares), on all threads; returns when all are done.
  void run(int shares, void (*task)(void* context, int share), void* context);

 private:
  void serve();
  void work();

  std::mutex mutex_;
  std::condition_variable begun_, done_;
  long loop_ = 0;  // number of the loop in work
  int busy_ = 0;   // helpers that have not ended it
  bool over_ = false;
  int shares_ = 0;
  std::atomic<int> next_ = 0;
  void (*task_)(void*, int) = nullptr;
  void* context_ = nullptr;
  std::vector<std::jthread> helpers_;
};

}  // namespace mpm

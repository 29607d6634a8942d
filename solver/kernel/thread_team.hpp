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

  /// task(k) for every k in [0, shares), on all threads; returns when all are done.
  template <class Task>
  void run(int shares, const Task& task) {
    run(
        shares, [](const void* context, int share) { (*static_cast<const Task*>(context))(share); }, &task);
  }

 private:
  void run(int shares, void (*task)(const void* context, int share), const void* context);
  void serve();
  void work();

  std::mutex mutex_;
  std::condition_variable begun_, done_;
  long loop_ = 0;  // number of the loop in work
  int busy_ = 0;   // helpers that have not ended it
  bool over_ = false;
  int shares_ = 0;
  std::atomic<int> next_ = 0;
  void (*task_)(const void*, int) = nullptr;
  const void* context_ = nullptr;
  std::vector<std::jthread> helpers_;
};

}  // namespace mpm

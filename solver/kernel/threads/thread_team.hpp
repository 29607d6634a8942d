#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
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

  /// task(k) for every k in [0, shares), on all threads; returns when all are done. At most `most_shares`.
  template <class Task>
  void run(int shares, const Task& task) {
    run(
        shares, [](const void* context, int share) { (*static_cast<const Task*>(context))(share); }, &task);
  }

  static constexpr int most_shares = (1 << 20) - 1;

 private:
  void run(int shares, void (*task)(const void* context, int share), const void* context);
  void serve(std::size_t self);
  void work(std::size_t self, std::uint64_t loop);

  /// The shares that a thread begins with: the same ones in every loop, so that it finds in its cache what it
  /// left there. Whoever has done his own takes over those that others have not begun, so that nobody waits
  /// for a thread that the system has put aside. Number of the loop, next share and end in one word: who
  /// comes late to a loop finds that it is over.
  struct alignas(64) Range {
    std::atomic<std::uint64_t> left = 0;
  };

  std::vector<Range> ranges_;  // of every thread
  void (*task_)(const void*, int) = nullptr;
  const void* context_ = nullptr;
  std::atomic<std::uint32_t> loop_ = 0;  // number of the loop in work
  std::atomic<int> undone_ = 0;          // shares of it
  std::atomic<bool> over_ = false;
  std::vector<std::jthread> helpers_;
};

}  // namespace mpm

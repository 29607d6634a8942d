#include "solver/kernel/thread_team.hpp"

#include <system_error>

namespace mpm {
namespace {

/// Loops follow each other within microseconds, and it takes tens of them to wake a thread that sleeps: so
/// many looks before it goes to sleep.
constexpr int looks = 2000;

void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

/// Until it no longer is `old`.
template <class Number>
void wait_while(const std::atomic<Number>& value, Number old) {
  for (int look = 0; look < looks; ++look) {
    if (value != old) return;
    pause();
  }
  value.wait(old);
}

}  // namespace

ThreadTeam::ThreadTeam(int threads) : ranges_(static_cast<std::size_t>(threads)) {
  try {
    for (std::size_t k = 1; k < ranges_.size(); ++k) helpers_.emplace_back([this, k] { serve(k); });
  } catch (const std::system_error&) {
    // A limit on processes: those that there are share out the work.
  }
}

ThreadTeam::~ThreadTeam() {
  over_ = true;
  ++loop_;
  loop_.notify_all();
}

void ThreadTeam::run(int shares, void (*task)(const void* context, int share), const void* context) {
  if (helpers_.empty() || shares < 2) {
    for (int share = 0; share < shares; ++share) task(context, share);
    return;
  }
  task_ = task;
  context_ = context;
  const auto threads = static_cast<long>(helpers_.size() + 1);
  for (long k = 0; k < threads; ++k) {
    Range& range = ranges_[static_cast<std::size_t>(k)];
    range.next = static_cast<int>(shares * k / threads);
    range.end = static_cast<int>(shares * (k + 1) / threads);
  }
  busy_ = static_cast<int>(helpers_.size());
  ++loop_;
  loop_.notify_all();
  work(0);
  for (int busy = busy_; busy > 0; busy = busy_) wait_while(busy_, busy);
}

void ThreadTeam::serve(std::size_t self) {
  for (unsigned seen = 0;; ++seen) {
    wait_while(loop_, seen);
    if (over_) return;
    work(self);
    if (--busy_ == 0) busy_.notify_one();
  }
}

void ThreadTeam::work(std::size_t self) {
  const std::size_t threads = helpers_.size() + 1;
  for (std::size_t k = 0; k < threads; ++k) {
    Range& range = ranges_[(self + k) % threads];
    for (int share = range.next++; share < range.end; share = range.next++) task_(context_, share);
  }
}

}  // namespace mpm

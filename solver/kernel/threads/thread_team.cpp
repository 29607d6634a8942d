#include "solver/kernel/threads/thread_team.hpp"

#include <system_error>
#include <thread>

namespace mpm {
namespace {

/// Loops follow each other within microseconds, or when one thread has done what it does alone between two
/// steps, tens of microseconds: less than it takes to wake a thread that sleeps. So many looks before a
/// thread lets others have its core, so many times (some tenths of a millisecond) before it goes to sleep.
constexpr int looks = 2000, yields = 2000;

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
  for (int look = 0; look < yields; ++look) {
    if (value != old) return;
    std::this_thread::yield();
  }
  value.wait(old);
}

// A range in a word.
constexpr int bits = 20;
constexpr std::uint64_t all = (std::uint64_t{1} << bits) - 1;

std::uint64_t word(std::uint64_t loop, int next, int end) {
  return (loop << 2 * bits) | (static_cast<std::uint64_t>(next) << bits) | static_cast<std::uint64_t>(end);
}
bool is_of(std::uint64_t range, std::uint64_t loop) {
  return range >> 2 * bits == (loop << 2 * bits) >> 2 * bits;
}
int next(std::uint64_t range) {
  return static_cast<int>((range >> bits) & all);
}
int end(std::uint64_t range) {
  return static_cast<int>(range & all);
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
  if (helpers_.empty() || shares < 2 || shares > most_shares) {
    for (int share = 0; share < shares; ++share) task(context, share);
    return;
  }
  task_ = task;
  context_ = context;
  undone_ = shares;
  const std::uint32_t loop = loop_ + 1;
  const auto threads = static_cast<long>(ranges_.size());
  for (long k = 0; k < threads; ++k)
    ranges_[static_cast<std::size_t>(k)].left =
        word(loop, static_cast<int>(shares * k / threads), static_cast<int>(shares * (k + 1) / threads));
  loop_ = loop;
  loop_.notify_all();
  work(0, loop);
  for (int undone = undone_; undone > 0; undone = undone_) wait_while(undone_, undone);
}

void ThreadTeam::serve(std::size_t self) {
  for (std::uint32_t seen = 0;;) {
    wait_while(loop_, seen);
    seen = loop_;
    if (over_) return;
    work(self, seen);
  }
}

void ThreadTeam::work(std::size_t self, std::uint64_t loop) {
  for (std::size_t k = 0; k < ranges_.size(); ++k) {
    std::atomic<std::uint64_t>& left = ranges_[(self + k) % ranges_.size()].left;
    for (std::uint64_t range = left; is_of(range, loop) && next(range) < end(range);) {
      if (!left.compare_exchange_weak(range, word(loop, next(range) + 1, end(range)))) continue;
      // Claimed: the loop is not over before this share is done.
      task_(context_, next(range));
      if (--undone_ == 0) undone_.notify_one();
      range = left;
    }
  }
}

}  // namespace mpm

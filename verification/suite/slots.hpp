#pragma once

#include <algorithm>
#include <condition_variable>
#include <mutex>

namespace verification {

/// Cores that jobs share: a job that keeps several busy starts when so many are free. First come, first
/// served, so that it does start; one that asks for more than there are gets them all.
class Slots {
 public:
  /// Before any is held.
  void set(int total) { total_ = free_ = std::max(1, total); }

  class Hold {
   public:
    Hold(Slots& slots, int count) : slots_(slots), count_(std::clamp(count, 1, slots.total_)) {
      std::unique_lock lock(slots_.mutex_);
      const long mine = slots_.next_ticket_++;
      slots_.changed_.wait(lock, [&] { return slots_.served_ == mine && slots_.free_ >= count_; });
      ++slots_.served_;
      slots_.free_ -= count_;
      slots_.changed_.notify_all();
    }
    ~Hold() {
      const std::scoped_lock lock(slots_.mutex_);
      slots_.free_ += count_;
      slots_.changed_.notify_all();
    }
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;

   private:
    Slots& slots_;
    int count_;
  };

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int total_ = 1, free_ = 1;
  long next_ticket_ = 0, served_ = 0;
};

}  // namespace verification

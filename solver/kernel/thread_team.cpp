#include "solver/kernel/thread_team.hpp"

#include <system_error>

namespace mpm {

ThreadTeam::ThreadTeam(int threads) {
  try {
    for (int i = 1; i < threads; ++i) helpers_.emplace_back([this] { serve(); });
  } catch (const std::system_error&) {
    // A limit on processes: those that there are share out the work.
  }
}

ThreadTeam::~ThreadTeam() {
  {
    const std::scoped_lock lock(mutex_);
    over_ = true;
  }
  begun_.notify_all();
}

void ThreadTeam::run(int shares, void (*task)(const void* context, int share), const void* context) {
  if (helpers_.empty() || shares < 2) {
    for (int share = 0; share < shares; ++share) task(context, share);
    return;
  }
  {
    const std::scoped_lock lock(mutex_);
    shares_ = shares;
    task_ = task;
    context_ = context;
    next_ = 0;
    busy_ = static_cast<int>(helpers_.size());
    ++loop_;
  }
  begun_.notify_all();
  work();
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return busy_ == 0; });
}

void ThreadTeam::serve() {
  long seen = 0;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      begun_.wait(lock, [&] { return over_ || loop_ != seen; });
      if (over_) return;
      seen = loop_;
    }
    work();
    const std::scoped_lock lock(mutex_);
    if (--busy_ == 0) done_.notify_one();
  }
}

void ThreadTeam::work() {
  for (int share = next_++; share < shares_; share = next_++) task_(context_, share);
}

}  // namespace mpm

#include "verification/runs/interruption.hpp"

#include <atomic>
#include <csignal>

#include "reference/interruption.hpp"

namespace verification {
namespace {

std::atomic<int> received{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may touch nothing else");

constexpr int signals[] = {SIGINT, SIGTERM};
struct sigaction before[2];

extern "C" void note_signal(int signal) {
  received.store(signal, std::memory_order_relaxed);
}

}  // namespace

InterruptionGuard::InterruptionGuard() {
  received = 0;
  reference::on_every_step(throw_if_interrupted);
  struct sigaction action {};
  action.sa_handler = note_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (int i = 0; i < 2; ++i) {
    sigaction(signals[i], nullptr, &before[i]);
    if (before[i].sa_handler != SIG_IGN) sigaction(signals[i], &action, nullptr);
  }
}

InterruptionGuard::~InterruptionGuard() {
  reference::on_every_step(nullptr);
  for (int i = 0; i < 2; ++i) sigaction(signals[i], &before[i], nullptr);
}

void throw_if_interrupted() {
  if (const int signal = received.load(std::memory_order_relaxed)) throw Interrupted(signal);
}

bool interruption_noted() {
  return noted_signal() != 0;
}

int noted_signal() {
  return received.load(std::memory_order_relaxed);
}

}  // namespace verification

#pragma once

#include <exception>

namespace verification {

/// Thrown where work is given up because of SIGINT or SIGTERM.
struct Interrupted : std::exception {
  explicit Interrupted(int number) : signal(number) {}
  [[nodiscard]] const char* what() const noexcept override { return "interrupted"; }
  int signal;
};

/// While one is alive, the first SIGINT or SIGTERM only makes throw_if_interrupted() throw; a second one ends
/// the program at once. Integrations of references ask, too. SIGINT that was ignored (nohup, a background job
/// of a script) stays ignored.
class InterruptionGuard {
 public:
  InterruptionGuard();
  ~InterruptionGuard();
  InterruptionGuard(const InterruptionGuard&) = delete;
  InterruptionGuard& operator=(const InterruptionGuard&) = delete;
};

/// Throws Interrupted once a signal has come. Cheap enough for every time step.
void throw_if_interrupted();

/// Whether one has come: for what must end its children first.
bool interruption_noted();
/// Which; 0 for none.
int noted_signal();

}  // namespace verification

#include "verification/commands/output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

namespace verification {

void hold_standard_streams() {
  // open() gives the lowest free number.
  for (int descriptor = open("/dev/null", O_RDWR); descriptor >= 0; descriptor = open("/dev/null", O_RDWR))
    if (descriptor > STDERR_FILENO) {
      close(descriptor);
      break;
    }
  // A handler, not SIG_IGN: programs that we start get the default back.
  struct sigaction action {};
  action.sa_handler = [](int) {};
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGPIPE, &action, nullptr);
}

int finish_output(int code) {
  const bool failed = std::ferror(stdout) != 0;
  errno = 0;
  if (std::fflush(stdout) == 0 && !failed) return code;
  warn("mpm-verify: the output could not be written{}{}\n", errno ? ": " : "",
       errno ? std::strerror(errno) : "");
  return code >= 128 ? code : 2;
}

}  // namespace verification

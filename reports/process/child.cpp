#include "reports/process/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <utility>

extern char** environ;

namespace reports {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds shortest_wait{1}, longest_wait{20};
constexpr double grace = 1;  // [s] between SIGTERM and SIGKILL: two seconds end us, too

/// The groups that run, for a signal handler.
std::atomic<pid_t> running[64];
static_assert(std::atomic<pid_t>::is_always_lock_free, "a signal handler may touch nothing else");

class Running {
 public:
  explicit Running(pid_t group) {
    for (auto& slot : running) {
      pid_t free = 0;
      if (slot.compare_exchange_strong(free, group)) {
        slot_ = &slot;
        return;
      }
    }
  }
  ~Running() {
    if (slot_ != nullptr) *slot_ = 0;
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

 private:
  std::atomic<pid_t>* slot_ = nullptr;
};

extern "C" void end_children(int number) {
  for (auto& slot : running)
    if (const pid_t group = slot.load()) kill(-group, SIGKILL);
  signal(number, SIG_DFL);
  raise(number);
}

double since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::vector<std::string> environment_with(const std::map<std::string, std::string>& changes) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (!changes.contains(text.substr(0, text.find('=')))) all.push_back(text);
  }
  for (const auto& [name, value] : changes) all.push_back(name + "=" + value);
  return all;
}

std::vector<char*> pointers_to(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

/// What a child does between fork and the program that replaces it; the parent has other threads, so only
/// what is safe in a signal handler. It dies with the thread that waits for it: a process that was killed
/// outright leaves nobody behind who writes into its directories. Returns the error number where a step
/// fails.
int become(const char* program, char* const* arguments, char* const* environment, const char* directory,
           const char* log, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);  // it ended before the line above
  for (const int number : {SIGINT, SIGTERM, SIGPIPE, SIGHUP}) signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int in = open("/dev/null", O_RDONLY | O_CLOEXEC),
            out = open(log, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (in < 0 || out < 0) return errno;
  if (dup2(in, STDIN_FILENO) < 0 || dup2(out, STDOUT_FILENO) < 0 || dup2(out, STDERR_FILENO) < 0)
    return errno;
  if (*directory != '\0' && chdir(directory) != 0) return errno;
  execvpe(program, arguments, environment);
  return errno;
}

/// Starts it as the leader of a group of its own; the error number, 0 when it runs.
int start(const ChildCommand& command, pid_t& child) {
  const std::string log = command.log.empty() ? "/dev/null" : std::filesystem::absolute(command.log).string();
  const std::vector<std::string> environment = environment_with(command.environment);
  const std::vector<char*> arguments = pointers_to(command.arguments), variables = pointers_to(environment);
  const std::string directory = command.directory.string();
  const pid_t parent = getpid();
  int trouble[2];  // closed by a program that starts
  if (pipe2(trouble, O_CLOEXEC) != 0) return errno;
  sigset_t all, usual;  // our own handlers must not run in the child
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &usual);
  child = fork();
  if (child == 0) {
    const int error =
        become(arguments.front(), arguments.data(), variables.data(), directory.c_str(), log.c_str(), parent);
    _exit(write(trouble[1], &error, sizeof error) == sizeof error ? 127 : 126);
  }
  int error = child < 0 ? errno : 0;
  pthread_sigmask(SIG_SETMASK, &usual, nullptr);
  close(trouble[1]);
  if (child > 0) {
    setpgid(child, child);  // whoever is first: nobody signals a group that is not there yet
    while (read(trouble[0], &error, sizeof error) < 0 && errno == EINTR) {
    }
    if (error != 0) waitpid(child, nullptr, 0);
  }
  close(trouble[0]);
  return error;
}

}  // namespace

std::string ChildEnd::text() const {
  if (!error.empty()) return "could not be started: " + error;
  if (timed_out) return fmt::format("no end within {:.3g} s", seconds);
  if (stopped) return fmt::format("stopped after {:.3g} s", seconds);
  if (signal != 0) return fmt::format("signal {} ({}) after {:.3g} s", signal, strsignal(signal), seconds);
  return fmt::format("exit code {} after {:.3g} s", exit_code, seconds);
}

std::string ChildEnd::cause() const {
  if (!error.empty() || timed_out || stopped) return text();
  return signal != 0 ? fmt::format("signal {} ({})", signal, strsignal(signal))
                     : fmt::format("exit code {}", exit_code);
}

ChildEnd run_child(const ChildCommand& command) {
  ChildEnd end;
  if (command.arguments.empty()) {
    end.error = "no program is named";
    return end;
  }
  const auto begin = Clock::now();
  pid_t child = 0;
  if (const int error = start(command, child); error != 0) {
    end.error = command.arguments.front() + ": " + std::strerror(error);
    return end;
  }
  const Running listed(child);
  auto wait = std::chrono::duration_cast<Clock::duration>(shortest_wait);
  Clock::time_point asked_to_end;
  int status = 0;
  while (true) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) break;
    if (ended < 0 && errno != EINTR) {
      end.error = std::strerror(errno);
      break;
    }
    const bool ending = end.timed_out || end.stopped;
    if (!ending) {
      end.stopped = command.stop && command.stop();
      end.timed_out = !end.stopped && since(begin) > command.timeout;
      if (end.stopped || end.timed_out) {
        end.seconds = end.timed_out ? command.timeout : since(begin);
        asked_to_end = Clock::now();
        kill(-child, SIGTERM);
        wait = shortest_wait;
      }
    } else if (since(asked_to_end) > grace) {
      kill(-child, SIGKILL);
    }
    std::this_thread::sleep_for(wait);
    wait = std::min(2 * wait, std::chrono::duration_cast<Clock::duration>(longest_wait));
  }
  kill(-child, SIGKILL);  // what it left behind; nobody, as a rule
  if (end.timed_out || end.stopped || !end.error.empty()) return end;
  end.seconds = since(begin);
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  return end;
}

void end_children_on_signals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction present {};
    sigaction(number, nullptr, &present);
    if (present.sa_handler == SIG_IGN) continue;  // nohup, or a background job of a script
    struct sigaction action {};
    action.sa_handler = end_children;
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, nullptr);
  }
}

std::string last_lines(const std::filesystem::path& file, std::size_t lines) {
  constexpr std::streamoff most = 4096;
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) return "";
  const std::streamoff size = in.tellg(), from = std::max<std::streamoff>(0, size - most);
  in.seekg(from);
  std::string text(static_cast<std::size_t>(size - from), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::size_t begin = text.size();
  for (std::size_t k = 0; k < lines && begin != std::string::npos && begin > 0; ++k)
    begin = text.rfind('\n', begin - 1);
  return begin == std::string::npos ? text : text.substr(begin == 0 ? 0 : begin + 1);
}

std::vector<std::string> split_command(const std::string& text) {
  std::vector<std::string> words;
  std::string word;
  bool in_word = false;
  char quote = 0;
  for (const char c : text) {
    if (quote != 0) {
      if (c == quote)
        quote = 0;
      else
        word += c;
    } else if (c == '\'' || c == '"') {
      quote = c;
      in_word = true;
    } else if (c == ' ' || c == '\t' || c == '\n') {
      if (in_word) words.push_back(std::exchange(word, ""));
      in_word = false;
    } else {
      if (std::strchr("|><;&$`*?~", c) != nullptr)
        throw std::invalid_argument(std::string("'") + c +
                                    "' asks for a shell, and none reads the command: quote it, or write "
                                    "[\"sh\", \"-c\", \"...\"]");
      word += c;
      in_word = true;
    }
  }
  if (quote != 0) throw std::invalid_argument("a quote is left open");
  if (in_word) words.push_back(word);
  return words;
}

}  // namespace reports

#include "reports/process/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
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

/// Starts it as the leader of a group of its own; the error number, 0 when it runs.
int start(const ChildCommand& command, pid_t& child) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const std::string log = command.log.empty() ? "/dev/null" : std::filesystem::absolute(command.log).string();
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  if (!command.directory.empty()) posix_spawn_file_actions_addchdir_np(&actions, command.directory.c_str());

  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  posix_spawnattr_setpgroup(&attributes, 0);
  sigset_t none, usual;
  sigemptyset(&none);
  sigemptyset(&usual);
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGHUP}) sigaddset(&usual, signal);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &usual);

  const std::vector<std::string> environment = environment_with(command.environment);
  const int error = posix_spawnp(&child, command.arguments.front().c_str(), &actions, &attributes,
                                 pointers_to(command.arguments).data(), pointers_to(environment).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
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

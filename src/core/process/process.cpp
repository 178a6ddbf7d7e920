// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/process/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <string_view>
#include <thread>

#include "src/core/base/error.hpp"

namespace whipple::process {
namespace {

constexpr std::array forwarded_signals = {SIGINT, SIGTERM, SIGUSR1};

// A signal handler can only access variables with static storage.
std::atomic<pid_t> child = 0;
std::atomic<unsigned> pending = 0;  ///< signals not yet sent to the child, one bit each
std::atomic<int> last_forwarded = 0;
std::atomic<int> end_signal = 0;  ///< sent to the child for SIGINT and SIGTERM; 0: the same
static_assert(std::atomic<pid_t>::is_always_lock_free && std::atomic<unsigned>::is_always_lock_free);

/// Sends pending signals to the child once its process id is available. No signal is lost, whichever thread runs last.
void send_pending() {
  const pid_t pid = child;
  if (pid <= 0) return;
  const unsigned signals = pending.exchange(0U);
  for (const int signal : forwarded_signals) {
    if ((signals >> static_cast<unsigned>(signal) & 1U) == 0) continue;
    kill(pid, end_signal != 0 && signal != SIGUSR1 ? end_signal.load() : signal);
  }
}

extern "C" void pass_on(int signal, siginfo_t* info, void* /*context*/) {
  last_forwarded = signal;
  // The terminal sends its signals to the whole foreground group: the child has already received this one, and mpirun
  // interprets a second SIGINT as an order to kill its ranks.
  const bool from_terminal = info->si_code == SI_KERNEL && end_signal == 0;
  if (from_terminal) return;
  pending |= 1U << static_cast<unsigned>(signal);
  send_pending();
}

/// Routes the signals to `pass_on`, and blocks them in this thread until `release`. Other threads may receive one
/// before the process id of the child is available: it remains pending.
class SignalForwarding {
 public:
  explicit SignalForwarding(const Supervision& supervision) {
    end_signal = supervision.end_signal;
    sigset_t blocked;
    sigemptyset(&blocked);
    struct sigaction action = {};
    action.sa_sigaction = pass_on;
    action.sa_flags = SA_SIGINFO | SA_RESTART;
    for (std::size_t i = 0; i < forwarded_signals.size(); ++i) {
      sigaddset(&blocked, forwarded_signals[i]);
      sigaction(forwarded_signals[i], &action, &former_[i]);
    }
    last_forwarded = 0;
    pending = 0U;
    sigprocmask(SIG_BLOCK, &blocked, &former_mask_);
  }
  SignalForwarding(const SignalForwarding&) = delete;  // owns the handlers of the process
  SignalForwarding& operator=(const SignalForwarding&) = delete;
  ~SignalForwarding() {
    child = 0;
    for (std::size_t i = 0; i < forwarded_signals.size(); ++i) {
      sigaction(forwarded_signals[i], &former_[i], nullptr);
    }
    release();
  }
  void release() const { sigprocmask(SIG_SETMASK, &former_mask_, nullptr); }
  [[nodiscard]] const sigset_t& former_mask() const { return former_mask_; }

 private:
  std::array<struct sigaction, forwarded_signals.size()> former_{};
  sigset_t former_mask_{};
};

std::vector<std::string> merged_environment(const Environment& added) {
  std::vector<std::string> entries;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view entry(*variable);
    const std::string_view name = entry.substr(0, entry.find('='));
    bool replaced = false;
    for (const auto& [key, value] : added) replaced = replaced || key == name;
    if (!replaced) entries.emplace_back(entry);
  }
  for (const auto& [key, value] : added) entries.push_back(fmt::format("{}={}", key, value));
  return entries;
}

/// Returns pointers for the C interface, which takes mutable characters but does not modify them.
std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  result.reserve(texts.size() + 1);
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

pid_t start(std::vector<std::string> arguments, const Environment& environment, const sigset_t& mask,
            bool own_group) {
  std::vector<std::string> variables = merged_environment(environment);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  short flags = POSIX_SPAWN_SETSIGMASK;
  if (own_group) flags |= POSIX_SPAWN_SETPGROUP;  // its id is that of the program
  posix_spawnattr_setflags(&attributes, flags);
  posix_spawnattr_setsigmask(&attributes, &mask);
  pid_t pid = 0;
  const int fault = posix_spawnp(&pid, arguments.front().c_str(), &files, &attributes,
                                 pointers(arguments).data(), pointers(variables).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (fault != 0) {
    throw InputError(fmt::format("cannot start '{}': {} (scripts/install_deps.sh installs what is needed)",
                                 arguments.front(), std::strerror(fault)));
  }
  return pid;
}

/// Reaps terminated programs started in the background, which would remain as zombies.
void forget_ended(std::vector<pid_t>& started) {
  std::erase_if(started, [](pid_t pid) { return waitpid(pid, nullptr, WNOHANG) != 0; });
}

/// Returns whether a program has a terminated child that it has not reaped.
bool has_dead_child(pid_t pid) {
  std::error_code gone;
  for (const auto& task : std::filesystem::directory_iterator(fmt::format("/proc/{}/task", pid), gone)) {
    std::ifstream children(task.path() / "children");
    for (pid_t child_of_task = 0; children >> child_of_task;) {
      std::ifstream file(fmt::format("/proc/{}/stat", child_of_task));
      std::string stat;
      std::getline(file, stat);
      const std::size_t name_end = stat.rfind(')');  // "pid (name) state ..."
      if (name_end == std::string::npos || name_end + 2 >= stat.size()) continue;
      if (stat[name_end + 2] == 'Z') return true;
    }
  }
  return false;
}

/// Waits for the end of a program. @returns its status, as from waitpid
int wait_for(pid_t pid, const std::string& name, const Supervision& supervision) {
  using clock = std::chrono::steady_clock;
  constexpr auto pause = std::chrono::milliseconds(20);
  const auto since = [](clock::time_point begin) {
    return std::chrono::duration<double>(clock::now() - begin).count();
  };
  const bool watched = supervision.patience > 0.0 || supervision.patience_with_end > 0.0;
  auto attentive = clock::now(), looked = attentive, asked_to_end = attentive;
  for (;;) {
    int status = 0;
    const pid_t ended = waitpid(pid, &status, watched ? WNOHANG : 0);
    if (ended == pid) return status;
    if (ended < 0 && errno != EINTR) {
      throw InternalError(fmt::format("waiting for '{}': {}", name, std::strerror(errno)));
    }
    if (ended != 0) continue;
    std::this_thread::sleep_for(pause);
    const auto now = clock::now();
    if (now - looked < std::chrono::milliseconds(200)) continue;
    looked = now;
    if (supervision.patience > 0.0) {
      if (!has_dead_child(pid)) attentive = now;
      if (since(attentive) > supervision.patience) kill(pid, SIGKILL);
    }
    if (supervision.patience_with_end > 0.0) {
      const int signal = last_forwarded;
      if (signal != SIGINT && signal != SIGTERM) asked_to_end = now;
      if (since(asked_to_end) > supervision.patience_with_end) kill(-pid, SIGKILL);  // its group
    }
  }
}

}  // namespace

int run_process(const std::vector<std::string>& arguments, const Environment& environment,
                const Supervision& supervision) {
  if (arguments.empty()) throw InternalError("run_process: no program");
  const SignalForwarding forwarding(supervision);
  const pid_t pid = start(arguments, environment, forwarding.former_mask(), supervision.end_signal != 0);
  child = pid;
  send_pending();
  forwarding.release();

  const int status = wait_for(pid, arguments.front(), supervision);
  child = 0;  // its number may belong to another process from now on
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  const int signal = WTERMSIG(status);
  if (signal == last_forwarded || supervision.may_be_killed) return 128 + signal;
  throw InternalError(
      fmt::format("'{}' was ended by signal {} ({})", arguments.front(), signal, strsignal(signal)));
}

void start_in_background(const std::vector<std::string>& arguments, const std::filesystem::path& output) {
  static std::vector<pid_t> started;
  forget_ended(started);
  std::vector<std::string> program = arguments, variables = merged_environment({});
  constexpr mode_t readable = 0644;
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_APPEND,
                                   readable);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
  pid_t pid = 0;
  const int fault = posix_spawnp(&pid, program.front().c_str(), &files, &attributes, pointers(program).data(),
                                 pointers(variables).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (fault != 0) {
    throw InputError(fmt::format("cannot start '{}' with its output in {}: {}", arguments.front(),
                                 output.string(), std::strerror(fault)));
  }
  started.push_back(pid);
}

int last_signal() { return last_forwarded; }

int physical_cores() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) {
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }
  std::set<std::string> cores;
  int hardware_threads = 0;
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (!CPU_ISSET(cpu, &allowed)) continue;
    ++hardware_threads;
    std::ifstream file(fmt::format("/sys/devices/system/cpu/cpu{}/topology/thread_siblings_list", cpu));
    std::string siblings;
    if (std::getline(file, siblings)) cores.insert(siblings);
  }
  return std::max(1, cores.empty() ? hardware_threads : static_cast<int>(cores.size()));
}

}  // namespace whipple::process

// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/process/pool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>

#include "src/core/base/error.hpp"

namespace whipple::process {

Pool::Pool() {
  sigemptyset(&held_);
  for (const int signal : {SIGINT, SIGTERM, SIGCHLD}) sigaddset(&held_, signal);
  sigprocmask(SIG_BLOCK, &held_, &former_);
}

Pool::~Pool() {
  for (const auto& [pid, tag] : running_) kill(pid, SIGTERM);
  for (const auto& [pid, tag] : running_) waitpid(pid, nullptr, 0);
  sigprocmask(SIG_SETMASK, &former_, nullptr);
}

void Pool::start(std::size_t tag, const std::vector<std::string>& arguments,
                 const std::filesystem::path& output) {
  std::vector<std::string> texts = arguments;
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  const int in = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const int out = ::open(output.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (out < 0)
    throw InputError(fmt::format("{}: cannot be written: {}", output.string(), std::strerror(errno)));
  std::array<int, 2> report = {-1, -1};  // closed by the start of the program, else it contains the error
  if (::pipe2(report.data(), O_CLOEXEC) != 0) {
    const int fault = errno;
    ::close(in);
    ::close(out);
    throw InputError(fmt::format("cannot start '{}': {}", arguments.front(), std::strerror(fault)));
  }
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid == 0) {  // only calls that are safe after fork
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(127);  // this process ended meanwhile
    setpgid(0, 0);                        // Ctrl-C reaches the programs through `wait` only
    sigprocmask(SIG_SETMASK, &former_, nullptr);
    dup2(in, STDIN_FILENO);
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
    execvp(pointers.front(), pointers.data());
    const int fault = errno;
    (void)!::write(report[1], &fault, sizeof fault);
    _exit(127);
  }
  int fault = pid < 0 ? errno : 0;
  for (const int file : {in, out, report[1]}) ::close(file);
  if (pid > 0 && ::read(report[0], &fault, sizeof fault) > 0) waitpid(pid, nullptr, 0);
  ::close(report[0]);
  if (fault != 0)
    throw InputError(fmt::format("cannot start '{}': {}", arguments.front(), std::strerror(fault)));
  running_[pid] = tag;
}

std::optional<Pool::Ended> Pool::wait(double patience) {
  for (int look = 0; look < 2; ++look) {
    for (const auto& [pid, tag] : running_) {
      int status = 0;
      if (waitpid(pid, &status, WNOHANG) != pid) continue;
      const Ended ended = {tag, WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
                           WIFSIGNALED(status) ? WTERMSIG(status) : 0};
      running_.erase(pid);
      return ended;
    }
    if (look == 1) break;
    const timespec most = {static_cast<time_t>(patience),
                           static_cast<long>(1e9 * (patience - std::floor(patience)))};
    take(sigtimedwait(&held_, nullptr, &most));
  }
  return std::nullopt;
}

bool Pool::is_asked_to_end() {
  const timespec none = {};
  sigset_t of_users = held_;  // SIGCHLD is for `wait`
  sigdelset(&of_users, SIGCHLD);
  take(sigtimedwait(&of_users, nullptr, &none));
  return stopped_by_ != 0;
}

void Pool::take(int signal) {
  if (signal != SIGINT && signal != SIGTERM) return;
  stopped_by_ = signal;
  for (const auto& [pid, tag] : running_) kill(pid, SIGTERM);
}

}  // namespace whipple::process

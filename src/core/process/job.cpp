// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/process/job.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>

#include "src/core/base/error.hpp"

namespace whipple::process {
namespace {

/// Opens a file, or fails with a message.
int opened(const std::filesystem::path& file, int flags) {
  constexpr mode_t own = 0600;
  const int number = ::open(file.c_str(), flags | O_CLOEXEC, own);
  if (number < 0)
    throw InputError(fmt::format("{}: cannot be opened: {}", file.string(), std::strerror(errno)));
  return number;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

Job::Job(const std::vector<std::string>& arguments, const std::filesystem::path& output,
         const std::filesystem::path& errors, const std::filesystem::path& temporary) {
  std::vector<std::string> texts = arguments, variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (!std::string_view(*variable).starts_with("TMPDIR=")) variables.emplace_back(*variable);
  }
  variables.push_back("TMPDIR=" + temporary.string());
  const std::vector<char*> argument_pointers = pointers_to(texts), variable_pointers = pointers_to(variables);
  const int in = opened("/dev/null", O_RDONLY);
  const int out = opened(output, O_WRONLY | O_CREAT | O_TRUNC);
  const int err = opened(errors, O_WRONLY | O_CREAT | O_TRUNC);
  const pid_t parent = getpid();
  sigset_t none;
  sigemptyset(&none);
  pid_ = fork();
  if (pid_ == 0) {  // only calls that are safe after fork
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(127);  // this process ended meanwhile
    setpgid(0, 0);                        // to be ended with its children; Ctrl-C does not reach it
    sigprocmask(SIG_SETMASK, &none, nullptr);
    dup2(in, STDIN_FILENO);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    execve(argument_pointers.front(), argument_pointers.data(), variable_pointers.data());
    _exit(127);
  }
  const int fault = errno;
  for (const int file : {in, out, err}) ::close(file);
  if (pid_ < 0)
    throw InputError(fmt::format("cannot start '{}': {}", arguments.front(), std::strerror(fault)));
  setpgid(pid_, pid_);  // whoever comes first: it may be ended right now
}

Job::~Job() {
  if (code()) return;
  kill(-pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

std::optional<int> Job::code() {
  int status = 0;
  if (!code_ && waitpid(pid_, &status, WNOHANG) == pid_) {
    code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  return code_;
}

}  // namespace whipple::process

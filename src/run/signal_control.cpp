// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/signal_control.hpp"

#include <unistd.h>

#include <array>
#include <csignal>
#include <string_view>

namespace whipple::run {
namespace {

// A signal handler may only access variables of this type.
volatile std::sig_atomic_t end_signal = 0;
volatile std::sig_atomic_t checkpoint_signal = 0;
volatile std::sig_atomic_t limited = 0;  // whether the time from a signal to the end is limited
volatile std::sig_atomic_t writing = 0;  // files are being written; 0: a step is being computed

using Handler = void (*)(int);
constexpr std::array caught = {SIGINT, SIGTERM, SIGUSR1, SIGUSR2, SIGALRM};
std::array<Handler, caught.size()> former{};

/// Starts the time limit of the current operation after a signal.
void limit_time() {
  if (limited == 0 || end_signal == 0) return;
  ::alarm(writing != 0 ? SignalControl::patience_of_writing : SignalControl::patience);
}

extern "C" void on_signal(int number) {
  if (number == SIGALRM) {
    constexpr std::string_view of_step =
        "whipple: error: the ranks do not reach the end of a step: ended without saving; a run goes on from "
        "its last checkpoint with --restart\n";
    constexpr std::string_view of_writing =
        "whipple: error: the ranks do not reach the end of what they write: ended; a run goes on from its "
        "last complete checkpoint with --restart\n";
    const std::string_view text = writing != 0 ? of_writing : of_step;
    static_cast<void>(!::write(STDERR_FILENO, text.data(), text.size()));
    ::_exit(128 + end_signal);
  }
  if (number == SIGUSR1) {
    checkpoint_signal = 1;
    return;
  }
  const bool is_first = end_signal == 0;
  end_signal = number == SIGUSR2 ? SIGTERM : number;
  if (is_first) limit_time();  // the clock of the first signal continues
}

}  // namespace

SignalControl::SignalControl(bool one_of_several) {
  limited = one_of_several ? 1 : 0;
  end_signal = 0;
  checkpoint_signal = 0;
  writing = 0;
  for (std::size_t i = 0; i < caught.size(); ++i) former[i] = std::signal(caught[i], on_signal);
}

SignalControl::~SignalControl() {
  if (limited != 0) ::alarm(0);
  for (std::size_t i = 0; i < caught.size(); ++i) std::signal(caught[i], former[i]);
}

void SignalControl::ask(const Moment&, Requests& requests) {
  if (end_signal != 0) requests.signal = end_signal;
  if (checkpoint_signal != 0) requests.checkpoint = true;
  checkpoint_signal = 0;
}

void SignalControl::writing_begins() {
  writing = 1;
  limit_time();
}

void SignalControl::step_begins() {
  writing = 0;
  limit_time();
}

}  // namespace whipple::run

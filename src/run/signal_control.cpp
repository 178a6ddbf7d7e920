// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/signal_control.hpp"

#include <unistd.h>

#include <array>
#include <csignal>
#include <string_view>

namespace whipple::run {
namespace {

// A handler may only touch such variables.
volatile std::sig_atomic_t end_signal = 0;
volatile std::sig_atomic_t checkpoint_signal = 0;
volatile std::sig_atomic_t limited = 0;  // whether the time from a signal to the end is

using Handler = void (*)(int);
constexpr std::array caught = {SIGINT, SIGTERM, SIGUSR1, SIGUSR2, SIGALRM};
std::array<Handler, caught.size()> former{};

extern "C" void on_signal(int number) {
  if (number == SIGALRM) {
    constexpr std::string_view text =
        "whipple: error: the ranks do not reach the end of a step: ended without saving; a run goes on from "
        "its last checkpoint with --restart\n";
    static_cast<void>(!::write(STDERR_FILENO, text.data(), text.size()));
    ::_exit(128 + end_signal);
  }
  if (number == SIGUSR1) {
    checkpoint_signal = 1;
    return;
  }
  end_signal = number == SIGUSR2 ? SIGTERM : number;
  if (limited != 0) ::alarm(SignalControl::patience);
}

}  // namespace

SignalControl::SignalControl(bool one_of_several) {
  limited = one_of_several ? 1 : 0;
  end_signal = 0;
  checkpoint_signal = 0;
  for (std::size_t i = 0; i < caught.size(); ++i) former[i] = std::signal(caught[i], on_signal);
}

SignalControl::~SignalControl() {
  if (limited != 0) ::alarm(0);
  for (std::size_t i = 0; i < caught.size(); ++i) std::signal(caught[i], former[i]);
}

void SignalControl::ask(const Moment&, Requests& requests) {
  if (end_signal != 0) requests.signal = end_signal;
  if (end_signal != 0 && limited != 0 && !noticed_) ::alarm(patience);  // for what is saved now
  noticed_ = noticed_ || end_signal != 0;
  if (checkpoint_signal != 0) requests.checkpoint = true;
  checkpoint_signal = 0;
}

}  // namespace whipple::run

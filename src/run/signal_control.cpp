// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/signal_control.hpp"

#include <array>
#include <csignal>

namespace whipple::run {
namespace {

// A handler may only touch such variables.
volatile std::sig_atomic_t end_signal = 0;
volatile std::sig_atomic_t checkpoint_signal = 0;

using Handler = void (*)(int);
constexpr std::array caught = {SIGINT, SIGTERM, SIGUSR1, SIGUSR2};
std::array<Handler, caught.size()> former{};

extern "C" void on_signal(int number) {
  if (number == SIGUSR1) {
    checkpoint_signal = 1;
  } else {
    end_signal = number == SIGUSR2 ? SIGTERM : number;
  }
}

}  // namespace

SignalControl::SignalControl() {
  end_signal = 0;
  checkpoint_signal = 0;
  for (std::size_t i = 0; i < caught.size(); ++i) former[i] = std::signal(caught[i], on_signal);
}

SignalControl::~SignalControl() {
  for (std::size_t i = 0; i < caught.size(); ++i) std::signal(caught[i], former[i]);
}

void SignalControl::ask(const Moment&, Requests& requests) {
  if (end_signal != 0) requests.signal = end_signal;
  if (checkpoint_signal != 0) requests.checkpoint = true;
  checkpoint_signal = 0;
}

}  // namespace whipple::run

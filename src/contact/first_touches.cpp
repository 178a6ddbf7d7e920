// SPDX-License-Identifier: BSD-3-Clause
#include "src/contact/first_touches.hpp"

#include <algorithm>

#include "src/core/parallel/mpi.hpp"

namespace whipple::contact {
namespace {

constexpr double none = 1e300, touches = 0.0;
constexpr std::size_t faces = 6;

}  // namespace

FirstTouches::FirstTouches(unsigned fields)
    : fields_(fields),
      others_(std::max<std::size_t>(fields, faces)),
      words_((others_ + 63) / 64),
      touched_((fields + std::size_t{1}) * words_, 0),
      next_((fields + std::size_t{1}) * others_),
      hard_(next_.size()) {}

void FirstTouches::set(const Words& words) {
  std::ranges::fill(touched_, 0U);
  std::copy_n(words.begin(), std::min(words.size(), touched_.size()), touched_.begin());
}

void FirstTouches::begin_step(double dt, double least_speed) {
  dt_ = dt;
  least_speed_ = least_speed;
  for (auto& of_pair : next_) of_pair.store(none, std::memory_order_relaxed);
  for (auto& of_pair : hard_) of_pair.store(false, std::memory_order_relaxed);
}

void FirstTouches::look(unsigned field, unsigned other, double open, double closing) {
  const std::size_t pair = field * others_ + other;
  const bool heeded = closing >= least_speed_, in_step = touches_in(open, closing, dt_);
  if (in_step && heeded) hard_[pair].store(true, std::memory_order_relaxed);
  if (!in_step && !heeded) return;
  const double in = in_step ? touches : open / closing;
  double next = next_[pair].load(std::memory_order_relaxed);
  while (in < next && !next_[pair].compare_exchange_weak(next, in, std::memory_order_relaxed)) {
  }
}

FirstTouches::Outcome FirstTouches::end_step(MPI_Comm communicator) {
  // Negated, for the maximum over ranks; second half: contact above the speed threshold (1)
  std::vector<double> soonest(2 * next_.size());
  for (std::size_t i = 0; i < next_.size(); ++i) {
    soonest[i] = -next_[i].load(std::memory_order_relaxed);
    soonest[next_.size() + i] = hard_[i].load(std::memory_order_relaxed) ? 1.0 : 0.0;
  }
  parallel::maximum(communicator, soonest);
  Outcome outcome;
  for (std::size_t i = 0; i < next_.size(); ++i) {
    if (soonest[i] < -touches) {
      outcome.next = std::min(outcome.next, -soonest[i]);
    } else {
      word(i / others_, i % others_) |= std::uint64_t{1} << i % others_ % 64;
      outcome.hard = outcome.hard || soonest[next_.size() + i] > 0.0;
    }
  }
  return outcome;
}

}  // namespace whipple::contact

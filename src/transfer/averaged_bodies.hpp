// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/particles/particles.hpp"

namespace whipple::transfer {

/// Holds which bodies of a run are averaged over cells (docs/theory/mpm.md, 4.12 to 4.14), and numbers them.
class AveragedBodies {
 public:
  explicit AveragedBodies(const std::vector<std::uint8_t>& is_averaged) {
    for (const std::uint8_t averaged : is_averaged) {
      number_.push_back(averaged != 0 ? static_cast<std::int32_t>(count_++) : none);
    }
  }
  [[nodiscard]] bool any() const { return count_ > 0; }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] bool contain(std::uint32_t body) const { return number_[body] != none; }
  /// Returns the number of a body among the averaged ones, of which it must be one.
  [[nodiscard]] std::size_t number(std::uint32_t body) const {
    return static_cast<std::size_t>(number_[body]);
  }

 private:
  static constexpr std::int32_t none = -1;
  std::vector<std::int32_t> number_;  // of each body
  std::size_t count_ = 0;
};

/// Calls f(body, first, members) for the particles of each averaged body in a slot, which follow one another.
/// @param of_slot  as the grid lists them; `first` is the place of the members among them
template <class Function>
void for_each_averaged_body(const Particles& particles, std::span<const std::uint32_t> of_slot,
                            const AveragedBodies& bodies, Function&& f) {
  for (std::size_t first = 0, end = 0; first < of_slot.size(); first = end) {
    const std::uint32_t body = particles.body[of_slot[first]];
    for (end = first + 1; end < of_slot.size() && particles.body[of_slot[end]] == body;) ++end;
    if (bodies.contain(body)) f(body, first, of_slot.subspan(first, end - first));
  }
}

}  // namespace whipple::transfer

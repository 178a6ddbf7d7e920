// SPDX-License-Identifier: BSD-3-Clause
// Lets a whole suite run on a device: WHIPPLE_TEST_DEVICE=emulated. Tests of what a device does not compute then fail with
// its refusal; tests/device.cmake lists the others.
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "src/core/base/words.hpp"
#include "src/solver/device/device.hpp"

namespace whipple::solver {
namespace {

[[maybe_unused]] const bool selected = [] {
  const char* const word = std::getenv("WHIPPLE_TEST_DEVICE");
  if (word == nullptr) return false;
  for (const Word<Device>& known : words(Device{})) {
    if (known.text == word) default_device() = known.value;
  }
  if (word_of(default_device()) != word)
    throw std::invalid_argument(std::string("WHIPPLE_TEST_DEVICE=") + word);
  return true;
}();

}  // namespace
}  // namespace whipple::solver

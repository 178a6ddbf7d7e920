// SPDX-License-Identifier: BSD-3-Clause
#include "tests/folders.hpp"

namespace whipple::tests {

const std::string& source_folder() {
  static const std::string folder = WHIPPLE_SOURCE_DIR;
  return folder;
}

std::string program(const std::string& name) { return WHIPPLE_BINARY_DIR "/bin/" + name; }

std::string test_program(const std::string& name) { return WHIPPLE_BINARY_DIR "/tests/bin/" + name; }

}  // namespace whipple::tests

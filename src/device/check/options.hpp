// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace whipple::device::check {

enum class On { gpu, emulated };

/// Command line of the program.
struct Options {
  std::vector<std::string> files;
  On device = On::gpu;
  std::string json, markdown;  ///< files; empty: none
  std::size_t steps = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> sizes;                          ///< of timings
  std::vector<double> per_cell = {8.0, 2.0, 0.5, 0.0625};  ///< of the timings of blocks and clouds
  bool twice = false, rates = true, help = false;
};

/// Reads the command line.
/// @throws WrongInput for what is not understood
Options read_options(int argc, char** argv);

extern const char* const usage;

}  // namespace whipple::device::check

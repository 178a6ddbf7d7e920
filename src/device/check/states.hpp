// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "src/device/problem.hpp"

/// Stored states: what the host's kernels make of some particles, to compare a device with on a machine that has no more
/// than a compiler.
namespace whipple::device::check {

/// Reports a file that is not a stored state of this program, and wrong options.
class WrongInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Time of a step.
struct StoredStep {
  double dt, end;  ///< s
};

/// Totals of all particles: the first sums of StepSums, in their order.
constexpr std::size_t stored_sums = StepSums::unresolved_ + 1;
using Totals = std::array<double, stored_sums>;

/// Particles and their totals after some steps.
struct Result {
  PointsOnHost points;
  Totals totals{};
};

/// A run of the host's kernels.
struct StoredState {
  std::string name, what;  ///< what: bodies and physics, for people
  std::string revision;    ///< of the sources whose program wrote it
  Problem problem;
  PointsOnHost start;
  std::vector<StoredStep> steps;  ///< at least one
  Result first, last;             ///< after the first step, and after all of them
};

/// Writes a state: a header (magic number, version, sizes of the structures, revision), the problem and the particles
/// as a processor of the same kind keeps them. A component that all particles share is stored as one number, one that
/// is as before as none.
/// @throws std::runtime_error if the file cannot be written
void write_state(const std::filesystem::path& file, const StoredState& state);

/// Reads a state.
/// @throws WrongInput naming the file if it is missing, truncated, of another version or no state at all
StoredState read_state(const std::filesystem::path& file);

}  // namespace whipple::device::check

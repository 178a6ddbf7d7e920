// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "src/device/check/states.hpp"
#include "src/device/engine.hpp"

namespace whipple::device::check {

/// Makes the engine of a device.
using MakeEngine = std::function<std::unique_ptr<Engine>(const Problem& problem, const PointsOnHost& points)>;

/// Largest differences that the same equations may have on another processor: round-off (contraction, last bits of
/// exponentials) after one step, and what has become of it after two hundred. `flow` is that of plastic strain and
/// deviatoric stress: the host ends the iteration of Johnson-Cook at a residual of 1e-11 of the trial stress, which is
/// several times the largest stress that remains.
struct Bounds {
  double all, flow;
};
constexpr Bounds bounds_of_first = {1e-11, 1e-10}, bounds_of_last = {1e-8, 1e-8};

/// Difference to the stored result.
struct Difference {
  std::string component;
  double largest =
      0.0;  ///< over the largest magnitude of the component, of all components of a vector or tensor
  double bound = 0.0;

  [[nodiscard]] double of_bound() const { return largest / bound; }
};
/// Compares component by component; equal ones are left out.
/// @returns the differences, the largest in terms of its bound first; one of 1 named "particles" if not the same ones
/// are left
std::vector<Difference> differences(const PointsOnHost& points, const PointsOnHost& expected,
                                    const Bounds& bounds);
/// Compares the sums, each over its scale: energies over their sum, momenta over the sum of |m v|.
std::vector<Difference> differences(const Totals& totals, const Totals& expected, const Problem& problem,
                                    const Bounds& bounds);

/// Holds the comparison of a state.
struct Comparison {
  std::vector<Difference> first, last;            ///< of the particles
  std::vector<Difference> first_sums, last_sums;  ///< of the totals
  bool twice = false;                             ///< whether it was repeated
  bool repeats = true;                            ///< a second time, bit by bit
  double seconds = 0.0;                           ///< of all steps
  std::size_t steps = 0;

  [[nodiscard]] bool passes() const;
};

/// Steps a state with its stored time steps.
/// @param steps  at most so many of them; with fewer than all the last result is not compared
/// @param twice  whether to repeat the steps and to compare bits
Comparison compare(const StoredState& state, const MakeEngine& make, std::size_t steps, bool twice);

}  // namespace whipple::device::check

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "src/case/section.hpp"

namespace whipple::cases {

/// Selects the grid of a load step.
enum class LoadStepGrid : std::uint8_t {
  reset,  ///< undeformed in every step: the particles move through it
  kept,   ///< that of the start, deformed with the material: finite elements with particles as their points
};
constexpr std::array<Word<LoadStepGrid>, 2> words(LoadStepGrid) {
  return {{{LoadStepGrid::reset, "reset"}, {LoadStepGrid::kept, "kept"}}};
}

/// Controls the load steps of time.scheme = "quasi_static" (docs/theory/quasi_static.md).
struct QuasiStatic {
  std::int64_t steps = 20;
  double least_step = 1e-4;
  double tolerance = 1e-8;
  std::int64_t iterations = 12;
  LoadStepGrid grid = LoadStepGrid::reset;
  double border_stiffness = 1e-3;

  static ParameterTable<QuasiStatic> parameters();
  bool operator==(const QuasiStatic&) const = default;
};

/// Adds faults for load steps in a run with inertia, and for what load steps do not compute, before and after the fields of the bodies are known.
void check_load_steps(const Case& setup, const Faults& faults);
void check_load_step_fields(const Case& setup, const Faults& faults);

}  // namespace whipple::cases

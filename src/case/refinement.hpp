// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "src/case/section.hpp"
#include "src/core/base/tensor.hpp"
#include "src/grid/levels.hpp"

namespace whipple::cases {

/// Describes a region whose cells have the edge `domain.cell_size`; with such regions the cells elsewhere are twice as
/// large (docs/theory/levels.md).
struct Refinement {
  Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();  ///< m; both the same: not given
  std::string body;     ///< whose bounding box it is instead; empty: none
  double margin = 0.0;  ///< around the box, m

  static ParameterTable<Refinement> parameters();
  void check(const Case& setup, const Faults& faults) const;
};

/// Returns the regions of a case in coarse cells: whole ones, at least those that the regions name, and without end
/// where they reach a face of the domain. Requires the shapes of the bodies that they name.
grid::Levels levels_of(const Case& setup);

/// Adds faults for settings that a grid of two levels does not have. Requires contact fields.
void check_two_levels(const Case& setup, const Faults& faults);

}  // namespace whipple::cases

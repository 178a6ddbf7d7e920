// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "src/case/case.hpp"

/// Places of the loads of a case.
namespace whipple::cases {

/// Describes the patch of a face of the domain on which a pressure acts.
struct Patch {
  double area;     ///< inside the domain, m^2
  double covered;  ///< of the area, by material within a cell of the face at the start, m^2
};

/// Returns the patch of a pressure: the boxes of the particles that fill the bodies (or would, for bodies of elements)
/// are projected onto the face, and what they cover together is counted once. Bars have no area. In plane strain for a
/// depth of 1 m, in axisymmetry for the ring.
Patch patch_of(const Case& setup, const AppliedLoad& load);

/// Adds a fault for each load that has no material in its box or before its patch at the start. Requires geometry and
/// shapes.
void check_places_of_loads(const Case& setup, const Faults& faults);

/// Describes the force of each pressure and its patch, one line per load.
std::vector<std::string> describe_patches(const Case& setup);

}  // namespace whipple::cases

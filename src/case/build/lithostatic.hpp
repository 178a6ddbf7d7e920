// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "src/case/case.hpp"
#include "src/particles/particles.hpp"

/// The initial stress of bodies under their own weight (docs/theory/soil.md, section 5).
namespace whipple::cases {

/// Sets the particles [begin, end) of a body, initialised without stress, to the stress of `initial.lithostatic`: the
/// density is that of the pressure at the initial temperature, the volume stays that of the lattice, and the internal
/// energy is that of the equation of state and of the elastic deviator, so that there is no heat beside it.
void set_lithostatic(const Case& setup, std::size_t body, Particles& particles, std::size_t begin,
                     std::size_t end);

/// Adds a fault for each body whose lithostatic state cannot exist or cannot stay at rest. Requires shapes and
/// materials.
void check_lithostatic(const Case& setup, const Faults& faults);

/// Returns warnings about bodies that their lithostatic state does not keep at rest: an upper surface that is not at
/// `surface`, a load from the start. Requires that the case has no faults.
std::vector<std::string> lithostatic_warnings(const Case& setup);

}  // namespace whipple::cases

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "src/case/build/seeding.hpp"
#include "src/case/case.hpp"
#include "src/fem/mesh.hpp"

/// Work of a step, which determines the distribution of the blocks over the ranks: counted, not timed, so that runs on
/// the same number of ranks are bitwise reproducible (docs/manual/architecture.md). Unit: the transfers of one
/// particle.
namespace whipple::solver {

/// Work of the nodes of a block with particles, in transfers of a particle.
constexpr double work_of_block = 45.0;

/// Work of a particle at rest as a fraction of that of a moving one: it is only examined and sorted, 1 to 3 ns.
constexpr double share_of_rest = 0.02;

/// Returns the work of an element with its material: 235 and 1380 ns compared with 233 ns (docs/theory/fem.md, section
/// 9).
constexpr double work_of_element(fem::Quadrature quadrature) {
  return quadrature == fem::Quadrature::b_bar ? 6.0 : 1.0;
}

/// Computes the work of every particle: its transfers and its material.
/// @param bodies  ranges of this rank's particles
/// @param work    result; reuses its memory (new pages cost more than the values)
void work_of_particles(const cases::Case& setup, std::span<const cases::BodySummary> bodies,
                       std::vector<double>& work);

}  // namespace whipple::solver

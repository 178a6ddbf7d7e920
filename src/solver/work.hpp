// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "src/case/build/seeding.hpp"
#include "src/case/case.hpp"
#include "src/fem/mesh.hpp"

/// Work of a step, by which the blocks are shared out among the ranks: counted, not timed, so that a run on
/// so many ranks gives the same bits every time (docs/manual/architecture.md). Unit: the transfers of one particle.
namespace whipple::solver {

/// Weighs the nodes of a block that holds particles, in transfers of a particle.
constexpr double work_of_block = 45.0;

/// Weighs a particle at rest, as a fraction of one that moves: 1 to 3 ns, it is examined and sorted only.
constexpr double share_of_rest = 0.02;

/// Weighs an element with its material: 235 and 1380 ns against 233 ns (docs/theory/fem.md, 9).
constexpr double work_of_element(fem::Quadrature quadrature) {
  return quadrature == fem::Quadrature::one_point ? 1.0 : 6.0;
}

/// Returns the work of every particle: its transfers and its material.
/// @param bodies  the ranges of this rank's particles
/// @param work    resized; its memory serves the next time (new pages cost more than the values)
void work_of_particles(const cases::Case& setup, std::span<const cases::BodySummary> bodies,
                       std::vector<double>& work);

}  // namespace whipple::solver

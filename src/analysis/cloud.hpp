// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "src/analysis/frame.hpp"
#include "src/analysis/outflow.hpp"
#include "src/analysis/table.hpp"

/// Position, growth and content of the debris cloud. Definitions: docs/theory/analysis.md.
namespace whipple::analysis {

/// Holds the fraction of the mass beyond the front: single particles do not make a cloud.
constexpr double beyond = 1e-3;

/// Returns the particles of the debris.
std::vector<std::uint32_t> debris(const Snapshot& snapshot, const Frame& frame);

/// Measures position, size and speeds of the debris, and the masses of the phases in the whole material and in the
/// debris.
/// @param target initial extent of the first target, if any: the length of the cloud is measured from its rear face
/// @param bodies of the snapshot; bodies without phases are excluded from the masses of the phases
Quantities cloud_measures(const Snapshot& snapshot, const Frame& frame, const std::optional<Extent>& target,
                          std::span<const BodyInput> bodies = {});

/// Tabulates mass, momentum and energy of the bodies: rows "BODY PART" with the parts whole, debris, ejecta and the
/// four phases, then the sums over all bodies. Sums refer to the full problem: they are multiplied by `frame.copies()`.
Table body_table(const Snapshot& snapshot, const Frame& frame, const std::vector<BodyInput>& bodies);

/// Measures one body: mean axial velocity, velocity of its forward surface, fractions of the phases.
Quantities body_measures(const Snapshot& snapshot, const Frame& frame, std::size_t body,
                         const BodyInput& input, const Outflow& outflow = {});

/// Names the positions of the cloud whose speeds are measured, and these speeds.
constexpr std::array<std::array<const char*, 2>, 3> speeds = {
    {{"front", "front_speed"}, {"rear", "rear_speed"}, {"radius", "expansion_speed"}}};

/// Adds the speeds of front, rear and radius to `series` as the slopes of their columns over time (central
/// differences).
void add_speeds(Table& series);

/// Computes the least-squares slope of y over x over the last third of the finite entries (at least three); NaN if
/// there are fewer than two.
double final_slope(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace whipple::analysis

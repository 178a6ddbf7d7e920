// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "src/analysis/frame.hpp"
#include "src/analysis/outflow.hpp"
#include "src/analysis/table.hpp"

/// Where the debris cloud is, how fast it grows and what it carries. Definitions: docs/theory/analysis.md.
namespace whipple::analysis {

/// Fraction of the mass that may lie beyond "the front": single particles do not make a cloud.
constexpr double beyond = 1e-3;

/// Returns the particles of the debris.
std::vector<std::uint32_t> debris(const Snapshot& snapshot, const Frame& frame);

/// Measures position, size and speeds of the debris; masses of the phases in all of the material and in the debris.
/// @param target initial extent of the first target, if there is one: the length of the cloud begins at its rear face
/// @param bodies of the snapshot; those without phases count in no mass of a phase
Quantities cloud_measures(const Snapshot& snapshot, const Frame& frame, const std::optional<Extent>& target,
                          std::span<const BodyInput> bodies = {});

/// Tabulates mass, momentum and energy of the bodies: rows "BODY PART" with the parts whole, debris, ejecta and the
/// four phases, then those of all bodies together. Full problem: sums are multiplied by `frame.copies()`.
Table body_table(const Snapshot& snapshot, const Frame& frame, const std::vector<BodyInput>& bodies);

/// Measures one body: mean axial velocity, velocity of its forward surface, fractions of the phases.
Quantities body_measures(const Snapshot& snapshot, const Frame& frame, std::size_t body,
                         const BodyInput& input, const Outflow& outflow = {});

/// Names of the positions of the cloud whose speeds are measured, and of these speeds.
constexpr std::array<std::array<const char*, 2>, 3> speeds = {
    {{"front", "front_speed"}, {"rear", "rear_speed"}, {"radius", "expansion_speed"}}};

/// Adds the speeds of front, rear and radius as slopes of the columns of `series` over time (central
/// differences).
void add_speeds(Table& series);

/// Slope of y over x by least squares over the last third of the finite entries (at least three); NaN if
/// there are fewer than two.
double final_slope(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace whipple::analysis

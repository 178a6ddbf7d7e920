// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/case/case.hpp"

/// Placement of the bodies of a case at the start: its faults, warnings, memory and neighbours.
namespace whipple::cases {

/// States why a body cannot be placed.
struct PlacementFault {
  std::size_t body;
  std::string message;
};

/// Estimates the memory (bytes) of the particles and of the grid around them, of all ranks together: an upper bound,
/// from the bounding boxes of the bodies.
double expected_memory(const Case& setup);

/// Finds bodies that leave the domain through an outflow face, hold no particle, or share points with another body.
std::vector<PlacementFault> placement_faults(const Case& setup);

/// Returns warnings about what is no fault but seldom meant: one for each body of particles that is thinner than a
/// cell, or whose particles have another volume than its shape.
std::vector<std::string> placement_warnings(const Case& setup);

/// Returns the boxes of the whole particles that fill a body, or would fill one of elements, in and near a part of space.
std::vector<Shape::Bounds> particle_boxes(const Case& setup, const Body& body, const Shape::Bounds& near);

/// Returns which faces of the domain that mirror or stop material each body touches or crosses at the start: a bit per
/// face in the order of Geometry::boundary. It follows from the case alone, so a run that goes on
/// from a checkpoint finds the same.
std::vector<std::uint8_t> faces_touched(const Case& setup);

}  // namespace whipple::cases

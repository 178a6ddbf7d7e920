// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/case/case.hpp"

/// Initial placement of the bodies of a case: faults, warnings, memory and neighbours.
namespace whipple::cases {

/// States why a body cannot be placed.
struct PlacementFault {
  std::size_t body;
  std::string message;
};

/// Estimates an upper bound of the memory (bytes) of the particles and of the grid around them, summed over all ranks,
/// from the bounding boxes of the bodies.
double expected_memory(const Case& setup);

/// Finds bodies that leave the domain through an outflow face, contain no particle, or overlap another body.
std::vector<PlacementFault> placement_faults(const Case& setup);

/// Returns warnings about valid but probably unintended settings: one for each body of particles that is thinner than a
/// cell, or whose particles do not have the volume of its shape.
std::vector<std::string> placement_warnings(const Case& setup);

/// Returns the boxes of the whole particles that fill a body (or would, for a body of elements), in and near a region.
std::vector<Shape::Bounds> particle_boxes(const Case& setup, const Body& body, const Shape::Bounds& near);

/// Returns, for each body, the mirror planes and walls of the domain that it initially touches or crosses: one bit per
/// face in the order of Geometry::boundary. The result depends on the case only, so a run resumed from a checkpoint
/// obtains the same.
std::vector<std::uint8_t> faces_touched(const Case& setup);

}  // namespace whipple::cases

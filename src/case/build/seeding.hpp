// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "src/case/case.hpp"
#include "src/fem/bars.hpp"
#include "src/fem/mesh.hpp"
#include "src/particles/particles.hpp"

namespace whipple::cases {

/// Why the bodies of a case cannot be placed: one entry per fault, with the body it belongs to.
struct PlacementFault {
  std::size_t body;
  std::string message;
};

/// Bytes that the particles and the grid around them will take, of all ranks together; at most, for a body
/// takes less than its bounding box.
double expected_memory(const Case& setup);

/// Bodies that leave the domain through an outflow face, hold no particle, or share points with another body.
std::vector<PlacementFault> placement_faults(const Case& setup);

/// Returns warnings about what is no fault but seldom meant: one for each body of particles that is thinner than a
/// cell, or whose particles have another volume than its shape.
std::vector<std::string> placement_warnings(const Case& setup);

/// Boxes of the whole particles that fill a body, or would fill one of elements, in and near a part of space.
std::vector<Shape::Bounds> particle_boxes(const Case& setup, const Body& body, const Shape::Bounds& near);

/// Holds the particles and the mass that a body was seeded with.
struct BodySummary {
  std::size_t first = 0;  ///< its particles are [first, first + count)
  std::size_t count = 0;
  double mass = 0.0;        ///< kg, of the part inside the domain (on all ranks)
  double shape_mass = 0.0;  ///< kg, of the whole shape at the initial density
};

struct Seeding {
  Particles particles;  ///< sorted by body, ids from 0
  std::vector<BodySummary> bodies;
  std::vector<fem::Mesh> meshes;           ///< of the bodies with finite elements
  std::vector<fem::Bars> bars;             ///< of the bodies of bars
  Vector3 wall_impulse = Vector3::Zero();  ///< N s, see `make_meshes`
};

/// Which faces of the domain that mirror or stop material a body touches or crosses at the start: of each body,
/// a bit per face in the order of Geometry::boundary. It follows from the case alone, so a run that goes on
/// from a checkpoint finds the same.
std::vector<std::uint8_t> faces_touched(const Case& setup);

/// Fills the bodies of elements with their meshes (`make_meshes`), the others with particles on lattices that
/// fit each body's bounding box, as near as possible to the wanted number per cell; a particle at the surface
/// is whole if its centre lies in the body, or, with `partial_volumes`, the part of its box that does. Parts
/// of a body beyond a symmetry plane or wall are left out (quarter models). Of `ranks` processes each makes
/// an equal share of every body; ids are the same for any number of them.
Seeding seed(const Case& setup, int rank = 0, int ranks = 1);

}  // namespace whipple::cases

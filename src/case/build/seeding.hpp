// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "src/case/case.hpp"
#include "src/fem/bars.hpp"
#include "src/fem/mesh.hpp"
#include "src/particles/particles.hpp"

namespace whipple::cases {

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

/// Fills the bodies of elements with their meshes (`make_meshes`), the others with particles on lattices that
/// fit each body's bounding box, as near as possible to the wanted number per cell; a particle at the surface
/// is whole if its centre lies in the body, or, with `partial_volumes`, the part of its box that does. Parts
/// of a body beyond a symmetry plane or wall are left out (quarter models). Of `ranks` processes each makes
/// an equal part of every body; ids are the same for any number of them.
Seeding seed(const Case& setup, int rank = 0, int ranks = 1);

}  // namespace whipple::cases

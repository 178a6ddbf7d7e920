// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "src/case/case.hpp"
#include "src/fem/bars.hpp"
#include "src/fem/mesh.hpp"
#include "src/particles/particles.hpp"

namespace whipple::cases {

/// Holds the particles and the mass of a seeded body.
struct BodySummary {
  std::size_t first = 0;  ///< its particles are [first, first + count)
  std::size_t count = 0;
  double mass = 0.0;        ///< kg, of the part inside the domain (sum of all ranks)
  double shape_mass = 0.0;  ///< kg, of the whole shape at the initial density
};

struct Seeding {
  Particles particles;  ///< sorted by body, ids from 0
  std::vector<BodySummary> bodies;
  std::vector<fem::Mesh> meshes;           ///< of the bodies with finite elements
  std::vector<fem::Bars> bars;             ///< of the bodies of bars
  Vector3 wall_impulse = Vector3::Zero();  ///< N s, see `make_meshes`
};

/// Creates the meshes of the bodies of elements (`make_meshes`), and fills the others with particles on lattices fitted
/// to the bounding box of each body, with a density as close as possible to the requested number per cell. A particle
/// at the surface is whole if its centre is inside the body; with `partial_volumes` it is the part of its box inside
/// the body. Parts of a body beyond a symmetry plane or wall are omitted (quarter models). Each of `ranks` processes
/// creates an equal part of every body; ids do not depend on the number of processes.
Seeding seed(const Case& setup, int rank = 0, int ranks = 1);

}  // namespace whipple::cases

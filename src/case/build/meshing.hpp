// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "src/case/case.hpp"
#include "src/fem/mesh.hpp"

namespace whipple::cases {

/// Hexahedra of a body with finite elements: its shape's or those of its Gmsh file, without what lies beyond
/// mirror planes; nodes on a plane are exactly on it.
/// @throws InputError if the shape has no structured mesh, the file is not usable, elements are inverted, or
/// a mirror plane cuts through elements
fem::Hexahedra hexahedra_of(const Case& setup, const Body& body);

/// Meshes of all bodies with finite elements: masses, initial state, velocities, nodes that keep to mirror
/// planes and walls, node conditions. What the planes take of the initial velocities of nodes on them becomes
/// heat of the elements.
/// @param first_particle_id  above the ids of all particles; those of converted elements follow it
/// @param wall_impulse  N s, what planes and walls gave to those nodes is added
std::vector<fem::Mesh> make_meshes(const Case& setup, std::uint64_t first_particle_id, Vector3& wall_impulse);

}  // namespace whipple::cases

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "src/case/case.hpp"
#include "src/fem/mesh.hpp"

namespace whipple::cases {

/// Returns the hexahedra of a body with finite elements, from its shape or its mesh file, without elements beyond
/// mirror planes; nodes near a plane are moved exactly onto it.
/// @throws InputError if the shape has no structured mesh, the file is not usable, elements are inverted, or a mirror
/// plane cuts through elements
fem::Hexahedra hexahedra_of(const Case& setup, const Body& body);

/// Creates the meshes of all bodies with finite elements: masses, initial state, velocities, constraints at mirror
/// planes and walls, nodal boundary conditions. Kinetic energy removed by these planes from the initial velocities of
/// constrained nodes becomes heat of the elements.
/// @param first_particle_id  larger than all particle ids; those of converted elements follow it
/// @param wall_impulse  N s, incremented by the impulse of planes and walls on those nodes
std::vector<fem::Mesh> make_meshes(const Case& setup, std::uint64_t first_particle_id, Vector3& wall_impulse);

}  // namespace whipple::cases

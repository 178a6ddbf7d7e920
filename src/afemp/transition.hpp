// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <vector>

#include "src/fem/facets.hpp"
#include "src/fem/mesh.hpp"
#include "src/fem/step.hpp"
#include "src/grid/geometry.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/transition_nodes.hpp"

/// Transition between finite elements and the grid (docs/theory/afemp.md, section 2).
namespace whipple::afemp {

/// Faces that belong to one element only, but for those on mirror planes and no-slip walls,
/// behind which the body goes on as its own image. Looked for among the nodes that are marked as on the
/// surface; those of elements that were taken out have to be marked.
std::vector<fem::Facet> free_facets(const fem::Mesh& mesh, const grid::Geometry& geometry);

/// Marks their nodes (`Nodes::on_surface`), looked for among all.
void mark_surface(fem::Mesh& mesh, const grid::Geometry& geometry);

/// Marks the nodes that move with the grid (`Nodes::in_transition`): nodes on the surface of a mesh, inside
/// of the domain, in the same cell as, or in a cell next to that of, a particle or a surface node of another
/// body, on whatever rank. Nodes that leave the transition give up their affine field: its energy becomes
/// heat of their elements. Nodes with a prescribed velocity stay out of it, unless they only keep to a mirror
/// plane.
/// @param affine_inertia of the affine field per mass, m^2
/// Collective.
/// @returns that heat on this rank, J
double mark_transition(std::vector<fem::Mesh>& meshes, const Particles& particles,
                       const grid::Geometry& geometry, double affine_inertia, MPI_Comm communicator);

/// Greatest sound speed of the elements around a node, m/s.
double sound_speed_at(const fem::Mesh& mesh, std::size_t node);

/// The marked nodes of all meshes as the transfers see them, in the order of the meshes and nodes, with the
/// forces of `fem::internal_forces`.
void collect(const std::vector<fem::Mesh>& meshes, transfer::TransitionNodes& nodes);

/// Takes the results of the grid: velocities and affine fields back to the meshes, motions and heat of the
/// step to the marked nodes' entries.
/// @param motions, heat one of each mesh; resized to its nodes, heat of the others 0
void distribute(const transfer::TransitionNodes& nodes, std::vector<fem::Mesh>& meshes,
                std::span<fem::Motion> motions, std::span<std::vector<double>> heat);

/// Nodes outside of the grid at walls and mirror planes: keeps those that would cross a face of the domain
/// on it, a perfectly inelastic impact whose energy becomes heat at the node (2.5). `motion` and velocities
/// as `fem::advance_velocities` left them.
/// @returns impulse of the faces on the body, N s
Vector3 stop_at_faces(fem::Nodes& nodes, const grid::Geometry& geometry, double dt, fem::Motion& motion,
                      std::span<double> heat);

}  // namespace whipple::afemp

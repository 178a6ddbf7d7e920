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

/// Interface between finite elements and the grid (docs/theory/afemp.md, section 2).
namespace whipple::afemp {

/// Returns the faces that belong to one element only, except those on mirror planes and no-slip walls, where the body
/// is continuous with its mirror image. Searches among the nodes marked as on the surface; nodes of removed elements
/// must have been marked.
std::vector<fem::Facet> free_facets(const fem::Mesh& mesh, const grid::Geometry& geometry);

/// Marks the nodes of the free faces (`Nodes::on_surface`), searching among all nodes.
void mark_surface(fem::Mesh& mesh, const grid::Geometry& geometry);

/// Marks the interface nodes (`Nodes::in_transition`), which move with the grid: nodes on the surface of a mesh, inside
/// of the domain, in or next to a cell that contains a particle or a surface node of another body, on any rank. Nodes
/// that cease to be interface nodes lose their affine field: its energy becomes heat of their elements. Nodes with a
/// prescribed velocity are excluded, unless they are only constrained to a mirror plane. Collective.
/// @param affine_inertia of the affine field per mass, m^2
/// @returns that heat on this rank, J
double mark_transition(std::vector<fem::Mesh>& meshes, const Particles& particles,
                       const grid::Geometry& geometry, double affine_inertia, MPI_Comm communicator);

/// Returns the maximum sound speed of the elements around a node, m/s.
double sound_speed_at(const fem::Mesh& mesh, std::size_t node);

/// Collects the marked nodes of all meshes for the transfers, in the order of the meshes and nodes, with the forces of
/// `fem::internal_forces`.
void collect(const std::vector<fem::Mesh>& meshes, transfer::TransitionNodes& nodes);

/// Distributes the results of the grid: velocities and affine fields to the meshes, motions and heat of the step to the
/// entries of the marked nodes.
/// @param motions, heat one per mesh; resized to its nodes, with zero heat for the others
void distribute(const transfer::TransitionNodes& nodes, std::vector<fem::Mesh>& meshes,
                std::span<fem::Motion> motions, std::span<std::vector<double>> heat);

/// Stops off-grid nodes at walls and mirror planes: nodes that would cross a face of the domain are kept on it, a
/// perfectly inelastic impact whose energy becomes heat at the node (2.5). `motion` and velocities must be those set by
/// `fem::advance_velocities`.
/// @returns impulse of the faces on the body, N s
Vector3 stop_at_faces(fem::Nodes& nodes, const grid::Geometry& geometry, double dt, fem::Motion& motion,
                      std::span<double> heat);

}  // namespace whipple::afemp

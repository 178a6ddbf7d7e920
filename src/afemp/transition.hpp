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

/// Tells apart what meets each other within the meshes.
struct Parts {
  std::span<const std::vector<std::uint8_t>> of_node;  ///< of each mesh: part of each node; empty: one part
  std::span<const std::size_t> count;                  ///< of each mesh: parts over all ranks; empty: one
};

/// Marks the interface nodes (`Nodes::in_transition`), which move with the grid: nodes on the surface of a mesh, inside
/// of the domain, in or next to a cell that contains a particle or a surface node of another mesh or of another part of
/// the same one, on any rank. Nodes
/// that cease to be interface nodes lose their affine field: its energy becomes heat of their elements. Nodes with a
/// prescribed velocity are excluded, unless they are only constrained to a mirror plane or are nodes of a tool
/// (`is_of_tool`). Collective.
/// @param affine_inertia of the affine field per mass, m^2
/// @returns that heat on this rank, J
double mark_transition(std::vector<fem::Mesh>& meshes, const Parts& parts, const Particles& particles,
                       const grid::Geometry& geometry, double affine_inertia, MPI_Comm communicator);

/// Factor by which the nodes of tools on the grid are heavier than they are: what meets them does not move them. Forces
/// do not act on them there: in contact they have the velocity of the step before.
constexpr double tool_weight = 1e3;

/// Returns whether a node belongs to a tool: its body has a path and all components of its velocity are prescribed.
inline bool is_of_tool(const fem::Mesh& mesh, std::size_t node) {
  return mesh.has_path && mesh.nodes.constrained[node] == fem::constraint::all;
}

/// Returns the maximum sound speed of the elements around a node, m/s.
double sound_speed_at(const fem::Mesh& mesh, std::size_t node);

/// Collects the marked nodes of all meshes for the transfers, in the order of the meshes and nodes, with the forces of
/// `fem::internal_forces`.
void collect(const std::vector<fem::Mesh>& meshes, transfer::TransitionNodes& nodes);

/// Describes a step of the tools.
struct ToolStep {
  double dt = 0.0;               ///< s
  double affine_inertia = 0.0;   ///< of the affine fields of nodes per mass, m^2
  std::span<const double> path;  ///< of each mesh: factor of its prescribed velocities
};

/// Distributes the results of the grid: velocities and affine fields to the meshes, motions and heat of the step to the
/// entries of the marked nodes. Those of tools keep to their path, whatever the grid made of them (2.6).
/// @param motions, heat one per mesh; resized to its nodes, with zero heat for the others
/// @param tools  of each mesh, result: impulse and work of what moves its nodes along the path
void distribute(const transfer::TransitionNodes& nodes, std::vector<fem::Mesh>& meshes,
                std::span<fem::Motion> motions, std::span<std::vector<double>> heat, const ToolStep& step,
                std::span<fem::ConstraintBalance> tools);

/// Stops off-grid nodes at walls and mirror planes: nodes that would cross a face of the domain are kept on it, a
/// perfectly inelastic impact whose energy becomes heat at the node (2.5). `motion` and velocities must be those set by
/// `fem::advance_velocities`.
/// @returns impulse of the faces on the body, N s
Vector3 stop_at_faces(fem::Nodes& nodes, const grid::Geometry& geometry, double dt, fem::Motion& motion,
                      std::span<double> heat);

}  // namespace whipple::afemp

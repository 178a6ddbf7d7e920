// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "src/fem/mesh.hpp"

/// Structured meshes of simple bodies (docs/theory/fem.md, 7). Lengths in m; `size` is the wanted edge of an
/// element, met as nearly as whole numbers allow, with at least one element per part. Curved surfaces are
/// those of the trilinear elements; their nodes lie a little outside of the exact surface, by O(size^2), so
/// that the volume is that of the body.
namespace whipple::fem {

/// Axes along which only the half at positive coordinates is meshed (models with symmetry planes).
using Halved = std::array<bool, 3>;

/// @throws InputError if the box is empty or a count is 0
Hexahedra make_box(const Vector3& lower, const Vector3& upper, const std::array<std::size_t, 3>& counts);
/// @throws InputError if the box is empty or the size is not positive
Hexahedra make_box(const Vector3& lower, const Vector3& upper, double size);

/// Butterfly mesh of a cylinder about the z axis from z = 0 to `length`: a square core with bulged edges and
/// a ring around it. `halved[2]` is not used.
/// @throws InputError if a length is not positive
Hexahedra make_cylinder(double radius, double length, double size, const Halved& halved = {});

/// Tangent ogive about the z axis: a shank from z = 0 to `shank`, then a nose of the length `nose`; a
/// butterfly mesh as that of a cylinder, closed at the tip by a cap. `halved[2]` is not used.
/// @throws InputError if radius, nose or size is not positive
Hexahedra make_ogive(double radius, double nose, double shank, double size, const Halved& halved = {});

/// Tube about the z axis from z = 0 to `length`; `halved[2]` is not used.
/// @throws InputError if a length is not positive or the inner radius not below the outer one
Hexahedra make_tube(double inner_radius, double outer_radius, double length, double size,
                    const Halved& halved = {});

/// Sphere about the origin: a cube with bulged faces and a layer around it.
/// @throws InputError if a length is not positive
Hexahedra make_sphere(double radius, double size, const Halved& halved = {});

/// x <- rotation x + translation; a reflection turns the elements round, so that they stay upright.
void transform(Hexahedra& hexahedra, const Matrix3& rotation, const Vector3& translation);

/// Makes one node of nodes that are nearer than `tolerance` (m) to each other.
void merge_nodes(Hexahedra& hexahedra, double tolerance);

/// Nodes nearer than this (m), a hundred-thousandth of a mean element's edge, are in the same place.
double coincidence(const Hexahedra& hexahedra);

/// Number of nodes in the place of another one: parts of a mesh that meet there are not joined.
std::size_t unmerged_nodes(const Hexahedra& hexahedra);

}  // namespace whipple::fem

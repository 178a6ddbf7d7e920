// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "src/fem/mesh.hpp"

/// Structured meshes of simple bodies (docs/theory/fem.md, 7). Lengths in m; `size` is the target edge of an element,
/// approximated by an integer number of elements, at least one per part. Curved surfaces are those of the trilinear
/// elements; their nodes are slightly outside of the exact surface, by O(size^2), so that the volume is that of the
/// body.
namespace whipple::fem {

/// Selects the axes along which only the half at positive coordinates is meshed (models with symmetry planes).
using Halved = std::array<bool, 3>;

/// Creates a box. @throws InputError if the box is empty or a count is 0
Hexahedra make_box(const Vector3& lower, const Vector3& upper, const std::array<std::size_t, 3>& counts);
/// Creates a box. @throws InputError if the box is empty or the size is not positive
Hexahedra make_box(const Vector3& lower, const Vector3& upper, double size);

/// Creates a butterfly mesh of a cylinder about the z axis from z = 0 to `length`: a square core with curved edges and
/// a surrounding ring. `halved[2]` is not used.
/// @throws InputError if a length is not positive
Hexahedra make_cylinder(double radius, double length, double size, const Halved& halved = {});

/// Creates a tangent ogive about the z axis: a shank from z = 0 to `shank`, then a nose of length `nose`; a butterfly
/// mesh like that of a cylinder, closed at the tip by a cap. `halved[2]` is not used.
/// @throws InputError if radius, nose or size is not positive
Hexahedra make_ogive(double radius, double nose, double shank, double size, const Halved& halved = {});

/// Creates a tube about the z axis from z = 0 to `length`; `halved[2]` is not used.
/// @throws InputError if a length is not positive or the inner radius is not smaller than the outer one
Hexahedra make_tube(double inner_radius, double outer_radius, double length, double size,
                    const Halved& halved = {});

/// Creates a sphere about the origin: a cube with curved faces and a surrounding layer.
/// @throws InputError if a length is not positive
Hexahedra make_sphere(double radius, double size, const Halved& halved = {});

/// Applies x <- rotation x + translation; for reflections the elements are reversed, so that they are not inverted.
void transform(Hexahedra& hexahedra, const Matrix3& rotation, const Vector3& translation);

/// Returns the quadrilaterals of the section z = 0: the faces of the hexahedra in that plane, counter-clockwise in (x,
/// y), of elements at z > 0. Corners 4 to 7 repeat the corners 0 to 3. Empty if there is no such face.
/// @param tolerance  m
Hexahedra section_of(const Hexahedra& hexahedra, double tolerance);

/// Merges nodes that are closer than `tolerance` (m) to each other.
void merge_nodes(Hexahedra& hexahedra, double tolerance);

/// Returns the distance (m), 1e-5 of the mean element edge, below which nodes coincide.
double coincidence(const Hexahedra& hexahedra);

/// Returns the number of nodes that coincide with another one: parts of a mesh that meet there are not connected.
std::size_t unmerged_nodes(const Hexahedra& hexahedra);

}  // namespace whipple::fem

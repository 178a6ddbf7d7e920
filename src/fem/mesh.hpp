// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "src/core/base/tensor.hpp"
#include "src/core/base/words.hpp"
#include "src/fem/element_blocks.hpp"
#include "src/fem/hexahedra.hpp"
#include "src/particles/material_points.hpp"

/// Elements of one body: data structures, and operations outside of the time step (docs/theory/fem.md).
namespace whipple::fem {

/// Selects the quadrature of the integrals over an element.
enum class Quadrature : std::uint8_t {
  one_point,  ///< mean gradient of Flanagan & Belytschko, with hourglass control
  b_bar,      ///< 2 x 2 x 2 Gauss points, mean volumetric strain of the element (Hughes' B-bar)
  plane,      ///< one point of a quadrilateral in plane strain (quadrilateral.hpp)
  ring,       ///< one point of a quadrilateral that stands for a ring about the x axis
};
/// Lists what a case chooses from; the dimension of its domain decides on quadrilaterals.
constexpr std::array<Word<Quadrature>, 2> words(Quadrature) {
  return {{{Quadrature::one_point, "one_point"}, {Quadrature::b_bar, "b_bar"}}};
}
constexpr std::size_t points_per_element(Quadrature quadrature) {
  return quadrature == Quadrature::b_bar ? 8 : 1;
}
/// Returns whether the elements are quadrilaterals: hexahedra whose corners 4 to 7 repeat the corners 0 to 3.
constexpr bool is_flat(Quadrature quadrature) {
  return quadrature == Quadrature::plane || quadrature == Quadrature::ring;
}
/// Returns the number of particles that an element becomes.
constexpr std::size_t particles_per_element(Quadrature quadrature) { return is_flat(quadrature) ? 4 : 8; }

/// Lists the directions in which the velocity of a node is prescribed: bits of Nodes::constrained.
namespace constraint {
constexpr std::uint8_t none = 0, x = 1, y = 2, z = 4, all = 7;
constexpr std::uint8_t axis(int a) { return static_cast<std::uint8_t>(1U << static_cast<unsigned>(a)); }
}  // namespace constraint

struct Nodes {
  std::vector<std::uint64_t> id;          ///< unique, never changes
  std::vector<double> mass;               ///< kg, lumped: contributions of the remaining elements
  std::vector<Vector3> position;          ///< m
  std::vector<Vector3> velocity;          ///< m/s
  std::vector<Vector3> force;             ///< N, set by `internal_forces`
  std::vector<std::uint8_t> constrained;  ///< bits of fem::constraint
  std::vector<Vector3> prescribed;        ///< m/s, velocity along the constrained directions

  // For coupled runs (docs/theory/afemp.md); otherwise 0.
  std::vector<Matrix3> affine_velocity;     ///< 1/s, of nodes that move with the grid
  std::vector<std::uint8_t> on_surface;     ///< on a face of one element only
  std::vector<std::uint8_t> in_transition;  ///< moves with the grid in the present step

  [[nodiscard]] std::size_t size() const { return mass.size(); }

  static constexpr auto fields() {
    using N = Nodes;
    return std::make_tuple(
        Field{"id", "1", &N::id}, Field{"mass", "kg", &N::mass}, Field{"position", "m", &N::position},
        Field{"velocity", "m/s", &N::velocity}, Field{"force", "N", &N::force},
        Field{"constrained", "1", &N::constrained}, Field{"prescribed", "m/s", &N::prescribed},
        Field{"affine_velocity", "1/s", &N::affine_velocity}, Field{"on_surface", "1", &N::on_surface},
        Field{"in_transition", "1", &N::in_transition});
  }
};

struct Elements {
  std::vector<std::uint64_t> id;  ///< unique, never changes
  std::vector<Corners> corners;
  /// Holds the generalised forces Q_k (N) of the four hourglass modes (docs/theory/fem.md, 3), one array per component
  /// because kernels process several elements at a time; zero with Quadrature::b_bar.
  std::vector<double> hourglass_1x, hourglass_1y, hourglass_1z, hourglass_2x, hourglass_2y, hourglass_2z,
      hourglass_3x, hourglass_3y, hourglass_3z, hourglass_4x, hourglass_4y, hourglass_4z;
  std::vector<double> hourglass_energy;         ///< J, stored by the hourglass stiffness, never negative
  std::vector<double> hourglass_lead;           ///< J, by which it exceeds the work done (eq. 3.7)
  std::vector<double> returned_plastic_strain;  ///< already applied to hourglass forces (eq. 3.9)

  [[nodiscard]] std::size_t size() const { return id.size(); }

  /// Lists the components, mode by mode.
  static constexpr std::array<std::vector<double> Elements::*, 12> hourglass_components() {
    using E = Elements;
    return {&E::hourglass_1x, &E::hourglass_1y, &E::hourglass_1z, &E::hourglass_2x,
            &E::hourglass_2y, &E::hourglass_2z, &E::hourglass_3x, &E::hourglass_3y,
            &E::hourglass_3z, &E::hourglass_4x, &E::hourglass_4y, &E::hourglass_4z};
  }
  static constexpr auto fields() {
    using E = Elements;
    return std::make_tuple(
        Field{"id", "1", &E::id}, Field{"corners", "1", &E::corners},
        Field{"hourglass_1x", "N", &E::hourglass_1x}, Field{"hourglass_1y", "N", &E::hourglass_1y},
        Field{"hourglass_1z", "N", &E::hourglass_1z}, Field{"hourglass_2x", "N", &E::hourglass_2x},
        Field{"hourglass_2y", "N", &E::hourglass_2y}, Field{"hourglass_2z", "N", &E::hourglass_2z},
        Field{"hourglass_3x", "N", &E::hourglass_3x}, Field{"hourglass_3y", "N", &E::hourglass_3y},
        Field{"hourglass_3z", "N", &E::hourglass_3z}, Field{"hourglass_4x", "N", &E::hourglass_4x},
        Field{"hourglass_4y", "N", &E::hourglass_4y}, Field{"hourglass_4z", "N", &E::hourglass_4z},
        Field{"hourglass_energy", "J", &E::hourglass_energy},
        Field{"hourglass_lead", "J", &E::hourglass_lead},
        Field{"returned_plastic_strain", "1", &E::returned_plastic_strain});
  }
};

/// Holds the Gauss points; those of element e are the rows [e n, (e + 1) n) with n = points_per_element, in the order
/// of the nearest corners.
struct GaussPoints : MaterialPoints {
  std::vector<double> length;  ///< m, of the element: for time step and artificial viscosity (eq. 5.2)

  [[nodiscard]] std::size_t size() const { return mass.size(); }

  static constexpr auto fields() {
    return std::tuple_cat(MaterialPoints::fields(),
                          std::make_tuple(Field{"length", "m", &GaussPoints::length}));
  }
};

/// Holds the elements of one body on one rank.
struct Mesh {
  Quadrature quadrature = Quadrature::one_point;
  std::uint32_t body = 0;  ///< index of the body in the case
  bool has_path = false;   ///< of its prescribed velocities: it is a tool
  Nodes nodes;
  Elements elements;
  GaussPoints points;

  // Derived from the corners by `connect`: the corners that meet at node a are node_corners[first_corner[a]] ...
  // node_corners[first_corner[a + 1] - 1], each as 8 element + corner, ascending.
  std::vector<std::uint32_t> first_corner, node_corners;
  Blocks blocks;

  [[nodiscard]] std::span<const std::uint32_t> corners_at(std::size_t node) const {
    return std::span(node_corners).subspan(first_corner[node], first_corner[node + 1] - first_corner[node]);
  }
};

/// Creates nodes, elements and Gauss points with their volumes, in `storage_order`; ids count from the given numbers in
/// the order of the hexahedra. Mass, velocity and state are not set: call `set_density`, then `initialise`
/// (src/material/material.hpp) with `mesh.points`. The hexahedra must have passed `check`.
Mesh make_mesh(const Hexahedra& hexahedra, Quadrature quadrature, std::uint32_t body = 0,
               std::uint64_t first_node_id = 0, std::uint64_t first_element_id = 0);

/// Sets the masses of Gauss points (density in kg/m^3 times volume) and the lumped nodal masses.
void set_density(Mesh& mesh, double density);

/// Returns the contribution of an element to the lumped mass (kg) of the node at a corner, by row sums with the
/// quadrature of the element: m/8 with one point, the sum of N_a m_q over the Gauss points with eight.
double corner_mass(const Mesh& mesh, std::size_t element, std::size_t corner);

/// Rebuilds the data derived from the corners; required after the corners were set or read.
void connect(Mesh& mesh);

/// Sums the corner masses at the nodes.
void lump_masses(Mesh& mesh);

/// Removes elements (`removed` != 0) from the mesh, with their Gauss points and their contributions to the nodal
/// masses; nodes without elements are removed. The order of the remaining items is preserved.
void remove_elements(Mesh& mesh, std::span<const std::uint8_t> removed);

double mass(const Mesh& mesh, std::size_t element);
/// Returns the volume of the trilinear hexahedron (exact) or quadrilateral, m^3; negative if inverted.
double volume(const Mesh& mesh, std::size_t element);
/// Returns the minimum Jacobian of the corners over the mean one: 1 for a parallelepiped or parallelogram, 0 if a corner
/// is flat, negative if it is inverted.
double scaled_jacobian(const Mesh& mesh, std::size_t element);

/// Returns the nodes whose coordinate along an axis (0 to 2) is within `tolerance` (m) of the given one.
std::vector<std::uint32_t> nodes_on_plane(const Mesh& mesh, int axis, double coordinate, double tolerance);

/// Prescribes the velocity (m/s) of nodes along the directions of the bits (fem::constraint), in addition to existing
/// conditions. Fixed nodes: all and zero. Symmetry plane: its axis and zero.
void constrain(Nodes& nodes, std::span<const std::uint32_t> which, std::uint8_t directions,
               const Vector3& velocity = Vector3::Zero());
inline void constrain(Mesh& mesh, std::span<const std::uint32_t> which, std::uint8_t directions,
                      const Vector3& velocity = Vector3::Zero()) {
  constrain(mesh.nodes, which, directions, velocity);
}

/// Holds sums over a mesh (SI); bitwise independent of the number of threads.
struct MeshTotals {
  double mass = 0.0;
  Vector3 momentum = Vector3::Zero();
  double momentum_scale = 0.0;  ///< sum m |v|, the scale of momentum errors
  double kinetic_energy = 0.0;
  double internal_energy = 0.0;
  double hourglass_energy = 0.0;

  [[nodiscard]] double energy() const { return kinetic_energy + internal_energy + hourglass_energy; }
  MeshTotals& operator+=(const MeshTotals& other);
};
MeshTotals totals(const Mesh& mesh);
/// Returns the angular momentum about the origin, kg m^2/s.
Vector3 angular_momentum(const Mesh& mesh);

}  // namespace whipple::fem

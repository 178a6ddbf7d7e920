// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/build/meshing.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "src/core/base/error.hpp"
#include "src/fem/step.hpp"
#include "src/fem/structured.hpp"

namespace whipple::cases {
namespace {

constexpr double plane_tolerance = 1e-6;  ///< in cells

/// Describes a face of the domain at which bodies are cut, as a plane.
struct Plane {
  int axis;
  double coordinate, inward;  // m; +1 or -1
  grid::Boundary kind;
};

std::vector<Plane> planes_of(const Case& setup) {
  std::vector<Plane> planes;
  for (int face = 0; face < 6; ++face) {
    const grid::Boundary kind = setup.geometry.boundary[static_cast<std::size_t>(face)];
    if (kind == grid::Boundary::outflow) continue;
    const int axis = face / 2;
    const bool low = face % 2 == 0;
    planes.push_back(
        {axis, low ? setup.geometry.lower[axis] : setup.geometry.upper(axis), low ? 1.0 : -1.0, kind});
  }
  return planes;
}

/// Returns the region in front of all mirror planes.
Shape::Bounds before_planes(const Case& setup) {
  const Vector3 everywhere = Vector3::Constant(std::numeric_limits<double>::infinity());
  Shape::Bounds bounds{-everywhere, everywhere};
  if (setup.geometry.is_planar()) {  // one layer of elements behind the section
    bounds.lower[2] = 0.0;
    bounds.upper[2] = setup.domain.cell_size;
  }
  for (const Plane& plane : planes_of(setup)) {
    (plane.inward > 0.0 ? bounds.lower : bounds.upper)[plane.axis] = plane.coordinate;
  }
  return bounds;
}

/// Removes elements beyond a plane and moves nodes close to it exactly onto it.
void cut(fem::Hexahedra& mesh, const Plane& plane, double tolerance, const std::string& body) {
  for (Vector3& node : mesh.nodes) {
    double& x = node[plane.axis];
    if (std::abs(x - plane.coordinate) < tolerance) x = plane.coordinate;
  }
  std::vector<fem::Corners> kept;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    bool before = false, beyond = false;
    for (const std::uint32_t node : mesh.elements[e]) {
      const double depth = plane.inward * (mesh.nodes[node][plane.axis] - plane.coordinate);
      before = before || depth > 0.0;
      beyond = beyond || depth < 0.0;
    }
    if (before && beyond) {
      throw InputError(
          fmt::format("body \"{}\": the mirror plane {} = {} m cuts through element {}: nodes must be on it",
                      body, "xyz"[plane.axis], plane.coordinate, e));
    }
    if (before) kept.push_back(mesh.elements[e]);
  }
  mesh.elements = std::move(kept);
}

void drop_unused_nodes(fem::Hexahedra& mesh) {
  constexpr auto unused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(mesh.nodes.size(), unused);
  for (const fem::Corners& corners : mesh.elements) {
    for (const std::uint32_t node : corners) number[node] = 0;
  }
  std::vector<Vector3> nodes;
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    if (number[a] == unused) continue;
    number[a] = static_cast<std::uint32_t>(nodes.size());
    nodes.push_back(mesh.nodes[a]);
  }
  mesh.nodes = std::move(nodes);
  for (fem::Corners& corners : mesh.elements) {
    for (std::uint32_t& node : corners) node = number[node];
  }
}

/// Constrains nodes on mirror planes to the plane, and fixes nodes on no-slip walls.
void hold_at_planes(const Case& setup, fem::Mesh& mesh, Vector3& wall_impulse) {
  fem::Nodes& nodes = mesh.nodes;
  std::vector<double> heat(nodes.size(), 0.0);
  for (const Plane& plane : planes_of(setup)) {
    if (grid::lets_part(plane.kind)) continue;
    const std::uint8_t directions =
        plane.kind == grid::Boundary::no_slip ? fem::constraint::all : fem::constraint::axis(plane.axis);
    const std::vector<std::uint32_t> held =
        fem::nodes_on_plane(mesh, plane.axis, plane.coordinate, plane_tolerance * setup.geometry.cell_size);
    fem::constrain(mesh, held, directions, Vector3::Zero());
    for (const std::uint32_t a : held) {
      for (int i = 0; i < 3; ++i) {
        if ((directions & fem::constraint::axis(i)) == 0) continue;
        double& v = nodes.velocity[a][i];
        heat[a] += 0.5 * nodes.mass[a] * v * v;
        wall_impulse[i] -= nodes.mass[a] * v;
        v = 0.0;
      }
    }
  }
  fem::add_heat(mesh, heat);
}

void apply(const NodeCondition& condition, const std::string& body, fem::Mesh& mesh) {
  std::uint8_t directions = fem::constraint::none;
  for (const std::string& direction : condition.directions) {
    directions = static_cast<std::uint8_t>(directions | fem::constraint::axis(direction[0] - 'x'));
  }
  std::vector<std::uint32_t> inside;
  for (std::uint32_t a = 0; a < mesh.nodes.size(); ++a) {
    const Vector3& x = mesh.nodes.position[a];
    if ((x.array() >= condition.lower.array()).all() && (x.array() <= condition.upper.array()).all()) {
      inside.push_back(a);
    }
  }
  if (inside.empty()) {
    throw InputError(fmt::format("body \"{}\": a node_condition contains no node of its mesh", body));
  }
  fem::constrain(mesh, inside, directions, condition.velocity);
}

/// Moves the nodes so that the section has the bounds of the body: nodes of meshes of curved bodies lie outside of them,
/// for the sake of their volume (docs/theory/fem.md, 7).
void fit(fem::Hexahedra& section, const Shape::Bounds& whole, const Shape::Bounds& before) {
  for (int axis = 0; axis < 2; ++axis) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const Vector3& x : section.nodes) {
      least = std::min(least, x[axis]);
      most = std::max(most, x[axis]);
    }
    const double lower = std::max(whole.lower[axis], before.lower[axis]);
    const double upper = std::min(whole.upper[axis], before.upper[axis]);
    for (Vector3& x : section.nodes) {
      x[axis] = lower + (x[axis] - least) * (upper - lower) / (most - least);
    }
  }
}

/// Returns whether a body looks the same from all sides of the x axis.
bool is_of_revolution(const Shape& shape) {
  constexpr int samples = 40;
  const Shape::Bounds bounds = shape.bounds();
  const double radius = 1.5 * bounds.upper[1];
  for (int i = 0; i < samples; ++i) {
    const double x = bounds.lower[0] + (i + 0.5) / samples * (bounds.upper[0] - bounds.lower[0]);
    for (int j = 0; j < samples; ++j) {
      const double r = (j + 0.5) / samples * radius;
      for (const double angle : {0.4, 0.8, 1.2}) {
        const Vector3 around(x, r * std::cos(angle), r * std::sin(angle));
        if (shape.contains(around) != shape.contains(Vector3(x, r, 0.0))) return false;
      }
    }
  }
  return true;
}

/// Returns the volume of the elements at z > 0, m^3: turned shapes are meshed on both sides of the section.
double volume_behind_section(const fem::Hexahedra& mesh, double tolerance) {
  fem::Hexahedra behind{mesh.nodes, {}};
  for (const fem::Corners& corners : mesh.elements) {
    const auto above = [&](std::uint32_t a) { return mesh.nodes[a][2] > tolerance; };
    if (std::ranges::any_of(corners, above)) behind.elements.push_back(corners);
  }
  return fem::volume(behind);
}

/// Widens a section of a body of revolution until its rings have the volume of the body, four times that of the quarter
/// in three dimensions.
void give_volume(fem::Hexahedra& section, double volume) {
  const fem::Mesh rings = fem::make_mesh(section, fem::Quadrature::ring);
  double of_rings = 0.0;
  for (const double v : rings.points.volume) of_rings += v;
  for (Vector3& x : section.nodes) x[1] *= std::sqrt(volume / of_rings);
}

fem::Hexahedra cut_by_planes(const Case& setup, const Body& body, fem::Hexahedra mesh) {
  const double tolerance = plane_tolerance * setup.geometry.cell_size;
  for (const Plane& plane : planes_of(setup)) cut(mesh, plane, tolerance, body.name);
  drop_unused_nodes(mesh);
  fem::check(mesh, fmt::format("body \"{}\"", body.name));
  if (!setup.geometry.is_planar()) return mesh;
  fem::Hexahedra section = fem::section_of(mesh, tolerance);
  if (section.elements.empty()) {
    throw InputError(
        fmt::format("body \"{}\": no element of its mesh has a face in the plane z = 0, the section "
                    "that is simulated: move it so that a layer of elements begins there",
                    body.name));
  }
  if (!body.discretization.mesh.empty()) return section;
  fit(section, body.shape->bounds(), before_planes(setup));
  if (setup.geometry.is_axisymmetric() && is_of_revolution(*body.shape)) {
    give_volume(section, 4.0 * volume_behind_section(mesh, tolerance));
  }
  return section;
}

/// Returns the elements that a case asks for in the dimension of its domain.
fem::Quadrature quadrature_of(const Case& setup, const Body& body) {
  switch (setup.geometry.dimension) {
    case grid::Dimension::plane_strain:
      return fem::Quadrature::plane;
    case grid::Dimension::axisymmetric:
      return fem::Quadrature::ring;
    default:
      return body.discretization.element;
  }
}

}  // namespace

fem::Hexahedra hexahedra_of(const Case& setup, const Body& body) {
  const double size = body.discretization.size(setup.domain.cell_size);
  std::optional<fem::Hexahedra> mesh = body.shape->hexahedra(size, before_planes(setup));
  if (!mesh) {
    throw InputError(
        fmt::format("body \"{}\": there are structured meshes of box, cylinder, tube, sphere and ogive, "
                    "turned or moved ones "
                    "included; for other shapes give a Gmsh file, discretization.mesh",
                    body.name));
  }
  return cut_by_planes(setup, body, std::move(*mesh));
}

std::vector<fem::Mesh> make_meshes(const Case& setup, std::uint64_t first_particle_id,
                                   Vector3& wall_impulse) {
  std::vector<fem::Mesh> meshes;
  std::uint64_t node_id = 0, element_id = (first_particle_id + 7) / 8;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const Body& body = setup.bodies[b];
    if (!body.discretization.has_elements()) continue;
    const Material& material = *setup.materials[b];
    fem::Mesh& mesh =
        meshes.emplace_back(fem::make_mesh(hexahedra_of(setup, body), quadrature_of(setup, body),
                                           static_cast<std::uint32_t>(b), node_id, element_id));
    node_id += mesh.nodes.size();
    element_id += mesh.elements.size();
    const eos::State state = body.initial.of(material);
    fem::set_density(mesh, body_density(material, state));
    const std::vector<double> volume = mesh.points.volume;
    initialise(material, mesh.points, 0, mesh.points.size(), state);
    const std::size_t rows = fem::points_per_element(mesh.quadrature);
    if (body.varies_failure()) mesh.points.failure_threshold_factor.resize(mesh.points.size());
    for (std::size_t i = 0; body.varies_failure() && i < mesh.points.size(); ++i) {
      const std::uint64_t id = 8 * mesh.elements.id[i / rows] + i % rows;
      Vector3 place = Vector3::Zero();  // of the element's centre
      for (const std::uint32_t corner : mesh.elements.corners[i / rows])
        place += mesh.nodes.position[corner] / 8.0;
      mesh.points.failure_threshold_factor[i] = body.failure_factor(id, volume[i], place, setup.geometry);
    }
    if (body.strength_scatter.given()) mesh.points.strength_factor.resize(mesh.points.size());
    for (std::size_t i = 0; i < mesh.points.strength_factor.size(); ++i) {
      mesh.points.strength_factor[i] =
          body.strength_scatter.factor(8 * mesh.elements.id[i / rows] + i % rows);
    }
    const Shape::Bounds bounds = body.shape->bounds();
    const Vector3 center = 0.5 * (bounds.lower + bounds.upper);
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
      mesh.nodes.velocity[a] = body.velocity_at(mesh.nodes.position[a], center);
    }
    hold_at_planes(setup, mesh, wall_impulse);
    for (const NodeCondition& condition : body.node_conditions) apply(condition, body.name, mesh);
  }
  return meshes;
}

}  // namespace whipple::cases

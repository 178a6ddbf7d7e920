// SPDX-License-Identifier: BSD-3-Clause
#include "src/fem/mesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "src/base/error.hpp"
#include "src/fem/hexahedron.hpp"
#include "src/parallel/threads.hpp"

namespace whipple::fem {
namespace {

Modes<double> modes(const std::vector<Vector3>& position, const Corners& corners) {
  std::array<Triple<double>, 8> x;
  for (std::size_t a = 0; a < 8; ++a) {
    const Vector3& p = position[corners[a]];
    x[a] = {p[0], p[1], p[2]};
  }
  return modes_of(x);
}

double jacobian(const Modes<double>& x, std::size_t corner, double scale) {
  const auto& at = corner_coordinates[corner];
  return determinant(natural_gradient(x, scale * at[0], scale * at[1], scale * at[2]));
}

/// Trilinear shape function of a corner at a Gauss point.
double shape_at_gauss_point(std::size_t corner, std::size_t point) {
  double n = 0.125;
  for (std::size_t i = 0; i < 3; ++i) {
    n *= 1.0 + gauss_coordinate * corner_coordinates[corner][i] * corner_coordinates[point][i];
  }
  return n;
}

std::string inversion(const Modes<double>& x) {
  for (std::size_t a = 0; a < 8; ++a) {
    const double j = jacobian(x, a, 1.0);
    if (!(j > 0.0)) {
      return fmt::format(
          "inverted or flat at corner {}: Jacobian {:.6g} m^3 (volume {:.6g} m^3); the order of the corners "
          "is that "
          "of VTK and Gmsh: four around one face, then those above them",
          a, j, volume_of(x));
    }
  }
  for (std::size_t q = 0; q < 8; ++q) {
    const double j = jacobian(x, q, gauss_coordinate);
    if (!(j > 0.0)) return fmt::format("inverted inside: Jacobian {:.6g} m^3 at a Gauss point", j);
  }
  return {};
}

template <class Points>
void keep(Points& points, std::span<const std::uint32_t> kept, std::size_t rows_per_item) {
  for_each_field<Points>([&](const auto& field) {
    auto& values = points.*(field.values);
    if (field.optional && values.empty()) return;
    std::size_t to = 0;
    for (const std::size_t item : kept) {  // ascending: never overwrites what is still to be read
      for (std::size_t r = 0; r < rows_per_item; ++r) values[to++] = values[item * rows_per_item + r];
    }
    values.resize(to);
  });
}

}  // namespace

std::optional<Fault> first_fault(const Hexahedra& hexahedra) {
  for (std::size_t e = 0; e < hexahedra.elements.size(); ++e) {
    const Corners& corners = hexahedra.elements[e];
    for (const std::uint32_t node : corners) {
      if (node >= hexahedra.nodes.size()) {
        return Fault{e, fmt::format("node {} does not exist: there are {}", node, hexahedra.nodes.size())};
      }
      if (std::ranges::count(corners, node) > 1) {
        return Fault{
            e, fmt::format("degenerate: node {} stands at more than one corner ({}); only hexahedra with "
                           "eight different nodes are supported",
                           node, fmt::join(corners, ", "))};
      }
      if (!hexahedra.nodes[node].allFinite())
        return Fault{e, fmt::format("node {} has no finite position", node)};
    }
    std::string reason = inversion(modes(hexahedra.nodes, corners));
    if (!reason.empty()) return Fault{e, std::move(reason)};
  }
  return std::nullopt;
}

void check(const Hexahedra& hexahedra, const std::string& name) {
  if (hexahedra.elements.empty()) throw InputError(name + ": the mesh has no hexahedra");
  if (const auto fault = first_fault(hexahedra)) {
    throw InputError(fmt::format("{}: element {} is {}", name, fault->element, fault->reason));
  }
  std::vector<std::uint8_t> used(hexahedra.nodes.size());
  for (const Corners& corners : hexahedra.elements) {
    for (const std::uint32_t node : corners) used[node] = 1;
  }
  const auto unused = std::ranges::find(used, 0);
  if (unused != used.end()) {
    throw InputError(fmt::format("{}: node {} belongs to no element", name, unused - used.begin()));
  }
}

Mesh make_mesh(const Hexahedra& hexahedra, Quadrature quadrature, std::uint32_t body,
               std::uint64_t first_node_id, std::uint64_t first_element_id) {
  Mesh mesh;
  mesh.quadrature = quadrature;
  mesh.body = body;
  resize(mesh.nodes, hexahedra.nodes.size());
  resize(mesh.elements, hexahedra.elements.size());
  const std::size_t n = points_per_element(quadrature);
  resize(mesh.points, n * hexahedra.elements.size());
  std::iota(mesh.nodes.id.begin(), mesh.nodes.id.end(), first_node_id);
  std::iota(mesh.elements.id.begin(), mesh.elements.id.end(), first_element_id);
  mesh.nodes.position = hexahedra.nodes;
  for (auto* zero : {&mesh.nodes.velocity, &mesh.nodes.force, &mesh.nodes.prescribed}) {
    std::ranges::fill(*zero, Vector3::Zero());
  }
  mesh.elements.corners = hexahedra.elements;
  std::ranges::fill(mesh.elements.hourglass_force, HourglassForce::Zero());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const Modes<double> x = modes(mesh.nodes.position, mesh.elements.corners[e]);
    const VolumeGradient<double> g = volume_gradient(x);
    for (std::size_t q = 0; q < n; ++q) {
      mesh.points.volume[n * e + q] = n == 1 ? g.volume : jacobian(x, q, gauss_coordinate);
      mesh.points.length[n * e + q] = n == 1 ? one_point_length(g) : eight_point_size(x, g).length;
    }
  }
  connect(mesh);
  return mesh;
}

void set_density(Mesh& mesh, double density) {
  for (std::size_t i = 0; i < mesh.points.size(); ++i) mesh.points.mass[i] = density * mesh.points.volume[i];
  lump_masses(mesh);
}

double corner_mass(const Mesh& mesh, std::size_t element, std::size_t corner) {
  if (mesh.quadrature == Quadrature::one_point) return 0.125 * mesh.points.mass[element];
  double sum = 0.0;
  for (std::size_t q = 0; q < 8; ++q)
    sum += shape_at_gauss_point(corner, q) * mesh.points.mass[8 * element + q];
  return sum;
}

void connect(Mesh& mesh) {
  const auto& corners = mesh.elements.corners;
  mesh.first_corner.assign(mesh.nodes.size() + 1, 0);
  for (const Corners& nodes : corners) {
    for (const std::uint32_t node : nodes) ++mesh.first_corner[node + 1];
  }
  std::partial_sum(mesh.first_corner.begin(), mesh.first_corner.end(), mesh.first_corner.begin());
  mesh.node_corners.resize(8 * corners.size());
  std::vector<std::uint32_t> next(mesh.first_corner.begin(), mesh.first_corner.end() - 1);
  for (std::size_t e = 0; e < corners.size(); ++e) {
    for (std::size_t a = 0; a < 8; ++a) {
      mesh.node_corners[next[corners[e][a]]++] = static_cast<std::uint32_t>(8 * e + a);
    }
  }
  mesh.corner_force.resize(8 * corners.size());
}

void lump_masses(Mesh& mesh) {
  parallel::for_each(mesh.nodes.size(), [&](std::size_t a) {
    double sum = 0.0;
    for (const std::uint32_t corner : mesh.corners_at(a)) sum += corner_mass(mesh, corner / 8, corner % 8);
    mesh.nodes.mass[a] = sum;
  });
}

void remove_elements(Mesh& mesh, std::span<const std::uint8_t> removed) {
  std::vector<std::uint32_t> kept, kept_nodes, renumbered(mesh.nodes.size());
  for (std::uint32_t e = 0; e < mesh.elements.size(); ++e) {
    if (removed[e] == 0) kept.push_back(e);
  }
  for (std::uint32_t a = 0; a < mesh.nodes.size(); ++a) {
    const auto stays = [&](std::uint32_t corner) { return removed[corner / 8] == 0; };
    if (!std::ranges::any_of(mesh.corners_at(a), stays)) continue;
    renumbered[a] = static_cast<std::uint32_t>(kept_nodes.size());
    kept_nodes.push_back(a);
  }
  keep(mesh.elements, kept, 1);
  keep(mesh.points, kept, points_per_element(mesh.quadrature));
  keep(mesh.nodes, kept_nodes, 1);
  for (Corners& corners : mesh.elements.corners) {
    for (std::uint32_t& node : corners) node = renumbered[node];
  }
  connect(mesh);
  lump_masses(mesh);
}

double mass(const Mesh& mesh, std::size_t element) {
  const std::size_t n = points_per_element(mesh.quadrature);
  double sum = 0.0;
  for (std::size_t q = 0; q < n; ++q) sum += mesh.points.mass[n * element + q];
  return sum;
}

double volume(const Mesh& mesh, std::size_t element) {
  return volume_of(modes(mesh.nodes.position, mesh.elements.corners[element]));
}

double scaled_jacobian(const Mesh& mesh, std::size_t element) {
  const Modes<double> x = modes(mesh.nodes.position, mesh.elements.corners[element]);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < 8; ++a) least = std::min(least, jacobian(x, a, 1.0));
  return 8.0 * least / std::abs(volume_of(x));
}

std::vector<std::uint32_t> nodes_on_plane(const Mesh& mesh, int axis, double coordinate, double tolerance) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t a = 0; a < mesh.nodes.size(); ++a) {
    if (std::abs(mesh.nodes.position[a][axis] - coordinate) <= tolerance) found.push_back(a);
  }
  return found;
}

void constrain(Mesh& mesh, std::span<const std::uint32_t> nodes, std::uint8_t directions,
               const Vector3& velocity) {
  for (const std::uint32_t a : nodes) {
    mesh.nodes.constrained[a] = static_cast<std::uint8_t>(mesh.nodes.constrained[a] | directions);
    for (int i = 0; i < 3; ++i) {
      if ((directions & constraint::axis(i)) != 0) mesh.nodes.prescribed[a][i] = velocity[i];
    }
  }
}

MeshTotals& MeshTotals::operator+=(const MeshTotals& other) {
  mass += other.mass;
  momentum += other.momentum;
  angular_momentum += other.angular_momentum;
  momentum_scale += other.momentum_scale;
  kinetic_energy += other.kinetic_energy;
  internal_energy += other.internal_energy;
  hourglass_energy += other.hourglass_energy;
  return *this;
}

MeshTotals totals(const Mesh& mesh) {
  const Nodes& nodes = mesh.nodes;
  MeshTotals sum = parallel::sum<MeshTotals>(nodes.size(), [&](std::size_t a) {
    MeshTotals t;
    t.mass = nodes.mass[a];
    t.momentum = nodes.mass[a] * nodes.velocity[a];
    t.angular_momentum = nodes.position[a].cross(t.momentum);
    t.momentum_scale = t.momentum.norm();
    t.kinetic_energy = 0.5 * t.momentum.dot(nodes.velocity[a]);
    return t;
  });
  const auto& points = mesh.points;
  sum.internal_energy = parallel::sum<double>(
      points.size(), [&](std::size_t i) { return points.mass[i] * points.specific_internal_energy[i]; });
  sum.hourglass_energy = parallel::sum<double>(
      mesh.elements.size(), [&](std::size_t e) { return mesh.elements.hourglass_energy[e]; });
  return sum;
}

}  // namespace whipple::fem

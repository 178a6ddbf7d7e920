// SPDX-License-Identifier: BSD-3-Clause
#include "src/fem/mesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "src/core/base/error.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/fem/hexahedron.hpp"
#include "src/fem/lists.hpp"
#include "src/fem/order.hpp"
#include "src/fem/quadrilateral.hpp"

namespace whipple::fem {
namespace {

std::array<Triple<double>, 8> corner_positions(const std::vector<Vector3>& position, const Corners& corners) {
  std::array<Triple<double>, 8> x;
  for (std::size_t a = 0; a < 8; ++a) {
    const Vector3& p = position[corners[a]];
    x[a] = {p[0], p[1], p[2]};
  }
  return x;
}

Modes<double> modes(const std::vector<Vector3>& position, const Corners& corners) {
  return modes_of(corner_positions(position, corners));
}

double jacobian(const Modes<double>& x, std::size_t corner, double scale) {
  const auto& at = corner_coordinates[corner];
  return determinant(natural_gradient(x, scale * at[0], scale * at[1], scale * at[2]));
}

/// Returns the trilinear shape function of a corner at a Gauss point.
double shape_at_gauss_point(std::size_t corner, std::size_t point) {
  double n = 0.125;
  for (std::size_t i = 0; i < 3; ++i) {
    n *= 1.0 + gauss_coordinate * corner_coordinates[corner][i] * corner_coordinates[point][i];
  }
  return n;
}

/// Returns the mean radius of the corners, m.
double mean_radius(const std::vector<Vector3>& position, const Corners& corners) {
  double sum = 0.0;
  for (const std::uint32_t a : corners) sum += position[a][1];
  return sum / 8.0;
}

/// Sets volumes and lengths of the points of an element.
void measure(Mesh& mesh, std::size_t e) {
  const Modes<double> x = modes(mesh.nodes.position, mesh.elements.corners[e]);
  const double radius = mean_radius(mesh.nodes.position, mesh.elements.corners[e]);
  with_shape_of(mesh.quadrature, [&]<Quadrature quadrature>() {
    const VolumeGradient<double> g = volume_gradient_of<quadrature>(x, radius);
    const std::size_t n = points_per_element(mesh.quadrature);
    for (std::size_t q = 0; q < n; ++q) {
      mesh.points.volume[n * e + q] = n == 1 ? g.volume : jacobian(x, q, gauss_coordinate);
      mesh.points.length[n * e + q] =
          n == 1 ? length_of<quadrature>(g, radius) : eight_point_size(x, g).length;
    }
  });
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

/// Returns for each element the number of elements, starting with it, that form a row: each corner of the next element
/// is at the next slot.
std::vector<std::uint32_t> row_lengths(std::span<const Corners> slots) {
  std::vector<std::uint32_t> length(slots.size(), 1);
  for (std::size_t e = slots.size() - 1; e-- > 0;) {
    bool goes_on = true;
    for (std::size_t a = 0; a < 8; ++a) goes_on = goes_on && slots[e + 1][a] == slots[e][a] + 1;
    if (goes_on) length[e] = length[e + 1] + 1;
  }
  return length;
}

/// Divides the elements of a block into groups. @param slots  of the corners, relative to the block
void make_groups(Blocks& blocks, std::size_t first_element, std::span<const Corners> slots) {
  constexpr std::uint32_t worth_it = ElementGroup::size / 2;  // shorter rows are merged into a group
  const std::vector<std::uint32_t> length = row_lengths(slots);
  for (std::size_t e = 0; e < slots.size();) {
    const bool is_row = length[e] >= worth_it;
    std::size_t count = is_row ? std::min<std::size_t>(length[e], ElementGroup::size) : 1;
    while (!is_row && count < ElementGroup::size && e + count < slots.size() && length[e + count] < worth_it)
      ++count;
    ElementGroup& group = blocks.groups.emplace_back();
    group.first = static_cast<std::uint32_t>(first_element + e);
    group.count = static_cast<std::uint16_t>(count);
    group.is_row = is_row ? 1 : 0;
    for (std::size_t a = 0; a < 8; ++a) {
      for (std::size_t l = 0; l < ElementGroup::size; ++l)
        group.slot[a][l] = l < count ? static_cast<std::uint16_t>(slots[e + l][a]) : std::uint16_t{0};
      group.place[a] =
          is_row ? group.slot[a][0] : static_cast<std::uint16_t>(ElementGroup::gathered_place(a));
    }
    group.along = 0;
    constexpr std::array<std::size_t, 3> next_corner = {1, 3, 4};  // of the first, in each direction
    for (std::uint8_t axis = 0; is_row && axis < 3; ++axis) {
      if (group.slot[next_corner[axis]][0] == group.slot[0][0] + 1) group.along = axis + 1;
    }
    e += count;
  }
}

void find_runs(Blocks& blocks) {
  constexpr std::uint32_t longest = 64;  // so that there are enough of them for all threads
  blocks.runs.clear();
  blocks.shared_nodes.clear();
  for (std::uint32_t a = 0; a + 1 < blocks.first_of_node.size(); ++a) {
    const std::uint32_t first = blocks.first_of_node[a];
    if (blocks.first_of_node[a + 1] != first + 1) {
      blocks.shared_nodes.push_back(a);
      continue;
    }
    const std::uint32_t slot = blocks.slots_of_node[first];
    if (!blocks.runs.empty()) {
      Blocks::Run& last = blocks.runs.back();
      if (last.node + last.count == a && last.slot + last.count == slot && last.count < longest) {
        ++last.count;
        continue;
      }
    }
    blocks.runs.push_back({a, slot, 1});
  }
}

void make_blocks(Mesh& mesh) {
  Blocks& blocks = mesh.blocks;
  const auto& corners = mesh.elements.corners;
  blocks.first_group.assign(1, 0);
  blocks.groups.clear();
  blocks.first_slot.assign(1, 0);
  blocks.slot_node.clear();
  constexpr std::uint32_t none = 0xffffffff;
  std::vector<std::uint32_t> slot(mesh.nodes.size(), none), nodes;
  std::vector<Corners> slots;
  for (std::size_t begin = 0; begin < corners.size(); begin += Blocks::size) {
    const auto of_block = std::span(corners).subspan(begin, std::min(Blocks::size, corners.size() - begin));
    nodes.clear();
    for (const Corners& c : of_block) {
      for (const std::uint32_t node : c) {
        if (slot[node] != none) continue;
        slot[node] = 0;
        nodes.push_back(node);
      }
    }
    std::ranges::sort(nodes);
    for (std::uint32_t s = 0; s < nodes.size(); ++s) slot[nodes[s]] = s;
    slots.assign(of_block.begin(), of_block.end());
    for (Corners& c : slots) {
      for (std::uint32_t& node : c) node = slot[node];
    }
    for (const std::uint32_t node : nodes) slot[node] = none;
    make_groups(blocks, begin, slots);
    blocks.first_group.push_back(static_cast<std::uint32_t>(blocks.groups.size()));
    blocks.slot_node.insert(blocks.slot_node.end(), nodes.begin(), nodes.end());
    blocks.first_slot.push_back(static_cast<std::uint32_t>(blocks.slot_node.size()));
  }
  list_by_item(blocks.slot_node, mesh.nodes.size(), blocks.first_of_node, blocks.slots_of_node);
  find_runs(blocks);
  blocks.slot_force.resize(blocks.slot_node.size());
  blocks.forces_stand = false;
}

template <class Points>
void keep(Points& points, std::span<const std::uint32_t> kept, std::size_t rows_per_item) {
  for_each_field(points, [&](const auto& field) {
    auto& values = field.of(points);
    if (field.optional && values.empty()) return;
    std::size_t to = 0;
    for (const std::size_t item : kept) {  // ascending: never overwrites entries still to be read
      for (std::size_t r = 0; r < rows_per_item; ++r) values[to++] = values[item * rows_per_item + r];
    }
    values.resize(to);
  });
}

}  // namespace

std::optional<Fault> first_fault(const Hexahedra& hexahedra) {
  for (std::size_t e = 0; e < hexahedra.elements.size(); ++e) {
    const Corners& corners = hexahedra.elements[e];
    for (std::size_t a = 0; a < 8; ++a) {
      const std::uint32_t node = corners[a];
      if (node >= hexahedra.nodes.size()) {
        return Fault{
            e, fmt::format("wrong: node {} does not exist, there are {}", node, hexahedra.nodes.size())};
      }
      const auto twin = std::ranges::find(corners, node) - corners.begin();
      if (static_cast<std::size_t>(twin) != a) {
        return Fault{
            e, fmt::format("degenerate: corners {} and {} are one node; a hexahedron needs eight", twin, a)};
      }
      if (!hexahedra.nodes[node].allFinite()) {
        return Fault{e, fmt::format("wrong: corner {} has no finite position", a)};
      }
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
  const StorageOrder order = storage_order(hexahedra.nodes, hexahedra.elements);
  std::vector<std::uint32_t> number(hexahedra.nodes.size());
  for (std::uint32_t a = 0; a < order.nodes.size(); ++a) {
    number[order.nodes[a]] = a;
    mesh.nodes.id[a] = first_node_id + order.nodes[a];
    mesh.nodes.position[a] = hexahedra.nodes[order.nodes[a]];
  }
  for (std::size_t e = 0; e < order.elements.size(); ++e) {
    mesh.elements.id[e] = first_element_id + order.elements[e];
    for (std::size_t a = 0; a < 8; ++a) {
      mesh.elements.corners[e][a] = number[hexahedra.elements[order.elements[e]][a]];
    }
  }
  for (auto* zero : {&mesh.nodes.velocity, &mesh.nodes.force, &mesh.nodes.prescribed}) {
    std::ranges::fill(*zero, Vector3::Zero());
  }
  std::ranges::fill(mesh.nodes.affine_velocity, Matrix3::Zero());
  for (const auto component : Elements::hourglass_components())
    std::ranges::fill(mesh.elements.*component, 0.0);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) measure(mesh, e);
  connect(mesh);
  return mesh;
}

void set_density(Mesh& mesh, double density) {
  for (std::size_t i = 0; i < mesh.points.size(); ++i) mesh.points.mass[i] = density * mesh.points.volume[i];
  lump_masses(mesh);
}

double corner_mass(const Mesh& mesh, std::size_t element, std::size_t corner) {
  if (mesh.quadrature != Quadrature::b_bar) return 0.125 * mesh.points.mass[element];
  double sum = 0.0;
  for (std::size_t q = 0; q < 8; ++q)
    sum += shape_at_gauss_point(corner, q) * mesh.points.mass[8 * element + q];
  return sum;
}

void connect(Mesh& mesh) {
  const auto& corners = mesh.elements.corners;
  static_assert(sizeof(Corners) == 8 * sizeof(std::uint32_t));
  const std::span<const std::uint32_t> nodes = corners.empty()
                                                   ? std::span<const std::uint32_t>()
                                                   : std::span(corners.front().data(), 8 * corners.size());
  list_by_item(nodes, mesh.nodes.size(), mesh.first_corner, mesh.node_corners);
  make_blocks(mesh);
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

double volume(const Hexahedra& hexahedra) {
  double sum = 0.0;
  for (const Corners& corners : hexahedra.elements) sum += volume_of(modes(hexahedra.nodes, corners));
  return sum;
}

double volume(const Mesh& mesh, std::size_t element) {
  const Corners& corners = mesh.elements.corners[element];
  return with_shape_of(mesh.quadrature, [&]<Quadrature quadrature>() {
    return volume_gradient_of<quadrature>(modes(mesh.nodes.position, corners),
                                          mean_radius(mesh.nodes.position, corners))
        .volume;
  });
}

double scaled_jacobian(const Mesh& mesh, std::size_t element) {
  const std::array<Triple<double>, 8> x =
      corner_positions(mesh.nodes.position, mesh.elements.corners[element]);
  double least = std::numeric_limits<double>::infinity();
  if (is_flat(mesh.quadrature)) {  // the two edges of each corner: 4 times its Jacobian
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Triple<double> before = x[k] - x[(k + 3) % 4], behind = x[(k + 1) % 4] - x[k];
      const double twice_area = cross(before, behind).z;
      least = std::min(least, twice_area);
      sum += twice_area;
    }
    return 4.0 * least / std::abs(sum);
  }
  for (std::size_t layer = 0; layer < 8; layer += 4) {
    std::array<Triple<double>, 4> edge;  // around the face, from each corner to the next
    for (std::size_t k = 0; k < 4; ++k) edge[k] = x[layer + (k + 1) % 4] - x[layer + k];
    for (std::size_t k = 0; k < 4; ++k) {  // the three edges of the corner: 8 times its Jacobian
      least = std::min(least, dot(x[4 + k] - x[k], cross(edge[(k + 3) % 4], edge[k])));
    }
  }
  return least / std::abs(volume_of(modes_of(x)));
}

std::vector<std::uint32_t> nodes_on_plane(const Mesh& mesh, int axis, double coordinate, double tolerance) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t a = 0; a < mesh.nodes.size(); ++a) {
    if (std::abs(mesh.nodes.position[a][axis] - coordinate) <= tolerance) found.push_back(a);
  }
  return found;
}

void constrain(Nodes& nodes, std::span<const std::uint32_t> which, std::uint8_t directions,
               const Vector3& velocity) {
  for (const std::uint32_t a : which) {
    nodes.constrained[a] = static_cast<std::uint8_t>(nodes.constrained[a] | directions);
    for (int i = 0; i < 3; ++i) {
      if ((directions & constraint::axis(i)) != 0) nodes.prescribed[a][i] = velocity[i];
    }
  }
}

MeshTotals& MeshTotals::operator+=(const MeshTotals& other) {
  mass += other.mass;
  momentum += other.momentum;
  momentum_scale += other.momentum_scale;
  kinetic_energy += other.kinetic_energy;
  internal_energy += other.internal_energy;
  hourglass_energy += other.hourglass_energy;
  return *this;
}

namespace {

/// Computes sums over nodes, four at a time.
MeshTotals totals_of_nodes(const Nodes& nodes, std::size_t begin, std::size_t end) {
  Lanes mass{}, scale{}, twice_kinetic{};
  Triple<Lanes> momentum{};
  const auto add = [&](Lanes m, const Triple<Lanes>& v) {
    const Lanes px = m * v.x, py = m * v.y, pz = m * v.z;
    mass += m;
    momentum.x += px;
    momentum.y += py;
    momentum.z += pz;
    scale += sqrt(px * px + py * py + pz * pz);
    twice_kinetic += px * v.x + py * v.y + pz * v.z;
  };
  std::size_t a = begin;
  for (; a + 4 <= end; a += 4) add(load(&nodes.mass[a]), load_vectors(nodes.velocity[a].data()));
  for (; a < end; ++a) {
    const Vector3& v = nodes.velocity[a];
    add(Lanes{nodes.mass[a]}, {Lanes{v[0]}, Lanes{v[1]}, Lanes{v[2]}});
  }
  MeshTotals sum;
  sum.mass = sum4(mass);
  sum.momentum = Vector3(sum4(momentum.x), sum4(momentum.y), sum4(momentum.z));
  sum.momentum_scale = sum4(scale);
  sum.kinetic_energy = 0.5 * sum4(twice_kinetic);
  return sum;
}

/// Returns the sum over i of value(index of the first of four, number of them), four at a time.
template <class Value>
double sum_by_four(std::size_t n, Value&& value) {
  return parallel::sum_of_chunks<double>(n, [&](std::size_t begin, std::size_t end) {
    Lanes sum{};
    for (std::size_t i = begin; i < end; i += 4) sum += value(i, std::min<std::size_t>(4, end - i));
    return sum4(sum);
  });
}

}  // namespace

MeshTotals totals(const Mesh& mesh) {
  auto sum = parallel::sum_of_chunks<MeshTotals>(mesh.nodes.size(), [&](std::size_t begin, std::size_t end) {
    return totals_of_nodes(mesh.nodes, begin, end);
  });
  const GaussPoints& points = mesh.points;
  sum.internal_energy = sum_by_four(points.size(), [&](std::size_t i, std::size_t count) {
    return load(&points.mass[i], count, 0.0) * load(&points.specific_internal_energy[i], count, 0.0);
  });
  sum.hourglass_energy = sum_by_four(mesh.elements.size(), [&](std::size_t e, std::size_t count) {
    return load(&mesh.elements.hourglass_energy[e], count, 0.0);
  });
  return sum;
}

Vector3 angular_momentum(const Mesh& mesh) {
  const Nodes& nodes = mesh.nodes;
  Vector3 sum = Vector3::Zero();
  for (std::size_t a = 0; a < nodes.size(); ++a)
    sum += nodes.position[a].cross(nodes.mass[a] * nodes.velocity[a]);
  return sum;
}

}  // namespace whipple::fem

// SPDX-License-Identifier: BSD-3-Clause
#include "src/afemp/transition.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/grid/block_grid.hpp"
#include "src/grid/block_table.hpp"

namespace whipple::afemp {
namespace {

constexpr double on_plane = 1e-6;  ///< cells, distance from a face that still is on it

/// Who is in a cell: nobody, the surface of one body, or somebody that every body meets.
class Occupants {
 public:
  explicit Occupants(const grid::Geometry& geometry) : geometry_(geometry) { table_.reserve(1024); }

  void add_particle(const Vector3& position) { at(position) = anybody; }
  void add_surface(const Vector3& position, std::int32_t body) {
    std::int32_t& cell = at(position);
    if (cell == nobody) cell = body;
    if (cell != body) cell = anybody;
  }
  /// Does a body meet another one or particles in the cell of a point or one of the 26 around it?
  [[nodiscard]] bool meets(const Vector3& position, std::int32_t body) const {
    const Cell center = cell_of(position);
    const auto block = [](int cell) { return cell >> 2; };
    for (int x = block(center[0] - 1); x <= block(center[0] + 1); ++x) {
      for (int y = block(center[1] - 1); y <= block(center[1] + 1); ++y) {
        for (int z = block(center[2] - 1); z <= block(center[2] + 1); ++z) {
          const std::int32_t found = table_.find({x, y, z});
          if (found != grid::BlockTable::none && meets_in({x, y, z}, found, center, body)) return true;
        }
      }
    }
    return false;
  }

 private:
  static constexpr std::int32_t nobody = -1, anybody = -2;
  using Cell = std::array<int, 3>;

  /// The same, of the cells in one block.
  [[nodiscard]] bool meets_in(const Cell& block, std::int32_t number, const Cell& center,
                              std::int32_t body) const {
    const auto first = [&](std::size_t a) { return std::max(center[a] - 1, 4 * block[a]); };
    const auto last = [&](std::size_t a) { return std::min(center[a] + 1, 4 * block[a] + 3); };
    const auto& cells = cells_[static_cast<std::size_t>(number)];
    for (int i = first(0); i <= last(0); ++i) {
      for (int j = first(1); j <= last(1); ++j) {
        for (int k = first(2); k <= last(2); ++k) {
          const std::int32_t occupant = cells[index_in_block({i, j, k})];
          if (occupant != nobody && occupant != body) return true;
        }
      }
    }
    return false;
  }

  [[nodiscard]] Cell cell_of(const Vector3& position) const {
    const Vector3 cells = geometry_.in_cells(position);
    return {static_cast<int>(std::floor(cells[0])), static_cast<int>(std::floor(cells[1])),
            static_cast<int>(std::floor(cells[2]))};
  }
  static grid::BlockCoordinate block_of(const Cell& cell) {
    // Shifts of negative numbers round down, as wanted.
    return {cell[0] >> 2, cell[1] >> 2, cell[2] >> 2};
  }
  static std::size_t index_in_block(const Cell& cell) {
    return static_cast<std::size_t>(grid::node_index(cell[0] & 3, cell[1] & 3, cell[2] & 3));
  }
  static_assert(grid::block_edge == 4);

  std::int32_t& at(const Vector3& position) {
    const Cell cell = cell_of(position);
    const grid::BlockCoordinate block = block_of(cell);
    if (block != last_block_ || last_ == grid::BlockTable::none) {
      last_block_ = block;
      last_ = table_.find_or_insert(block, static_cast<std::int32_t>(cells_.size()));
      if (static_cast<std::size_t>(last_) == cells_.size()) cells_.emplace_back().fill(nobody);
    }
    return cells_[static_cast<std::size_t>(last_)][index_in_block(cell)];
  }

  const grid::Geometry& geometry_;
  grid::BlockTable table_;
  std::vector<std::array<std::int32_t, grid::nodes_per_block>> cells_;
  grid::BlockCoordinate last_block_{};
  std::int32_t last_ = grid::BlockTable::none;
};

/// Faces hold what lies on them, so that round-off does not take a node off a mirror plane.
bool inside(const grid::Geometry& geometry, const Vector3& position) {
  const double tolerance = on_plane * geometry.cell_size;
  for (int a = 0; a < 3; ++a) {
    if (position[a] < geometry.lower[a] - tolerance || position[a] > geometry.upper(a) + tolerance)
      return false;
  }
  return true;
}

/// Is every prescribed component that of a mirror plane on which the node lies, which the grid keeps as well?
bool keeps_to_planes_only(const fem::Nodes& nodes, std::size_t a, const grid::Geometry& geometry) {
  const double tolerance = on_plane * geometry.cell_size;
  for (int axis = 0; axis < 3; ++axis) {
    if ((nodes.constrained[a] & fem::constraint::axis(axis)) == 0) continue;
    if (nodes.prescribed[a][axis] != 0.0) return false;
    const auto face = static_cast<std::size_t>(2 * axis);
    const double x = nodes.position[a][axis];
    const bool on_lower =
        geometry.boundary[face] == grid::Boundary::symmetry && std::abs(x - geometry.lower[axis]) < tolerance;
    const bool on_upper = geometry.boundary[face + 1] == grid::Boundary::symmetry &&
                          std::abs(x - geometry.upper(axis)) < tolerance;
    if (!on_lower && !on_upper) return false;
  }
  return true;
}

bool lies_on_mirror(const fem::Mesh& mesh, const fem::Facet& facet, const grid::Geometry& geometry) {
  const double tolerance = on_plane * geometry.cell_size;
  for (int face = 0; face < 6; ++face) {
    const grid::Boundary kind = geometry.boundary[static_cast<std::size_t>(face)];
    if (kind != grid::Boundary::symmetry && kind != grid::Boundary::no_slip) continue;
    const int axis = face / 2;
    const double plane = face % 2 == 0 ? geometry.lower[axis] : geometry.upper(axis);
    if (std::ranges::all_of(facet, [&](std::uint32_t a) {
          return std::abs(mesh.nodes.position[a][axis] - plane) < tolerance;
        })) {
      return true;
    }
  }
  return false;
}

/// Calls f(mesh index, node, index among the transition nodes) for every marked node.
template <class Meshes, class Function>
void for_each_marked(Meshes& meshes, Function&& f) {
  std::size_t index = 0;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const std::vector<std::uint8_t>& marked = meshes[m].nodes.in_transition;
    for (std::size_t a = 0; a < marked.size(); ++a) {
      if (marked[a] != 0) f(m, a, index++);
    }
  }
}

/// Greatest sound speed of the elements around a node.
double sound_speed_at(const fem::Mesh& mesh, std::size_t node) {
  const std::size_t rows = fem::points_per_element(mesh.quadrature);
  double speed = 0.0;
  for (const std::uint32_t corner : mesh.corners_at(node)) {
    for (std::size_t row = corner / 8 * rows; row < (corner / 8 + 1) * rows; ++row) {
      speed = std::max(speed, mesh.points.sound_speed[row]);
    }
  }
  return speed;
}

}  // namespace

std::vector<fem::Facet> free_facets(const fem::Mesh& mesh, const grid::Geometry& geometry) {
  std::vector<fem::Facet> facets = fem::surface_facets(mesh);
  std::erase_if(facets, [&](const fem::Facet& facet) { return lies_on_mirror(mesh, facet, geometry); });
  return facets;
}

void mark_surface(fem::Mesh& mesh, const grid::Geometry& geometry) {
  std::ranges::fill(mesh.nodes.on_surface, std::uint8_t{0});
  for (const fem::Facet& facet : free_facets(mesh, geometry)) {
    for (const std::uint32_t node : facet) mesh.nodes.on_surface[node] = 1;
  }
}

double mark_transition(std::vector<fem::Mesh>& meshes, const Particles& particles,
                       const grid::Geometry& geometry, double affine_inertia) {
  Occupants occupants(geometry);
  for (const Vector3& position : particles.position) occupants.add_particle(position);
  if (meshes.size() > 1) {
    for (const fem::Mesh& mesh : meshes) {
      for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
        if (mesh.nodes.on_surface[a] == 0 || !inside(geometry, mesh.nodes.position[a])) continue;
        occupants.add_surface(mesh.nodes.position[a], static_cast<std::int32_t>(mesh.body));
      }
    }
  }
  double total_heat = 0.0;
  for (fem::Mesh& mesh : meshes) {
    fem::Nodes& nodes = mesh.nodes;
    std::vector<double> heat;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const Vector3& x = nodes.position[a];
      const bool now =
          nodes.on_surface[a] != 0 && inside(geometry, x) &&
          occupants.meets(x, static_cast<std::int32_t>(mesh.body)) &&
          (nodes.constrained[a] == fem::constraint::none || keeps_to_planes_only(nodes, a, geometry));
      if (nodes.in_transition[a] != 0 && !now) {
        heat.resize(nodes.size(), 0.0);
        heat[a] = 0.5 * nodes.mass[a] * affine_inertia * nodes.affine_velocity[a].squaredNorm();
        total_heat += heat[a];
        nodes.affine_velocity[a].setZero();
      }
      nodes.in_transition[a] = now ? 1 : 0;
    }
    if (!heat.empty()) fem::add_heat(mesh, heat);
  }
  return total_heat;
}

void collect(const std::vector<fem::Mesh>& meshes, transfer::TransitionNodes& nodes) {
  std::size_t count = 0;
  for_each_marked(meshes, [&](std::size_t, std::size_t, std::size_t) { ++count; });
  nodes.resize(count);
  for_each_marked(meshes, [&](std::size_t m, std::size_t a, std::size_t i) {
    const fem::Nodes& from = meshes[m].nodes;
    nodes.mass[i] = from.mass[a];
    nodes.sound_speed[i] = sound_speed_at(meshes[m], a);
    nodes.position[i] = from.position[a];
    nodes.velocity[i] = from.velocity[a];
    nodes.affine_velocity[i] = from.affine_velocity[a];
    nodes.force[i] = from.force[a];
  });
}

void distribute(const transfer::TransitionNodes& nodes, std::vector<fem::Mesh>& meshes,
                std::span<fem::Motion> motions, std::span<std::vector<double>> heat) {
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const std::size_t n = meshes[m].nodes.size();
    motions[m].mean.resize(n);
    motions[m].end.resize(n);
    heat[m].assign(n, 0.0);
  }
  for_each_marked(meshes, [&](std::size_t m, std::size_t a, std::size_t i) {
    fem::Nodes& to = meshes[m].nodes;
    to.velocity[a] = nodes.velocity[i];
    to.affine_velocity[a] = nodes.affine_velocity[i];
    motions[m].mean[a] = nodes.mean_velocity[i];
    motions[m].end[a] = nodes.new_velocity[i];
    heat[m][a] = nodes.heat[i] + nodes.contact_heat[i];
    for (int axis = 0; axis < 3; ++axis) {  // on mirror planes the grid gives 0 but for round-off
      if ((to.constrained[a] & fem::constraint::axis(axis)) == 0) continue;
      to.velocity[a][axis] = motions[m].end[a][axis] = to.prescribed[a][axis];
    }
  });
}

Vector3 stop_at_faces(fem::Mesh& mesh, const grid::Geometry& geometry, double dt, fem::Motion& motion,
                      std::span<double> heat) {
  Vector3 impulse = Vector3::Zero();
  fem::Nodes& nodes = mesh.nodes;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    for (int axis = 0; axis < 3; ++axis) {
      const double next = nodes.position[a][axis] + dt * motion.end[a][axis];
      const bool low = next < geometry.lower[axis];
      if (!low && next <= geometry.upper(axis)) continue;
      const auto face = static_cast<std::size_t>(2 * axis + (low ? 0 : 1));
      if (geometry.boundary[face] == grid::Boundary::outflow) continue;
      const double plane = low ? geometry.lower[axis] : geometry.upper(axis);
      // The displacement ends on the face. Work is done on the mean velocity: of nodes on the grid that of
      // the grid, which has seen the face.
      motion.end[a][axis] = (plane - nodes.position[a][axis]) / dt;
      if (nodes.in_transition[a] != 0) continue;
      const double mass = nodes.mass[a], after = motion.end[a][axis],
                   change = after - nodes.velocity[a][axis];
      motion.mean[a][axis] += 0.5 * change;
      nodes.velocity[a][axis] = after;
      impulse[axis] += mass * change;
      heat[a] -= mass * change * motion.mean[a][axis];
    }
  }
  return impulse;
}

}  // namespace whipple::afemp

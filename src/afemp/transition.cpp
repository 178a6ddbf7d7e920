// SPDX-License-Identifier: BSD-3-Clause
#include "src/afemp/transition.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/core/base/marks.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/grid/block_grid.hpp"
#include "src/grid/block_table.hpp"

namespace whipple::afemp {
namespace {

/// Marks the cells that contain a point or are next to such a cell (27 cells), as bits of blocks of 4 x 4 x 4 cells.
class Neighbourhood {
 public:
  explicit Neighbourhood(const grid::Geometry& geometry) : geometry_(geometry) { table_.reserve(1024); }

  void add(const Vector3& position) {
    const Cell cell = cell_of(position);
    at(block_of(cell)) |= bit(cell);
  }
  /// Adds cells of a block, as returned by `cells_in`.
  void add(const grid::BlockCoordinate& block, std::uint64_t cells) { at(block) |= cells; }
  [[nodiscard]] std::uint64_t cells_in(const grid::BlockCoordinate& block) const {
    const std::int32_t found = table_.find(block);
    return found == grid::BlockTable::none ? 0 : cells_[static_cast<std::size_t>(found)];
  }
  [[nodiscard]] const std::vector<grid::BlockCoordinate>& blocks() const { return coordinates_; }

  /// Adds the neighbours of all marked cells, direction by direction; call after the last `add`.
  void widen() {
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<std::uint64_t> cells = cells_;
      for (std::size_t b = 0; b < cells.size(); ++b) {
        if (cells[b] == 0) continue;
        const int stride = stride_of(axis);
        const std::uint64_t first = first_layer(axis), last = first << 3 * stride;
        cells_[b] |= (cells[b] & ~last) << stride | (cells[b] & ~first) >> stride;
        grid::BlockCoordinate neighbour = coordinates_[b];
        const auto spill = [&](int step, std::uint64_t layer) {
          if (layer == 0) return;
          neighbour[static_cast<std::size_t>(axis)] = coordinates_[b][static_cast<std::size_t>(axis)] + step;
          at(neighbour) |= layer;
        };
        spill(+1, (cells[b] & last) >> 3 * stride);
        spill(-1, (cells[b] & first) << 3 * stride);
      }
    }
  }

  [[nodiscard]] bool contains(const Vector3& position) const {
    const Cell cell = cell_of(position);
    const std::int32_t found = table_.find(block_of(cell));
    return found != grid::BlockTable::none && (cells_[static_cast<std::size_t>(found)] & bit(cell)) != 0;
  }

 private:
  using Cell = std::array<int, 3>;
  static constexpr grid::BlockShape cube = grid::block_shape(false);  // elements are three-dimensional
  static_assert(cube.edge == 4 && cube.edge_z == 4);

  [[nodiscard]] Cell cell_of(const Vector3& position) const {
    return floor_of_three(geometry_.in_cells(position));
  }
  static grid::BlockCoordinate block_of(const Cell& cell) {
    // Shifts of negative numbers round down, as required.
    return {{cell[0] >> 2, cell[1] >> 2, cell[2] >> 2}};
  }
  static std::uint64_t bit(const Cell& cell) {
    return std::uint64_t{1} << cube.node(cell[0] & 3, cell[1] & 3, cell[2] & 3);
  }

  static int stride_of(int axis) { return cube.node(axis == 0, axis == 1, axis == 2); }
  /// Returns the cells with the coordinate 0 along an axis.
  static std::uint64_t first_layer(int axis) {
    std::uint64_t layer = 0;
    for (int i = 0; i < cube.edge; ++i) {
      for (int j = 0; j < cube.edge; ++j) {
        layer |= bit(axis == 0 ? Cell{0, i, j} : axis == 1 ? Cell{i, 0, j} : Cell{i, j, 0});
      }
    }
    return layer;
  }

  std::uint64_t& at(const grid::BlockCoordinate& block) {
    // Particles are sorted by blocks. (Comparison of arrays is a function call, which would dominate the cost here.)
    const bool same = block[0] == last_block_[0] && block[1] == last_block_[1] && block[2] == last_block_[2];
    if (!same || last_ == grid::BlockTable::none) {
      last_block_ = block;
      last_ = table_.find_or_insert(block, static_cast<std::int32_t>(cells_.size()));
      if (static_cast<std::size_t>(last_) == cells_.size()) {
        cells_.push_back(0);
        coordinates_.push_back(block);
      }
    }
    return cells_[static_cast<std::size_t>(last_)];
  }

  const grid::Geometry& geometry_;
  grid::BlockTable table_;
  std::vector<std::uint64_t> cells_;                // by block
  std::vector<grid::BlockCoordinate> coordinates_;  // of the blocks
  grid::BlockCoordinate last_block_{};
  std::int32_t last_ = grid::BlockTable::none;
};

/// Returns whether a position is inside of the domain, including its faces with a tolerance, so that round-off does not
/// exclude a node on a mirror plane.
bool inside(const grid::Geometry& geometry, const Vector3& position) {
  for (int a = 0; a < 3; ++a) {
    if (position[a] < geometry.lower[a] - geometry.tolerance() ||
        position[a] > geometry.upper(a) + geometry.tolerance())
      return false;
  }
  return true;
}

/// Returns whether every prescribed component is that of a mirror plane containing the node, which the grid enforces as
/// well.
bool keeps_to_planes_only(const fem::Nodes& nodes, std::size_t a, const grid::Geometry& geometry) {
  for (int axis = 0; axis < 3; ++axis) {
    if ((nodes.constrained[a] & fem::constraint::axis(axis)) == 0) continue;
    if (nodes.prescribed[a][axis] != 0.0) return false;
    const std::size_t lower = 2 * static_cast<std::size_t>(axis);
    const auto keeps = [&](std::size_t face) {
      return geometry.boundary[face] == grid::Boundary::symmetry &&
             geometry.is_in_plane(face, nodes.position[a]);
    };
    if (!keeps(lower) && !keeps(lower + 1)) return false;
  }
  return true;
}

bool lies_on_mirror(const fem::Mesh& mesh, const fem::Facet& facet, const grid::Geometry& geometry) {
  for (std::size_t face = 0; face < 6; ++face) {
    if (geometry.mirrors(face) && std::ranges::all_of(facet, [&](std::uint32_t a) {
          return geometry.is_in_plane(face, mesh.nodes.position[a]);
        })) {
      return true;
    }
  }
  return false;
}

/// Calls f(mesh index, node, index among the interface nodes) for every interface node.
template <class Meshes, class Function>
void for_each_transition_node(Meshes& meshes, Function&& f) {
  std::size_t index = 0;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for_each_marked(meshes[m].nodes.in_transition, [&](std::size_t a) { f(m, a, index++); });
  }
}

/// Adds the cells of other ranks in the blocks around the surfaces of the meshes of this rank.
/// @param sets  the same number on all ranks, not yet widened
void add_of_other_ranks(const std::vector<fem::Mesh>& meshes, const grid::Geometry& geometry,
                        std::span<Neighbourhood* const> sets, MPI_Comm communicator) {
  const auto ranks = static_cast<std::size_t>(parallel::size(communicator));
  if (ranks == 1) return;
  Neighbourhood near(geometry);
  for (const fem::Mesh& mesh : meshes) {
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
      if (mesh.nodes.on_surface[a] != 0 && inside(geometry, mesh.nodes.position[a])) {
        near.add(mesh.nodes.position[a]);
      }
    }
  }
  near.widen();
  struct Cells {
    std::uint64_t cells;
    grid::BlockCoordinate block;
    std::uint32_t set;
  };
  std::vector<std::vector<grid::BlockCoordinate>> asked(ranks, near.blocks());
  const auto own = static_cast<std::size_t>(parallel::rank(communicator));
  asked[own].clear();
  const auto questions = parallel::exchange(communicator, asked);
  std::vector<std::vector<Cells>> answers(ranks);
  for (std::size_t r = 0; r < ranks; ++r) {
    for (const grid::BlockCoordinate& block : questions[r]) {
      for (std::uint32_t i = 0; i < sets.size(); ++i) {
        const std::uint64_t cells = sets[i]->cells_in(block);
        if (cells != 0) answers[r].push_back({cells, block, i});
      }
    }
  }
  for (const std::vector<Cells>& part : parallel::exchange(communicator, answers)) {
    for (const Cells& of_block : part) sets[of_block.set]->add(of_block.block, of_block.cells);
  }
}

}  // namespace

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

std::vector<fem::Facet> free_facets(const fem::Mesh& mesh, const grid::Geometry& geometry) {
  std::vector<fem::Facet> facets = fem::surface_facets(mesh, mesh.nodes.on_surface);
  std::erase_if(facets, [&](const fem::Facet& facet) { return lies_on_mirror(mesh, facet, geometry); });
  return facets;
}

void mark_surface(fem::Mesh& mesh, const grid::Geometry& geometry) {
  std::ranges::fill(mesh.nodes.on_surface, std::uint8_t{1});  // search all nodes
  const std::vector<fem::Facet> facets = free_facets(mesh, geometry);
  std::ranges::fill(mesh.nodes.on_surface, std::uint8_t{0});
  for (const fem::Facet& facet : facets) {
    for (const std::uint32_t node : facet) mesh.nodes.on_surface[node] = 1;
  }
}

double mark_transition(std::vector<fem::Mesh>& meshes, const Parts& parts, const Particles& particles,
                       const grid::Geometry& geometry, double affine_inertia, MPI_Comm communicator) {
  Neighbourhood of_particles(geometry);
  for (const Vector3& position : particles.position) of_particles.add(position);
  std::vector<std::size_t> first;  // of the parts of each mesh
  std::size_t count = 0;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    first.push_back(count);
    count += parts.count.empty() ? 1 : parts.count[m];
  }
  const auto part_of = [&](std::size_t m, std::size_t a) {
    const bool parted = !parts.of_node.empty() && !parts.of_node[m].empty();
    return first[m] + (parted ? parts.of_node[m][a] : std::size_t{0});
  };
  std::vector<Neighbourhood> of_surfaces(count > 1 ? count : 0, Neighbourhood(geometry));
  for (std::size_t m = 0; m < meshes.size() && count > 1; ++m) {
    const fem::Nodes& nodes = meshes[m].nodes;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      if (nodes.on_surface[a] != 0 && inside(geometry, nodes.position[a]))
        of_surfaces[part_of(m, a)].add(nodes.position[a]);
    }
  }
  std::vector<Neighbourhood*> sets = {&of_particles};
  for (Neighbourhood& of_surface : of_surfaces) sets.push_back(&of_surface);
  add_of_other_ranks(meshes, geometry, sets, communicator);
  for (Neighbourhood* set : sets) set->widen();
  const bool alone =
      std::ranges::all_of(sets, [](const Neighbourhood* set) { return set->blocks().empty(); });
  const auto meets = [&](std::size_t part, const Vector3& position) {
    if (of_particles.contains(position)) return true;
    for (std::size_t other = 0; other < of_surfaces.size(); ++other) {
      if (other != part && of_surfaces[other].contains(position)) return true;
    }
    return false;
  };
  double total_heat = 0.0;
  std::vector<double> heat;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    fem::Nodes& nodes = meshes[m].nodes;
    const auto belongs = [&](std::size_t a) {
      return nodes.on_surface[a] != 0 && inside(geometry, nodes.position[a]) &&
             meets(part_of(m, a), nodes.position[a]) &&
             (nodes.constrained[a] == fem::constraint::none || is_of_tool(meshes[m], a) ||
              keeps_to_planes_only(nodes, a, geometry));
    };
    std::vector<std::uint32_t> released;
    if (alone) {
      for_each_marked(nodes.in_transition,
                      [&](std::size_t a) { released.push_back(static_cast<std::uint32_t>(a)); });
      std::ranges::fill(nodes.in_transition, std::uint8_t{0});
    } else {
      released = parallel::where(nodes.size(), [&](std::size_t a) {
        const bool before = nodes.in_transition[a] != 0;
        if (!before && nodes.on_surface[a] == 0) return false;
        const bool now = belongs(a);
        nodes.in_transition[a] = now ? 1 : 0;
        return before && !now;
      });
    }
    if (released.empty()) continue;
    heat.assign(nodes.size(), 0.0);
    for (const std::uint32_t a : released) {
      heat[a] = 0.5 * nodes.mass[a] * affine_inertia * nodes.affine_velocity[a].squaredNorm();
      nodes.affine_velocity[a].setZero();
      total_heat += heat[a];
    }
    fem::add_heat(meshes[m], heat);
  }
  return total_heat;
}

void collect(const std::vector<fem::Mesh>& meshes, transfer::TransitionNodes& nodes) {
  std::size_t count = 0;
  for_each_transition_node(meshes, [&](std::size_t, std::size_t, std::size_t) { ++count; });
  nodes.resize(count);
  nodes.unrelaxed = count;
  for_each_transition_node(meshes, [&](std::size_t m, std::size_t a, std::size_t i) {
    const fem::Nodes& from = meshes[m].nodes;
    const bool of_tool = is_of_tool(meshes[m], a);
    nodes.mass[i] = (of_tool ? tool_weight : 1.0) * from.mass[a];
    nodes.sound_speed[i] = sound_speed_at(meshes[m], a);
    nodes.position[i] = from.position[a];
    nodes.velocity[i] = from.velocity[a];
    nodes.affine_velocity[i] = from.affine_velocity[a];
    nodes.force[i] = of_tool ? Vector3::Zero() : from.force[a];
  });
}

namespace {

/// Moves an interface node of a tool along its path instead of as the grid did: equation 2.6 of docs/theory/afemp.md.
fem::ConstraintBalance keep_to_path(const transfer::TransitionNodes& nodes, std::size_t i, fem::Nodes& to,
                                    std::size_t a, fem::Motion& motion, double path, const ToolStep& step) {
  const double mass = to.mass[a], on_grid = nodes.mass[i];
  const Vector3 before = to.velocity[a], after = path * to.prescribed[a], of_grid = nodes.velocity[i];
  const Vector3 mean = 0.5 * (before + after);
  fem::ConstraintBalance balance;
  balance.impulse = mass * (after - before) - on_grid * (of_grid - before) - step.dt * to.force[a];
  balance.work = 0.5 * mass * (after - before).dot(after + before) -
                 0.5 * on_grid * (of_grid - before).dot(of_grid + before) -
                 0.5 * on_grid * step.affine_inertia * nodes.affine_velocity[i].squaredNorm() -
                 step.dt * to.force[a].dot(mean);
  to.velocity[a] = motion.end[a] = after;
  to.affine_velocity[a].setZero();
  motion.mean[a] = mean;
  return balance;
}

}  // namespace

void distribute(const transfer::TransitionNodes& nodes, std::vector<fem::Mesh>& meshes,
                std::span<fem::Motion> motions, std::span<std::vector<double>> heat, const ToolStep& step,
                std::span<fem::ConstraintBalance> tools) {
  std::ranges::fill(tools, fem::ConstraintBalance{});
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const std::size_t n = meshes[m].nodes.size();
    motions[m].mean.resize(n);
    motions[m].end.resize(n);
    heat[m].assign(n, 0.0);
  }
  for_each_transition_node(meshes, [&](std::size_t m, std::size_t a, std::size_t i) {
    fem::Nodes& to = meshes[m].nodes;
    heat[m][a] = nodes.heat[i] + nodes.contact_heat[i];
    if (is_of_tool(meshes[m], a)) {
      tools[m] += keep_to_path(nodes, i, to, a, motions[m], step.path[m], step);
      return;
    }
    to.velocity[a] = nodes.velocity[i];
    to.affine_velocity[a] = nodes.affine_velocity[i];
    motions[m].mean[a] = nodes.mean_velocity[i];
    motions[m].end[a] = nodes.new_velocity[i];
    for (int axis = 0; axis < 3; ++axis) {  // on mirror planes, the grid velocity is 0 up to round-off
      if ((to.constrained[a] & fem::constraint::axis(axis)) == 0) continue;
      to.velocity[a][axis] = motions[m].end[a][axis] = to.prescribed[a][axis];
    }
  });
}

Vector3 stop_at_faces(fem::Nodes& nodes, const grid::Geometry& geometry, double dt, fem::Motion& motion,
                      std::span<double> heat) {
  const auto stop = [&](std::size_t a, fem::ConstraintBalance& balance) {
    for (int axis = 0; axis < 3; ++axis) {
      const double next = nodes.position[a][axis] + dt * motion.end[a][axis];
      const bool low = next < geometry.lower[axis];
      if (!low && next <= geometry.upper(axis)) continue;
      const std::size_t face = 2 * static_cast<std::size_t>(axis) + (low ? 0 : 1);
      if (geometry.boundary[face] == grid::Boundary::outflow) continue;
      const double plane = low ? geometry.lower[axis] : geometry.upper(axis);
      // The displacement ends on the face. Work is computed with the mean velocity; for interface nodes this is that of
      // the grid, which accounts for the face.
      motion.end[a][axis] = (plane - nodes.position[a][axis]) / dt;
      if (nodes.in_transition[a] != 0) continue;
      const double mass = nodes.mass[a], after = motion.end[a][axis],
                   change = after - nodes.velocity[a][axis];
      motion.mean[a][axis] += 0.5 * change;
      nodes.velocity[a][axis] = after;
      balance.impulse[axis] += mass * change;
      heat[a] -= mass * change * motion.mean[a][axis];
    }
  };
  const auto impulse = [&](std::size_t begin, std::size_t end) {
    fem::ConstraintBalance balance;
    for (std::size_t first = begin; first < end; first += 4) {
      const std::size_t count = std::min<std::size_t>(4, end - first);
      if (count == 4) {
        const double* const position = nodes.position[first].data();
        const double* const velocity = motion.end[first].data();
        const auto next = [&](std::size_t j) { return load(position + j) + dt * load(velocity + j); };
        if (geometry.contains_four({next(0), next(4), next(8)})) continue;
      }
      for (std::size_t a = first; a < first + count; ++a) stop(a, balance);
    }
    return balance;
  };
  return parallel::sum_of_chunks<fem::ConstraintBalance>(nodes.size(), impulse).impulse;
}

}  // namespace whipple::afemp

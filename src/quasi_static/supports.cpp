// SPDX-License-Identifier: BSD-3-Clause
#include "src/quasi_static/supports.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>

#include "src/transfer/plain_nodes.hpp"

namespace whipple::quasi_static {
namespace {

namespace plain = transfer::plain;
using grid::BlockGrid;
using Place = std::array<std::int32_t, 3>;

/// Numbers the nodes that are reached, in the order of the grid.
void number_nodes(Supports& supports, const BlockGrid& grid) {
  std::vector<std::int32_t> number(grid.all_nodes().size(), -1);
  for (const Reached& reached : supports.particles.reached) number[reached.node] = 0;
  for (std::size_t node = 0; node < number.size(); ++node) {
    if (number[node] < 0) continue;
    number[node] = static_cast<std::int32_t>(supports.nodes());
    supports.grid_node.push_back(static_cast<std::uint32_t>(node));
    supports.places.push_back(grid.place_of_node(node));
  }
  for (Reached& reached : supports.particles.reached) {
    reached.node = static_cast<std::uint32_t>(number[reached.node]);
  }
}

/// Lists the nodes of every particle, by their index in the grid.
void list_nodes(Supports& supports, const plain::Functions& functions, double smoothing,
                const Particles& particles, BlockGrid& grid) {
  const std::size_t width = functions.count * functions.count * functions.count_z;
  std::vector<Reached> all(particles.size() * width);
  std::vector<std::size_t> count(particles.size(), 0);
  const auto places = grid.places(BlockGrid::Points::particles);
  const grid::Node* const first = grid.all_nodes().data();
  for (std::size_t slot = 0; slot < grid.owned_slots(); ++slot) {
    const transfer::Cells cells(grid, slot, smoothing);
    const plain::NodesAround nodes(grid, slot, 0, functions.stencil);
    for (const std::uint32_t p : grid.particles_in(slot)) {
      plain::for_each_node(functions, particles, p, places[p], cells, nodes,
                           [&](const grid::Node& node, const plain::AtNode& at) {
                             if (at.n == 0.0 && at.gradient.isZero(0.0)) return;
                             all[p * width + count[p]++] = {static_cast<std::uint32_t>(&node - first), at.n,
                                                            at.gradient};
                           });
    }
  }
  Reach& reach = supports.particles;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(p * width);
    reach.reached.insert(reach.reached.end(), begin, begin + static_cast<std::ptrdiff_t>(count[p]));
    reach.begin.push_back(reach.reached.size());
  }
}

/// Adds integration points to the cells at the border of the material, those with particles and a neighbour without:
/// two along each direction. A point holds the difference of the slopes there and at the same place of the neighbour
/// that holds the most material, so that it resists only what a uniform deformation does not explain (eq. 9).
class Border {
 public:
  Border(Supports& supports, const plain::Functions& functions, double smoothing, const Particles& particles,
         const BlockGrid& grid)
      : supports_(supports),
        functions_(functions),
        geometry_(grid.geometry()),
        cells_(grid, 0, smoothing),
        directions_(geometry_.is_planar() ? 2 : 3) {
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Lanes x = geometry_.in_cells(particles.position[p]);
      Place cell{};
      for (int a = 0; a < directions_; ++a)
        cell[static_cast<std::size_t>(a)] = static_cast<std::int32_t>(std::floor(x[a]));
      Filling& filling = filled_.try_emplace(cell, Filling{static_cast<std::uint32_t>(p), 0.0}).first->second;
      filling.volume += geometry_.size_in_section(particles.volume[p], particles.position[p]);
    }
    for (std::size_t i = 0; i < supports.nodes(); ++i) {
      Place place = supports.places[i];
      if (directions_ == 2) place[2] = 0;
      node_at_[place] = i;
    }
  }

  void add() {
    for (const auto& [cell, filling] : filled_) {
      if (const std::optional<Place> fuller = fullest_neighbour(cell, filling)) {
        add_points(cell, *fuller, filling.particle);
      }
    }
  }

 private:
  struct Filling {
    std::uint32_t particle;  // one of them
    double volume;           // in the plane: area
  };

  /// Returns the neighbour of a cell at the border that holds the most material, none of other cells or if none holds
  /// more.
  [[nodiscard]] std::optional<Place> fullest_neighbour(const Place& cell, const Filling& own) const {
    constexpr double more = 1.0 + 1e-6;
    const int first_z = directions_ == 3 ? -1 : 0;
    bool is_border = false;
    std::optional<Place> fullest;
    double most = more * own.volume;
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        for (int k = first_z; k <= -first_z; ++k) {
          const Place place = {cell[0] + i, cell[1] + j, cell[2] + k};
          const auto found = filled_.find(inside(place));
          if (found == filled_.end()) {
            is_border = true;
          } else if (found->first == place && found->second.volume > most) {
            most = more * found->second.volume;
            fullest = place;
          }
        }
      }
    }
    return is_border ? fullest : std::nullopt;
  }
  /// Returns a cell, beyond a mirror plane its image.
  [[nodiscard]] Place inside(Place cell) const {
    for (std::size_t a = 0; a < static_cast<std::size_t>(directions_); ++a) {
      if (cell[a] < 0 && geometry_.mirrors(2 * a)) cell[a] = -1 - cell[a];
      if (cell[a] >= geometry_.cells[a] && geometry_.mirrors(2 * a + 1)) {
        cell[a] = 2 * geometry_.cells[a] - 1 - cell[a];
      }
    }
    return cell;
  }
  void add_points(const Place& cell, const Place& fuller, std::uint32_t particle) {
    const double near = 0.5 - 0.5 / std::sqrt(3.0);
    const double dx = geometry_.cell_size;
    for (int corner = 0; corner < 1 << directions_; ++corner) {
      Vector3 x = Vector3::Zero(), shift = x;  // in cells
      for (int a = 0; a < directions_; ++a) {
        const auto i = static_cast<std::size_t>(a);
        x[a] = cell[i] + ((corner >> a & 1) != 0 ? 1.0 - near : near);
        shift[a] = fuller[i] - cell[i];
      }
      std::map<std::uint32_t, Vector3> slopes;
      if (!add_slopes(x, 1.0, slopes) || !add_slopes(x + shift, -1.0, slopes)) continue;
      for (const auto& [node, slope] : slopes) supports_.border.reached.push_back({node, 0.0, slope});
      supports_.border.begin.push_back(supports_.border.reached.size());
      const Vector3 position = geometry_.lower + dx * x;
      const double depth = directions_ == 2 ? geometry_.depth(position) : dx;
      supports_.border_volume.push_back(dx * dx * depth / (1 << directions_));
      supports_.border_particle.push_back(particle);
    }
  }
  /// Adds the slopes of the nodes at a place, times a factor. @returns whether all their displacements are known
  [[nodiscard]] bool add_slopes(const Vector3& x, double factor,
                                std::map<std::uint32_t, Vector3>& slopes) const {
    constexpr double quarter = 0.25;  // half-size of the domain of a point with GIMP, in cells
    std::array<transfer::AxisWeights<plain::most_nodes>, 3> along;
    Place first{};
    for (int a = 0; a < 3; ++a) {
      const auto i = static_cast<std::size_t>(a);
      if (a >= directions_) {
        along[i] = plain::across_plane();
        continue;
      }
      first[i] = static_cast<std::int32_t>(std::floor(x[a] - functions_.stencil.shift));
      along[i] = plain::along_axis(functions_.kind, x[a] - first[i], quarter, cells_.along(i));
    }
    const auto &u = along[0], &v = along[1], &w = along[2];
    for (std::size_t i = 0; i < functions_.count; ++i) {
      for (std::size_t j = 0; j < functions_.count; ++j) {
        for (std::size_t k = 0; k < functions_.count_z; ++k) {
          const Place place = {first[0] + static_cast<std::int32_t>(i),
                               first[1] + static_cast<std::int32_t>(j),
                               first[2] + static_cast<std::int32_t>(k)};
          const Vector3 slope = factor * Vector3(u.derivative[i] * v.weight[j] * w.weight[k],
                                                 u.weight[i] * v.derivative[j] * w.weight[k],
                                                 u.weight[i] * v.weight[j] * w.derivative[k]);
          if (!add_slope(place, slope, slopes)) return false;
        }
      }
    }
    return true;
  }
  /// Adds the slope of a node. One that no particle reaches moves as the line through two others, so that a uniform
  /// deformation has no force and forces balance. @returns whether there are such two
  [[nodiscard]] bool add_slope(const Place& place, const Vector3& slope,
                               std::map<std::uint32_t, Vector3>& slopes) const {
    const auto add = [&](std::size_t node, double times) {
      slopes.try_emplace(static_cast<std::uint32_t>(node), Vector3::Zero()).first->second += times * slope;
    };
    if (const auto own = node_at_.find(place); own != node_at_.end()) {
      add(own->second, 1.0);
      return true;
    }
    const int first_z = directions_ == 3 ? -1 : 0;
    for (int axes = 1; axes <= directions_; ++axes) {  // along one axis if possible, then along diagonals
      for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) {
          for (int k = first_z; k <= -first_z; ++k) {
            if (std::abs(i) + std::abs(j) + std::abs(k) != axes) continue;
            const auto near = node_at_.find({place[0] + i, place[1] + j, place[2] + k});
            const auto far = node_at_.find({place[0] + 2 * i, place[1] + 2 * j, place[2] + 2 * k});
            if (near == node_at_.end() || far == node_at_.end()) continue;
            add(near->second, 2.0);
            add(far->second, -1.0);
            return true;
          }
        }
      }
    }
    return false;
  }

  Supports& supports_;
  const plain::Functions& functions_;
  const grid::Geometry& geometry_;
  transfer::Cells cells_;
  int directions_;
  std::map<Place, Filling> filled_;
  std::map<Place, std::size_t> node_at_;
};

}  // namespace

Supports find_supports(const transfer::ShapeFunctions& functions, const Particles& particles, BlockGrid& grid,
                       bool with_border) {
  return transfer::with_shape(functions.kind, [&]<class Shape>(Shape) {
    const plain::Functions as_numbers = plain::functions<Shape>();
    const double smoothing = functions.slope_smoothing;
    Supports supports;
    supports.dimension = grid.geometry().dimension;
    supports.most_along = static_cast<int>(as_numbers.count);
    list_nodes(supports, as_numbers, smoothing, particles, grid);
    number_nodes(supports, grid);
    if (grid.geometry().is_axisymmetric()) {
      for (const Vector3& x : particles.position) supports.per_radius.push_back(1.0 / x[1]);
    }
    if (with_border) {
      supports.most_along += 3;  // with the neighbour of a cell, and two nodes more on a line
      Border(supports, as_numbers, smoothing, particles, grid).add();
    }
    return supports;
  });
}

}  // namespace whipple::quasi_static

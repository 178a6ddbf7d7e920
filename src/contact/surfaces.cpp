// SPDX-License-Identifier: BSD-3-Clause
#include "src/contact/surfaces.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "src/contact/parting.hpp"
#include "src/parallel/threads.hpp"

namespace whipple::contact {
namespace {

using grid::BlockGrid;
using grid::nodes_per_block;

/// Change of a body's volume per node from one node to the next, relative, below which the node lies inside
/// and the direction of the gradient is that of the pattern of the particles.
constexpr double least_slope = 0.02;
/// Cosine of the angle between two normals above which they are one.
constexpr double one_direction = 1.0 - 1e-6;

/// Lays out values of contact slots: `per_node(fields)` lanes for each node of a slot with that many fields.
template <class PerNode>
void lay_out(grid::ContactValues& values, const BlockGrid& grid, Lanes initial, PerNode&& per_node) {
  values.begin.assign(1, 0);
  for (const std::uint32_t slot : grid.contact_slots()) {
    const auto fields = static_cast<std::size_t>(std::popcount(grid.fields(slot)));
    values.begin.push_back(values.begin.back() +
                           static_cast<std::uint32_t>(per_node(fields) * nodes_per_block));
  }
  values.values.assign(values.begin.back(), initial);
}

std::size_t one_per_field(std::size_t fields) { return fields; }
std::size_t one_per_pair(std::size_t fields) { return fields * (fields - 1) / 2; }

/// A node of a contact slot as a particle, or its image beyond a mirror plane, sees it.
struct Place {
  std::size_t contact_slot;
  std::size_t fields;  ///< of the slot
  std::size_t field;   ///< of the particle, counted among those of the slot
  std::size_t node;    ///< in its block
  double weight;       ///< N
  Vector3 gradient;    ///< of N
  Vector3 distance;    ///< position of the particle, or its image, minus that of the node
  Vector3 off_plane;   ///< 0 along the normals of the mirror planes that the node is on
  Vector3 sign;        ///< of the components under the reflections that lead to the image

  /// Calls f(pair, is the particle of its first field?) for the pairs that the particle's field is part of.
  template <class Function>
  void for_each_pair(Function&& f) const {
    for (std::size_t other = 0; other < fields; ++other) {
      if (other < field) f(Surfaces::pair_index(other, field, fields), false);
      if (other > field) f(Surfaces::pair_index(field, other, fields), true);
    }
  }
  [[nodiscard]] std::size_t in(const grid::ContactValues& values, std::size_t array,
                               std::size_t lanes = 1) const {
    return values.begin[contact_slot] + lanes * (array * nodes_per_block + node);
  }
};

/// One direction of a stencil, folded at mirror planes: what lies beyond a plane is seen from the image of
/// the particle at the image of the node.
template <int count>
struct FoldedAxis {
  std::array<int, count> node;          ///< from the block's lower corner
  std::array<double, count> sign;       ///< -1 beyond a plane
  std::array<double, count> off_plane;  ///< 0 on a plane, where particle and image make up for one another
};

template <int count>
FoldedAxis<count> fold(const BlockGrid& grid, int axis, int block, int first, unsigned field) {
  FoldedAxis<count> folded;
  const grid::Geometry& g = grid.geometry();
  const auto a = static_cast<std::size_t>(axis);
  const bool lower = grid.is_bonded_at(2 * a, field), upper = grid.is_bonded_at(2 * a + 1, field);
  for (int i = 0; i < count; ++i) {
    const auto n = static_cast<std::size_t>(i);
    int place = block * grid::block_edge + first + i;
    folded.sign[n] = 1.0;
    const auto reflect = [&](int at) {
      place = 2 * at - place;
      folded.sign[n] = -folded.sign[n];
    };
    if (lower && place < 0) reflect(0);
    if (upper && place > g.cells[a]) reflect(g.cells[a]);
    folded.off_plane[n] = (lower && place == 0) || (upper && place == g.cells[a]) ? 0.0 : 1.0;
    folded.node[n] = place - block * grid::block_edge;
  }
  return folded;
}

/// Nodes of each contact slot that matter: a bit each.
using NodesThatMatter = std::vector<std::uint64_t>;
static_assert(nodes_per_block == 64);

/// Calls f(place) for the nodes of contact slots that matter and that a point of the field reaches.
/// @param block       where the point is
/// @param neighbours  slots of the 27 blocks around it, as far as they count
/// @param at_point    makes f, if there are any
template <class Shape, class Points, class AtPoint>
void for_each_place_of(const Points& points, std::uint32_t p, unsigned field,
                       const grid::BlockCoordinate& block, const std::array<std::int32_t, 27>& neighbours,
                       const BlockGrid& grid, const NodesThatMatter& matter, AtPoint&& at_point) {
  static constexpr grid::ReachMap map = grid::reach_map();
  constexpr int count = Shape::count;
  const grid::Geometry& geometry = grid.geometry();
  const grid::PlaceInStencil in_stencil = grid::StencilPlaces(Shape::stencil)(
      grid::position_in_block(geometry.in_cells(points.position[p]), grid::corner_of(block)));
  const std::array<int, 3> first_node = in_stencil.first_node(Shape::stencil);
  const std::array<FoldedAxis<count>, 3> axes = {fold<count>(grid, 0, block[0], first_node[0], field),
                                                 fold<count>(grid, 1, block[1], first_node[1], field),
                                                 fold<count>(grid, 2, block[2], first_node[2], field)};
  struct Target {
    std::uint32_t contact_slot;
    std::uint8_t node, i, j, k;
  };
  std::array<Target, count * count * count> targets;
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<std::size_t>(axes[0].node[i] + 1);
    for (std::size_t j = 0; j < count; ++j) {
      const auto y = static_cast<std::size_t>(axes[1].node[j] + 1);
      for (std::size_t k = 0; k < count; ++k) {
        const auto z = static_cast<std::size_t>(axes[2].node[k] + 1);
        const std::int32_t of = neighbours[static_cast<std::size_t>(
            grid::neighbour_index(map.block[x], map.block[y], map.block[z]))];
        if (of == BlockGrid::no_slot) continue;
        const std::int32_t number = grid.contact_number(static_cast<std::size_t>(of));
        if (number == BlockGrid::no_slot) continue;
        const int node = grid::node_index(map.node[x], map.node[y], map.node[z]);
        if ((matter[static_cast<std::size_t>(number)] >> node & 1U) == 0) continue;
        if ((grid.fields(static_cast<std::size_t>(of)) >> field & 1U) == 0) continue;
        targets[found++] = {static_cast<std::uint32_t>(number), static_cast<std::uint8_t>(node),
                            static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j),
                            static_cast<std::uint8_t>(k)};
      }
    }
  }
  if (found == 0) return;
  const transfer::Weights<count> w = transfer::weights_at<Shape>(points, p, in_stencil, geometry.cell_size);
  const auto f = at_point(p);
  for (std::size_t t = 0; t < found; ++t) {
    const std::size_t i = targets[t].i, j = targets[t].j, k = targets[t].k;
    const double weight = w.weight[i][0] * w.weight[j][1] * w.weight[k][2];
    if (!(weight > 0.0)) continue;
    const std::size_t number = targets[t].contact_slot;
    const std::uint64_t fields = grid.fields(grid.contact_slots()[number]);
    const Vector3 sign(axes[0].sign[i], axes[1].sign[j], axes[2].sign[k]);
    const Vector3 gradient(w.derivative[i][0] * w.weight[j][1] * w.weight[k][2],
                           w.weight[i][0] * w.derivative[j][1] * w.weight[k][2],
                           w.weight[i][0] * w.weight[j][1] * w.derivative[k][2]);
    const Vector3 distance(w.distance[i][0], w.distance[j][1], w.distance[k][2]);
    f(Place{.contact_slot = number,
            .fields = static_cast<std::size_t>(std::popcount(fields)),
            .field = static_cast<std::size_t>(std::popcount(fields & ((std::uint64_t{1} << field) - 1))),
            .node = targets[t].node,
            .weight = weight,
            .gradient = sign.cwiseProduct(gradient),
            .distance = -sign.cwiseProduct(distance),
            .off_plane = Vector3(axes[0].off_plane[i], axes[1].off_plane[j], axes[2].off_plane[k]),
            .sign = sign});
  }
}

/// The same with at_point(p) for all particles p; no two calls at a time for one node.
template <class Shape, class AtPoint>
void for_each_place(const Particles& particles, const BlockGrid& grid, const NodesThatMatter& matter,
                    AtPoint&& at_point) {
  grid.for_each_apart([&](std::size_t slot) {
    if (!grid.meets_contact(slot)) return;
    const bool reaches_some = std::ranges::any_of(grid.neighbours(slot), [&](std::int32_t near) {
      if (near == BlockGrid::no_slot) return false;
      const std::int32_t number = grid.contact_number(static_cast<std::size_t>(near));
      return number != BlockGrid::no_slot && matter[static_cast<std::size_t>(number)] != 0;
    });
    if (!reaches_some) return;
    grid.for_each_field(BlockGrid::Points::particles, slot,
                        [&](std::span<const std::uint32_t> members, unsigned field) {
                          for (const std::uint32_t p : members) {
                            for_each_place_of<Shape>(particles, p, field, grid.coordinate(slot),
                                                     grid.neighbours(slot), grid, matter, at_point);
                          }
                        });
  });
}

/// The same for points on surfaces of elements, which work with B-splines only.
template <class Shape, class AtPoint>
void for_each_place(const PlacedPoints& placed, const BlockGrid& grid, const NodesThatMatter& matter,
                    AtPoint&& at_point) {
  if constexpr (transfer::CarriesAffineField<Shape>) {
    for (const std::vector<std::uint32_t>& colour : placed.colours) {
      parallel::for_each_uneven(colour.size(), [&](std::size_t c) {
        const PlacedPoints::Block& block = placed.blocks[colour[c]];
        for (const std::uint32_t p : block.points) {
          for_each_place_of<Shape>(*placed.points, p, placed.points->field[p], block.coordinate, block.slots,
                                   grid, matter, at_point);
        }
      });
    }
  }
}

Lanes lanes(const Vector3& v, double last = 0.0) { return Lanes{v[0], v[1], v[2], last}; }
Vector3 vector(Lanes v) { return {v[0], v[1], v[2]}; }

Vector3 unit_or_zero(const Vector3& v) {
  const double norm = v.norm();
  return norm > 0.0 ? Vector3(v / norm) : Vector3::Zero();
}

/// Calls f(contact slot, number of fields, node) for the nodes of the contact slots that this rank owns.
template <class Function>
void for_each_owned_node(const BlockGrid& grid, Function&& f) {
  parallel::for_each(grid.owned_contact_slots(), [&](std::size_t c) {
    const auto fields = static_cast<std::size_t>(std::popcount(grid.fields(grid.contact_slots()[c])));
    for (std::size_t node = 0; node < nodes_per_block; ++node) f(c, fields, node);
  });
}

/// Calls f(a, b, pair) for all pairs of fields.
template <class Function>
void for_each_pair(std::size_t fields, Function&& f) {
  for (std::size_t a = 0; a < fields; ++a) {
    for (std::size_t b = a + 1; b < fields; ++b) f(a, b, Surfaces::pair_index(a, b, fields));
  }
}

/// Distance from the centre of a particle to its surface along unit vectors: of its box of the beginning (or
/// of its followed domain), scaled to its present volume.
class HalfThickness {
 public:
  HalfThickness(const Particles& particles, std::size_t p) : extent_(particles.extent[p].matrix()) {
    const double box = 8.0 * std::sqrt(std::max(extent_.determinant(), 0.0));
    const double volume = particles.volume[p] + particles.void_volume[p];
    scale_ = std::cbrt(box > 0.0 ? volume / box : volume);
    if (!(box > 0.0)) extent_ = 0.25 * Matrix3::Identity();
    largest_ = scale_ * std::sqrt(std::max(extent_.trace(), 0.0));
  }
  /// Not less than along any direction.
  [[nodiscard]] double largest() const { return largest_; }
  [[nodiscard]] double along(const Vector3& n) const {
    return scale_ * std::sqrt(std::max(n.dot(extent_ * n), 0.0));
  }

 private:
  Matrix3 extent_;
  double scale_, largest_;
};

/// Logistic regression of two sets of particles, class -1 and +1, on their positions about a node in cells
/// and a constant: the plane of greatest likelihood, with a small penalty on the steepness that a gap would
/// make infinite. Newton's method; the problem is convex.
namespace regression {

constexpr std::size_t lanes_per_node = 4;  // 10 numbers of the matrix, their number, 4 of the right-hand side
constexpr int iterations = 8;
constexpr double penalty = 1e-5;  // per particle, on the square of the plane's coefficients

using Vector4 = Eigen::Vector4d;
using Matrix4 = Eigen::Matrix4d;

/// Adds one particle to the equations.
void add(Lanes* equations, const Vector4& x, double side, const Vector4& plane) {
  const double share = 1.0 / (1.0 + std::exp(side * plane.dot(x)));  // of doubt about its side
  const double curvature = share * (1.0 - share);
  const double slope = share * side;
  const Lanes all = {x[0], x[1], x[2], x[3]};
  equations[0] += curvature * x[0] * all;
  equations[1] += curvature * x[1] * all;
  equations[2] += Lanes{curvature * x[2] * x[2], curvature * x[2] * x[3], curvature * x[3] * x[3], 1.0};
  equations[3] += slope * all;
}

Vector4 step(const Lanes* e, const Vector4& plane) {
  Matrix4 matrix;
  matrix << e[0][0], e[0][1], e[0][2], e[0][3], e[0][1], e[1][1], e[1][2], e[1][3], e[0][2], e[1][2], e[2][0],
      e[2][1], e[0][3], e[1][3], e[2][1], e[2][2];
  Vector4 slope(e[3][0], e[3][1], e[3][2], e[3][3]);
  const double weight = penalty * std::max(e[2][3], 1.0);
  slope -= weight * plane;
  matrix.diagonal().array() += weight;
  return matrix.ldlt().solve(slope);
}

}  // namespace regression

/// Nodes that two fields or more reach, if the grid holds what all ranks bring to them; else all.
NodesThatMatter nodes_of_several(const BlockGrid& grid, bool after_transfer) {
  const auto slots = grid.contact_slots();
  NodesThatMatter nodes(slots.size(), ~std::uint64_t{0});
  if (!after_transfer || grid.is_shared()) return nodes;
  parallel::for_each(slots.size(), [&](std::size_t c) {
    std::uint64_t one = 0, several = 0;
    grid::for_each_bit(grid.fields(slots[c]), [&](unsigned field) {
      const grid::Node* of_field = grid.nodes(slots[c], field);
      std::uint64_t reached = 0;
      for (std::size_t i = 0; i < nodes_per_block; ++i) {
        reached |= std::uint64_t{of_field[i].first[0] > 0.0} << i;
      }
      several |= one & reached;
      one |= reached;
    });
    nodes[c] = several;
  });
  return nodes;
}

/// Nodes with a normal between two fields.
NodesThatMatter nodes_with_normals(const BlockGrid& grid, const grid::ContactValues& normals,
                                   std::size_t candidates) {
  const auto slots = grid.contact_slots();
  NodesThatMatter nodes(slots.size(), 0);
  parallel::for_each(slots.size(), [&](std::size_t c) {
    const std::size_t per_pair = candidates * nodes_per_block;
    for (std::size_t i = normals.begin[c]; i < normals.begin[c + 1]; ++i) {
      if (vector(normals.values[i]).isZero(0.0)) continue;
      nodes[c] |= std::uint64_t{1} << ((i - normals.begin[c]) % per_pair / candidates);
    }
  });
  return nodes;
}

}  // namespace

Surfaces::Gap Surfaces::at(std::size_t contact_slot, std::size_t pair, std::size_t node) const {
  const std::size_t first = normal_.begin[contact_slot] + candidates_ * (pair * nodes_per_block + node);
  Gap best{.width = -std::numeric_limits<double>::infinity()};
  for (std::size_t i = first; i < first + candidates_; ++i) {
    const Vector3 normal = vector(normal_.values[i]);
    const double width = -extent_.values[i][0] - extent_.values[i][1];
    if (width > best.width && !normal.isZero(0.0)) best = {normal, width};
  }
  return best;
}

void Surfaces::find(Normal kind, transfer::ShapeFunction shape, const Particles& particles,
                    const SurfacePoints& elements, grid::BlockGrid& grid, double dt) {
  const PlacedPoints placed(elements, grid);
  const bool after_transfer = dt > 0.0;
  const NodesThatMatter several = nodes_of_several(grid, after_transfer);
  lay_out(gradient_, grid, broadcast(0.0), one_per_field);
  candidates_ = kind == Normal::separating ? 3 : 1;
  const auto per_pair = [&](std::size_t fields) { return candidates_ * one_per_pair(fields); };
  lay_out(normal_, grid, broadcast(0.0), per_pair);
  lay_out(extent_, grid, broadcast(-std::numeric_limits<double>::infinity()), per_pair);
  transfer::with_shape(shape, [&]<class Shape>(Shape) {
    if (kind == Normal::logistic_regression) {
      lay_out(plane_, grid, broadcast(0.0), one_per_pair);
      const double per_cell = 1.0 / grid.geometry().cell_size;
      for (int iteration = 0; iteration < regression::iterations; ++iteration) {
        lay_out(equations_, grid, broadcast(0.0),
                [](std::size_t fields) { return regression::lanes_per_node * one_per_pair(fields); });
        const auto add = [&](const Place& place) {
          // A node on a mirror plane has its normal in it: then only the place along the plane matters.
          const Vector3 cells = per_cell * place.distance.cwiseProduct(place.off_plane);
          place.for_each_pair([&](std::size_t pair, bool first) {
            const Lanes plane = plane_.values[place.in(plane_, pair)];
            regression::add(&equations_.values[place.in(equations_, pair, regression::lanes_per_node)],
                            {cells[0], cells[1], cells[2], 1.0}, first ? -1.0 : 1.0,
                            {plane[0], plane[1], plane[2], plane[3]});
          });
        };
        const auto at_point = [&](std::size_t) { return add; };
        for_each_place<Shape>(particles, grid, several, at_point);
        for_each_place<Shape>(placed, grid, several, at_point);
        grid.sum_to_owners(equations_);
        for_each_owned_node(grid, [&](std::size_t c, std::size_t fields, std::size_t node) {
          for_each_pair(fields, [&](std::size_t, std::size_t, std::size_t pair) {
            const std::size_t i = pair * nodes_per_block + node;
            Lanes& plane = plane_.values[plane_.begin[c] + i];
            const regression::Vector4 change =
                regression::step(&equations_.values[equations_.begin[c] + regression::lanes_per_node * i],
                                 {plane[0], plane[1], plane[2], plane[3]});
            plane += Lanes{change[0], change[1], change[2], change[3]};
          });
        });
        grid.borrow_from_owners(plane_);
      }
      for (std::size_t i = 0; i < normal_.values.size(); ++i) {
        normal_.values[i] = lanes(unit_or_zero(vector(plane_.values[i])));
      }
    } else {
      for_each_place<Shape>(particles, grid, several, [&](std::size_t p) {
        return [&, volume = particles.volume[p] + particles.void_volume[p]](const Place& place) {
          gradient_.values[place.in(gradient_, place.field)] +=
              lanes(volume * place.gradient.cwiseProduct(place.off_plane), volume * place.weight);
        };
      });
      const double cell_size = grid.geometry().cell_size;
      for_each_place<Shape>(placed, grid, several, [&](std::size_t p) {
        return [&, p](const Place& place) {  // (3.6)
          const Vector3 area = place.sign.cwiseProduct(elements.area[p]).cwiseProduct(place.off_plane);
          gradient_.values[place.in(gradient_, place.field)] +=
              place.weight * lanes(area, elements.size[p] * cell_size);
        };
      });
      grid.sum_to_owners(gradient_);
      const bool knows_motion = after_transfer && !grid.is_shared();
      for_each_owned_node(grid, [&](std::size_t c, std::size_t fields, std::size_t node) {
        const bool may_part = knows_motion && !near_planes(grid, grid.contact_slots()[c]);
        const auto at_node = [&](std::size_t field) {
          return gradient_.values[gradient_.begin[c] + field * nodes_per_block + node];
        };
        const auto reached = [&](std::size_t field) { return at_node(field)[3] > 0.0; };
        const auto outward = [&](std::size_t field) {  // the volume of a node grows as particles come near
          const Lanes of_field = at_node(field);
          const Vector3 gradient = vector(of_field);
          const bool inside = gradient.norm() * cell_size < least_slope * of_field[3];
          return inside ? Vector3::Zero().eval() : unit_or_zero(gradient);
        };
        for_each_pair(fields, [&](std::size_t a, std::size_t b, std::size_t pair) {
          if (!reached(a) || !reached(b)) return;
          Lanes* normal = &normal_.values[normal_.begin[c] + candidates_ * (pair * nodes_per_block + node)];
          const Vector3 of_a = outward(a), of_b = -outward(b);
          normal[0] = lanes(unit_or_zero(of_a + of_b));
          // On smooth faces all three are one.
          if (kind != Normal::collinear && of_a.dot(of_b) <= one_direction) {
            normal[1] = lanes(of_a);
            normal[2] = lanes(of_b);
          }
          if (!may_part) return;
          const std::span tried(normal, candidates_);
          if (parts(grid, grid.contact_slots()[c], node, a, b, tried, dt)) std::ranges::fill(tried, Lanes{});
        });
      });
      grid.borrow_from_owners(normal_);
    }
    const NodesThatMatter normals = nodes_with_normals(grid, normal_, candidates_);
    // Most points lie behind the outermost one by more than they are thick.
    const auto extend = [&](const Place& place, double thickest, auto&& half_thickness_along) {
      place.for_each_pair([&](std::size_t pair, bool first) {
        const std::size_t i = place.in(normal_, pair, candidates_);
        for (std::size_t candidate = i; candidate < i + candidates_; ++candidate) {
          const Vector3 normal = vector(normal_.values[candidate]);
          const double along = (first ? 1.0 : -1.0) * normal.dot(place.distance);
          Lanes& largest = extent_.values[candidate];
          const int lane = first ? 0 : 1;
          if (!(along + thickest > largest[lane]) || normal.isZero(0.0)) continue;
          const double extent = along + half_thickness_along(place.sign.cwiseProduct(normal));
          if (extent > largest[lane]) largest[lane] = extent;
        }
      });
    };
    for_each_place<Shape>(particles, grid, normals, [&](std::size_t p) {
      return [&, half = HalfThickness(particles, p)](const Place& place) {
        extend(place, half.largest(), [&](const Vector3& n) { return half.along(n); });
      };
    });
    for_each_place<Shape>(placed, grid, normals, [&](std::size_t) {
      return [&](const Place& place) { extend(place, 0.0, [](const Vector3&) { return 0.0; }); };
    });
  });
  grid.maximum_to_owners(extent_);
}

}  // namespace whipple::contact

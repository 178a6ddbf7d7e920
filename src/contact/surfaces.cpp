// SPDX-License-Identifier: BSD-3-Clause
#include "src/contact/surfaces.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "src/contact/half_thickness.hpp"
#include "src/contact/parting.hpp"
#include "src/contact/places.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/transfer/shape_function.hpp"

namespace whipple::contact {
namespace {

using grid::BlockGrid;
using grid::nodes_per_block;

/// Minimum relative change of a body's nodal volume per cell; below it the node is in the interior, and the direction
/// of the gradient is that of the particle pattern (3.1).
constexpr double least_slope = 0.02;
/// Cosine of the angle between two normals above which they count as equal.
constexpr double one_direction = 1.0 - 1e-6;

/// Allocates values of contact slots: `per_node(bodies)` lanes for each node of a slot with that number of bodies.
template <class PerNode>
void lay_out(grid::ContactValues& values, const BlockGrid& grid, Lanes initial, PerNode&& per_node) {
  values.begin.assign(1, 0);
  for (const std::uint32_t slot : grid.contact_slots()) {
    const std::size_t bodies = grid.wholes(slot).count();
    values.begin.push_back(values.begin.back() +
                           static_cast<std::uint32_t>(per_node(bodies) * nodes_per_block));
  }
  values.values.assign(values.begin.back(), initial);
}

std::size_t one_per_body(std::size_t bodies) { return bodies; }
std::size_t one_per_pair(std::size_t bodies) { return bodies * (bodies - 1) / 2; }

Lanes lanes(const Vector3& v, double last = 0.0) { return Lanes{v[0], v[1], v[2], last}; }
Vector3 vector(Lanes v) { return {v[0], v[1], v[2]}; }

Vector3 unit_or_zero(const Vector3& v) {
  const double norm = v.norm();
  return norm > 0.0 ? Vector3(v / norm) : Vector3::Zero();
}

/// Calls f(contact slot, number of bodies, node) for the nodes of the contact slots that this rank owns.
template <class Function>
void for_each_owned_node(const BlockGrid& grid, Function&& f) {
  parallel::for_each(grid.owned_contact_slots(), [&](std::size_t c) {
    const std::size_t bodies = grid.wholes(grid.contact_slots()[c]).count();
    for (std::size_t node = 0; bodies > 1 && node < nodes_per_block; ++node) f(c, bodies, node);
  });
}

/// Calls f(a, b, pair) for all pairs of bodies.
template <class Function>
void for_each_pair(std::size_t bodies, Function&& f) {
  for (std::size_t a = 0; a < bodies; ++a) {
    for (std::size_t b = a + 1; b < bodies; ++b) f(a, b, pair_index(a, b, bodies));
  }
}

constexpr std::size_t lanes_of_normals = 3, lanes_of_extents = 2;

/// Logistic regression of two sets of particles, class -1 and +1, on their positions relative to a node in cells and a
/// constant: the plane of maximum likelihood, with a small penalty on its steepness, which would be infinite across a
/// gap. Newton's method; the problem is convex.
namespace regression {

// Matrix (10 independent entries), number of particles, 4 entries of the right-hand side
constexpr std::size_t lanes_per_node = 4;
constexpr int iterations = 8;
constexpr double penalty = 1e-5;  // per particle, on the square of the plane's coefficients

using Vector4 = Eigen::Vector4d;
using Matrix4 = Eigen::Matrix4d;

/// Adds one particle to the equations of a Newton iteration.
void add(Lanes* equations, const Vector4& x, double side, const Vector4& plane) {
  const double share = 1.0 / (1.0 + std::exp(side * plane.dot(x)));  // likelihood of the wrong class
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

/// Finds the nodes that at least two bodies reach. If the contributions of all ranks are not available, returns all
/// nodes of slots with at least two bodies.
NodesThatMatter nodes_of_several(const BlockGrid& grid, bool after_transfer) {
  const auto slots = grid.contact_slots();
  NodesThatMatter nodes(slots.size(), 0);
  parallel::for_each(slots.size(), [&](std::size_t c) {
    const grid::FieldSet bodies = grid.wholes(slots[c]);
    if (bodies.count() < 2) return;
    if (!after_transfer || grid.is_shared()) {
      nodes[c] = ~std::uint64_t{0};
      return;
    }
    std::array<std::uint64_t, grid::maximum_fields> reached{};  // by each body
    grid.fields(slots[c]).for_each([&](unsigned field) {
      const grid::Node* of_field = grid.nodes(slots[c], field);
      for (std::size_t i = 0; i < nodes_per_block; ++i) {
        reached[grid.whole(field)] |= std::uint64_t{of_field[i].sums.mass() > 0.0} << i;
      }
    });
    std::uint64_t one = 0, several = 0;
    bodies.for_each([&](unsigned body) {
      several |= one & reached[body];
      one |= reached[body];
    });
    nodes[c] = several;
  });
  return nodes;
}

/// Finds the nodes with a defined normal between two bodies.
NodesThatMatter nodes_with_normals(const BlockGrid& grid, const grid::ContactValues& normals) {
  const auto slots = grid.contact_slots();
  NodesThatMatter nodes(slots.size(), 0);
  parallel::for_each(slots.size(), [&](std::size_t c) {
    for (std::size_t i = normals.begin[c]; i < normals.begin[c + 1]; ++i) {
      if (!any(normals.values[i] != Lanes{})) continue;
      nodes[c] |= std::uint64_t{1} << ((i - normals.begin[c]) / lanes_of_normals % nodes_per_block);
    }
  });
  return nodes;
}

/// Stores unit vectors or zeros in the lanes; lanes with zero vectors repeat the first nonzero one.
void set_normals(Lanes* to, std::span<const Vector3> normals) {
  const auto first = std::ranges::find_if(normals, [](const Vector3& n) { return !n.isZero(0.0); });
  for (int component = 0; component < 3; ++component) {
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const bool given = lane < normals.size() && !normals[lane].isZero(0.0);
      const Vector3& normal = given || first == normals.end() ? normals[lane % normals.size()] : *first;
      to[component][static_cast<int>(lane)] = normal[component];
    }
  }
}

}  // namespace

std::uint32_t Surfaces::mixed_particle(const grid::BlockGrid& grid) const {
  if (grid.mixed().empty() || grid.contact_slots().empty()) return BlockGrid::not_mixed;
  const NodesThatMatter nodes = nodes_with_normals(grid, normal_);
  const grid::Stencil stencil = grid.stencil();
  const grid::BlockShape block = grid.block_shape();
  const grid::ReachMap map = grid::reach_map(block.edge), map_z = grid::reach_map(block.edge_z);
  const auto matters = [&](std::size_t slot,
                           std::array<std::size_t, 3> place) {  // from the node before the block
    const std::int32_t owner = grid.neighbours(slot)[static_cast<std::size_t>(
        grid::neighbour_index(map.block[place[0]], map.block[place[1]], map_z.block[place[2]]))];
    if (owner == BlockGrid::no_slot) return false;
    const std::int32_t number = grid.contact_number(static_cast<std::size_t>(owner));
    if (number == BlockGrid::no_slot) return false;
    const int node = block.node(map.node[place[0]], map.node[place[1]], map_z.node[place[2]]);
    return (nodes[static_cast<std::size_t>(number)] >> node & 1U) != 0;
  };
  const auto count = static_cast<std::size_t>(stencil.count), along_z = stencil.planar ? 1 : count;
  const auto reaches = [&](std::size_t slot, std::uint32_t part) {
    const std::array<int, 3> node = grid.places(BlockGrid::Points::parts)[part].first_node(stencil);
    const auto first = [&](std::size_t a) { return static_cast<std::size_t>(node[a] + 1); };
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        for (std::size_t k = 0; k < along_z; ++k) {
          if (matters(slot, {first(0) + i, first(1) + j, first(2) + k})) return true;
        }
      }
    }
    return false;
  };
  for (std::size_t slot = 0; slot < grid.slots(); ++slot) {
    if (!grid.meets_contact(slot)) continue;
    for (const std::uint32_t part : grid.parts_in(slot)) {
      if (reaches(slot, part)) return grid.mixed_of_part(part).particle;
    }
  }
  return BlockGrid::not_mixed;
}

Surfaces::Gap Surfaces::at(std::size_t contact_slot, std::size_t pair, std::size_t node) const {
  const std::size_t place = pair * nodes_per_block + node;
  const Lanes* n = &normal_.values[normal_.begin[contact_slot] + lanes_of_normals * place];
  const Lanes* extents = &extent_.values[extent_.begin[contact_slot] + lanes_of_extents * place];
  const Lanes width = -extents[0] - extents[1];
  Gap widest{.width = -std::numeric_limits<double>::infinity()};
  for (int i = 0; i < 4; ++i) {
    const Vector3 normal(n[0][i], n[1][i], n[2][i]);
    if (width[i] > widest.width && !normal.isZero(0.0)) widest = {normal, width[i]};
  }
  return widest;
}

/// The material that reaches the nodes.
struct Surfaces::Sources {
  const Particles& particles;
  const SurfacePoints& elements;
  const PlacedPoints placed;      ///< of the elements
  const NodesThatMatter several;  ///< nodes that several bodies reach
};

template <class Shape>
void Surfaces::fit_planes(const Sources& sources, grid::BlockGrid& grid) {
  lay_out(plane_, grid, broadcast(0.0), one_per_pair);
  for (int iteration = 0; iteration < regression::iterations; ++iteration) {
    lay_out(equations_, grid, broadcast(0.0),
            [](std::size_t bodies) { return regression::lanes_per_node * one_per_pair(bodies); });
    const auto add = [&](const Place& place) {
      // The normal at a node on a mirror plane lies in the plane: only the position along the plane is relevant.
      const double per_cell = 1.0 / grid.cell_size(grid.contact_slots()[place.contact_slot]);
      const Vector3 cells = per_cell * place.distance.cwiseProduct(place.off_plane);
      place.for_each_pair([&](std::size_t pair, bool first) {
        const Lanes plane = plane_.values[place.in(plane_, pair)];
        regression::add(&equations_.values[place.in(equations_, pair, regression::lanes_per_node)],
                        {cells[0], cells[1], cells[2], 1.0}, first ? -1.0 : 1.0,
                        {plane[0], plane[1], plane[2], plane[3]});
      });
    };
    const auto at_point = [&](std::size_t) { return add; };
    for_each_place<Shape>(sources.particles, grid, sources.several, at_point);
    for_each_place<Shape>(sources.placed, grid, sources.several, at_point);
    grid.sum_to_owners(equations_);
    for_each_owned_node(grid, [&](std::size_t c, std::size_t bodies, std::size_t node) {
      for_each_pair(bodies, [&](std::size_t, std::size_t, std::size_t pair) {
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
  for (std::size_t i = 0; i < plane_.values.size(); ++i) {
    const Vector3 normal = unit_or_zero(vector(plane_.values[i]));
    set_normals(&normal_.values[lanes_of_normals * i], {&normal, 1});
  }
}

template <class Shape>
void Surfaces::sum_gradients(const Sources& sources, grid::BlockGrid& grid) {
  for_each_place<Shape>(sources.particles, grid, sources.several, [&](std::size_t p) {
    const double volume = sources.particles.volume[p] + sources.particles.void_volume[p];
    const double size = grid.geometry().size_in_section(volume, sources.particles.position[p]);
    return [&, size](const Place& place) {
      gradient_.values[place.in(gradient_, place.body)] +=
          lanes(size * place.gradient.cwiseProduct(place.off_plane), size * place.weight);
    };
  });
  for_each_place<Shape>(sources.placed, grid, sources.several, [&](std::size_t p) {
    return [&, p](const Place& place) {  // (3.6)
      const Vector3 area = place.sign.cwiseProduct(sources.elements.area[p]).cwiseProduct(place.off_plane);
      const double cell_size = grid.cell_size(grid.contact_slots()[place.contact_slot]);
      gradient_.values[place.in(gradient_, place.body)] +=
          place.weight * lanes(area, sources.elements.size[p] * cell_size);
    };
  });
  grid.sum_to_owners(gradient_);
}

void Surfaces::choose_normals(Normal kind, grid::BlockGrid& grid, double dt) {
  const bool knows_motion = dt > 0.0 && !grid.is_shared();
  for_each_owned_node(grid, [&](std::size_t c, std::size_t bodies, std::size_t node) {
    const double cell_size = grid.cell_size(grid.contact_slots()[c]);
    const bool may_part = knows_motion && !near_planes(grid, grid.contact_slots()[c]);
    const auto at_node = [&](std::size_t body) {
      return gradient_.values[gradient_.begin[c] + body * nodes_per_block + node];
    };
    const auto reached = [&](std::size_t body) { return at_node(body)[3] > 0.0; };
    // The nodal volume increases as particles approach the node
    const auto outward = [&](std::size_t body) {
      const Lanes of_body = at_node(body);
      const Vector3 gradient = vector(of_body);
      const bool inside = gradient.norm() * cell_size < least_slope * of_body[3];
      return inside ? Vector3::Zero().eval() : unit_or_zero(gradient);
    };
    for_each_pair(bodies, [&](std::size_t a, std::size_t b, std::size_t pair) {
      if (!reached(a) || !reached(b)) return;
      const Vector3 of_a = outward(a), of_b = -outward(b);
      // On smooth faces all three are equal.
      const bool one = kind == Normal::collinear || of_a.dot(of_b) > one_direction;
      const std::array<Vector3, 3> normals = {unit_or_zero(of_a + of_b), of_a, of_b};
      const std::span tried(normals.data(), one ? 1 : normals.size());
      if (may_part && parts(grid, grid.contact_slots()[c], node, a, b, tried, dt)) return;
      set_normals(&normal_.values[normal_.begin[c] + lanes_of_normals * (pair * nodes_per_block + node)],
                  tried);
    });
  });
  grid.borrow_from_owners(normal_);
}

template <class Shape>
void Surfaces::find_extents(const Sources& sources, grid::BlockGrid& grid) {
  const NodesThatMatter normals = nodes_with_normals(grid, normal_);
  // Most points are behind the outermost one by more than their thickness.
  const auto extend = [&](const Place& place, double thickest, auto&& half_thickness_along) {
    place.for_each_pair([&](std::size_t pair, bool first) {
      const Lanes* normal = &normal_.values[place.in(normal_, pair, lanes_of_normals)];
      const Normals n{normal[0], normal[1], normal[2]};
      const Vector3 outward = first ? place.distance : Vector3(-place.distance);
      const Lanes along = outward[0] * n.x + outward[1] * n.y + outward[2] * n.z;
      Lanes& largest = extent_.values[place.in(extent_, pair, lanes_of_extents) + (first ? 0 : 1)];
      if (!any(along + thickest > largest)) return;
      const Vector3& s = place.sign;
      largest = maximum(largest, along + half_thickness_along({s[0] * n.x, s[1] * n.y, s[2] * n.z}));
    });
  };
  for_each_place<Shape>(sources.particles, grid, normals, [&](std::size_t p) {
    return [&, half = HalfThickness(grid.geometry(), sources.particles, p)](const Place& place) {
      extend(place, half.largest(), [&](const Normals& n) { return half.along(n); });
    };
  });
  for_each_place<Shape>(sources.placed, grid, normals, [&](std::size_t) {
    return [&](const Place& place) { extend(place, 0.0, [](const Normals&) { return Lanes{}; }); };
  });
}

void Surfaces::find(Normal kind, transfer::ShapeFunction shape, const Particles& particles,
                    const SurfacePoints& elements, grid::BlockGrid& grid, double dt) {
  const Sources sources{particles, elements, PlacedPoints(elements, grid), nodes_of_several(grid, dt > 0.0)};
  lay_out(gradient_, grid, broadcast(0.0), one_per_body);
  lay_out(normal_, grid, broadcast(0.0),
          [](std::size_t bodies) { return lanes_of_normals * one_per_pair(bodies); });
  lay_out(extent_, grid, broadcast(-std::numeric_limits<double>::infinity()),
          [](std::size_t bodies) { return lanes_of_extents * one_per_pair(bodies); });
  transfer::with_shape(shape, [&]<class Shape>(Shape) {
    if (kind == Normal::logistic_regression) {
      fit_planes<Shape>(sources, grid);
    } else {
      sum_gradients<Shape>(sources, grid);
      choose_normals(kind, grid, dt);
    }
    find_extents<Shape>(sources, grid);
  });
  grid.maximum_to_owners(extent_);
}

}  // namespace whipple::contact

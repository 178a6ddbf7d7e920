// SPDX-License-Identifier: BSD-3-Clause
#include "src/contact/cracks.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/contact/half_thickness.hpp"
#include "src/contact/node_fields.hpp"
#include "src/contact/places.hpp"
#include "src/core/parallel/mpi.hpp"

namespace whipple::contact {
namespace {

using grid::BlockGrid;
using grid::nodes_per_block;

constexpr double least_gradient = 1e-3;  ///< minimum change of the damage per cell that defines a direction
constexpr double least_damage = 0.02;    ///< minimum damage of a node at a crack
/// Minimum of l_1 / (l_1 + l_2), the two largest eigenvalues of (3): the damage of a single particle is a peak, not a
/// ridge, and would separate intact material.
constexpr double least_anisotropy = 0.7;
constexpr unsigned no_sector = 255, undecided = 254;  // undecided: reaches damaged nodes

/// Returns the sector of a direction: one of eight about the z axis in two dimensions, one of the six faces and eight
/// corners of a cube in three.
unsigned sector_of(const Vector3& n, bool planar) {
  if (planar) {  // 0 to 7, 45 degrees wide, the first about the x axis; called for all particles near cracks
    constexpr double tangent = std::numbers::sqrt2 - 1.0;  // tan 22.5 degrees
    const double x = std::abs(n.x()), y = std::abs(n.y());
    if (y < tangent * x) return n.x() > 0.0 ? 0U : 4U;
    if (x < tangent * y) return n.y() > 0.0 ? 2U : 6U;
    return n.x() > 0.0 ? (n.y() > 0.0 ? 1U : 7U) : (n.y() > 0.0 ? 3U : 5U);
  }
  Eigen::Index axis = 0;
  const double to_face = n.cwiseAbs().maxCoeff(&axis);
  if (to_face > n.cwiseAbs().sum() / std::numbers::sqrt3) {
    return 2U * static_cast<unsigned>(axis) + (n[axis] > 0.0 ? 1U : 0U);
  }
  return 6U + (n.x() > 0.0 ? 1U : 0U) + (n.y() > 0.0 ? 2U : 0U) + (n.z() > 0.0 ? 4U : 0U);
}

/// Calls at_point(p) for the points of a body that reach relevant nodes, and the function that it returns for the place
/// of each of those nodes (`contact_slot` is the slot). No two concurrent calls for one node.
/// @param members  members(slot): indices of the points in the slot
/// @param counts   counts(p): whether the point is included
template <class Shape, class Points, class Members, class Counts, class AtPoint>
void for_each_place_of(unsigned body, std::span<const std::uint8_t> body_of, const Points& points,
                       Members&& members, const BlockGrid& grid, const std::vector<std::uint64_t>& matter,
                       Counts&& counts, AtPoint&& at_point) {
  grid.for_each_apart([&](std::size_t slot) {
    const auto matters = [&](std::int32_t near) {
      return near != BlockGrid::no_slot && matter[static_cast<std::size_t>(near)] != 0;
    };
    if (!std::ranges::any_of(grid.neighbours(slot), matters)) return;
    std::optional<Reach> reach;
    for (const std::uint32_t p : members(slot)) {
      if (body_of[p] != body || !counts(p)) continue;
      if (!reach) {
        reach.emplace(grid, grid.coordinate(slot), grid.neighbours(slot), body, [&](std::size_t near) {
          return SeenSlot{.nodes = matter[near], .contact_slot = static_cast<std::uint32_t>(near)};
        });
      }
      reach->for_each_place<Shape>(points, p, at_point);
    }
  });
}

/// Holds the eigenvector of the largest eigenvalue of a symmetric matrix, and its two largest eigenvalues.
struct Principal {
  Vector3 axis;
  double greatest, next;
};

/// Computes the principal direction of a matrix in the x-y plane.
Principal principal_in_plane(double xx, double yy, double xy) {
  const double mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy), radius = std::hypot(half, xy);
  const Vector3 axis = half >= 0.0 ? Vector3(half + radius, xy, 0.0) : Vector3(xy, radius - half, 0.0);
  return {axis.stableNormalized(), mean + radius, std::max(mean - radius, 0.0)};
}

Principal principal(const Lanes* sums) {
  Matrix3 t;
  t << sums[0][0], sums[0][3], sums[1][1], sums[0][3], sums[0][1], sums[1][0], sums[1][1], sums[1][0],
      sums[0][2];
  Eigen::SelfAdjointEigenSolver<Matrix3> solver;
  solver.computeDirect(t);
  return {solver.eigenvectors().col(2), solver.eigenvalues()[2], std::max(solver.eigenvalues()[1], 0.0)};
}

/// Returns the axis of the largest eigenvalue of the summed dyads of the directions (3); zero if they are not
/// anisotropic.
Vector3 axis_of(const Lanes* sums, bool planar) {
  const Principal found = planar ? principal_in_plane(sums[0][0], sums[0][1], sums[0][3]) : principal(sums);
  if (!(found.greatest > 0.0) || found.greatest < least_anisotropy * (found.greatest + found.next)) {
    return Vector3::Zero();
  }
  // The choice of side A must not depend on round-off: no axis or diagonal of the grid is normal to this vector.
  return found.axis.dot(Vector3(1.0, 0.7, 0.4)) < 0.0 ? Vector3(-found.axis) : found.axis;
}

constexpr std::size_t lanes_of_directions = 2, lanes_of_part = 2;

/// Decides whether the damage has a ridge at a node (docs/theory/cracks.md, section 1, (3) and (4)).
/// @param sums  summed dyads of the directions; then, for each part, its mass and direction sum and its position sum
/// @param tolerance  distance within round-off, m
/// @param bit   bit(part): bit of the field of the part
/// @returns axis and side B; a zero axis where there is no ridge
template <class Bit>
Cracks::Crack ridge(const Lanes* sums, std::size_t parts, bool planar, double tolerance, Bit&& bit) {
  const Vector3 axis = axis_of(sums, planar);
  if (axis.isZero(0.0)) return {axis, 0};
  const Lanes* const of_parts = sums + lanes_of_directions;
  const auto mass = [&](std::size_t k) { return of_parts[lanes_of_part * k][0]; };
  const auto facing = [&](std::size_t k) {
    const Lanes v = of_parts[lanes_of_part * k];
    return axis.dot(Vector3(v[1], v[2], v[3]));
  };
  const auto place = [&](std::size_t k) { return axis.dot(vector(of_parts[lanes_of_part * k + 1])); };
  double middle = 0.0, all = 0.0;
  for (std::size_t k = 0; k < parts; ++k) {
    middle += place(k);
    all += mass(k);
  }
  middle /= all;
  Cracks::Crack crack{axis, 0};
  double mass_a = 0.0, mass_b = 0.0, place_a = 0.0, place_b = 0.0;
  for (std::size_t k = 0; k < parts; ++k) {
    if (!(mass(k) > 0.0)) continue;
    // The first part contains the particles without a direction: those in the middle of the crack, or far from any
    // crack.
    const bool on_b = k == 0 ? place(k) - middle * mass(k) > tolerance * mass(k) : facing(k) < 0.0;
    if (on_b) crack.side_b |= bit(k);
    (on_b ? mass_b : mass_a) += mass(k);
    (on_b ? place_b : place_a) += place(k);
  }
  // In a valley, the middle of a fragment between two cracks, the order of the centroids is reversed.
  const bool parts_here = mass_a > 0.0 && mass_b > 0.0 && place_a * mass_b < place_b * mass_a;
  if (!parts_here) crack.axis.setZero();
  return crack;
}

}  // namespace

grid::FieldSet SectorFields::parts(unsigned body) const {
  grid::FieldSet all = grid::FieldSet::of(body);
  for (std::size_t n = 0; n < cracked_.size(); ++n) {
    for (unsigned s = 0; cracked_[n] == body && s < sectors_; ++s) all.insert(field(n, s));
  }
  return all;
}

std::array<std::uint8_t, grid::maximum_fields> SectorFields::wholes() const {
  std::array<std::uint8_t, grid::maximum_fields> whole{};
  for (unsigned f = 0; f < whole.size(); ++f) whole[f] = static_cast<std::uint8_t>(f);
  for (const std::uint8_t body : cracked_) {
    parts(body).for_each([&](unsigned part) { whole[part] = body; });
  }
  return whole;
}

void Cracks::Values::lay_out(const Nodes& nodes, std::size_t lanes_per_node, Lanes initial) {
  lanes = lanes_per_node;
  of.begin.assign(1, 0);
  for (const std::uint64_t mask : nodes) {
    of.begin.push_back(of.begin.back() +
                       static_cast<std::uint32_t>(lanes * static_cast<std::size_t>(std::popcount(mask))));
  }
  of.values.assign(of.begin.back(), initial);
}

std::optional<Cracks::Crack> Cracks::at(unsigned body, std::size_t slot, std::size_t node) const {
  for (std::size_t n = 0; n < of_body_.size(); ++n) {
    const OfBody& found = of_body_[n];
    if (fields_.cracked()[n] != body || found.nodes.empty()) continue;
    if ((found.nodes[slot] >> node & 1U) == 0) return std::nullopt;
    const Lanes* lanes = found.cracks.at(found.laid_out, slot, node);
    const Lanes extents = *found.extents.at(found.laid_out, slot, node);
    return Crack{vector(lanes[0]), std::bit_cast<std::uint64_t>(double{lanes[0][3]}),
                 -extents[0] - extents[1]};
  }
  return std::nullopt;
}

void Cracks::find(transfer::ShapeFunction shape, const Particles& particles, const ElementNodes& nodes,
                  BlockGrid& grid, std::vector<std::uint8_t>& field) {
  const std::vector<std::uint8_t> body_of = field;
  std::array<double, grid::maximum_fields> failed{};  // per body: 1 if any particle has failed
  for (std::size_t p = 0; p < particles.size(); ++p) {
    if (particles.failed[p] != 0) failed[body_of[p]] = 1.0;
  }
  parallel::maximum(grid.communicator(), failed);
  for (std::size_t n = 0; n < of_body_.size(); ++n) {
    of_body_[n].nodes.clear();
    if (failed[fields_.cracked()[n]] == 0.0) continue;
    transfer::with_shape(
        shape, [&]<class Shape>(Shape) { find_in<Shape>(n, particles, nodes, grid, body_of, field); });
  }
}

template <class Shape>
void Cracks::find_in(std::size_t number, const Particles& particles, const ElementNodes& nodes,
                     BlockGrid& grid, std::span<const std::uint8_t> body_of,
                     std::vector<std::uint8_t>& field) {
  const unsigned body = fields_.cracked()[number];
  const bool planar = grid.geometry().is_planar();
  const auto visit = [&](const Nodes& matter, auto&& counts, auto&& at_point) {
    for_each_place_of<Shape>(
        body, body_of, particles, [&](std::size_t slot) { return grid.particles_in(slot); }, grid, matter,
        counts, at_point);
  };
  const auto visit_elements = [&](const Nodes& matter, auto&& at_point) {
    if constexpr (transfer::CarriesAffineField<Shape>) {  // elements require this
      if (nodes.position.empty()) return;
      for_each_place_of<Shape>(
          body, nodes.body, nodes, [&](std::size_t slot) { return grid.guests_in(slot); }, grid, matter,
          [](std::uint32_t) { return true; }, at_point);
    }
  };
  const auto every = [](std::uint32_t) { return true; };
  const auto join = [&](Nodes& nodes) {
    if (grid.is_shared()) grid.join_bits_of_ranks(nodes);
  };
  const auto for_each_owned = [&](const Nodes& nodes, auto&& f) {
    parallel::for_each(grid.owned_slots(), [&](std::size_t slot) {
      grid::for_each_bit(nodes[slot], [&](unsigned node) { f(slot, node); });
    });
  };

  // (1) Damage of the nodes, only where it is not zero
  Nodes damaged(grid.slots(), 0);
  visit(
      Nodes(grid.slots(), ~std::uint64_t{0}), [&](std::uint32_t p) { return particles.failed[p] != 0; },
      [&](std::uint32_t) {
        return [&](const Place& place) {  // several threads may reach nodes of one slot
          std::atomic_ref(damaged[place.contact_slot])
              .fetch_or(std::uint64_t{1} << place.node, std::memory_order_relaxed);
        };
      });
  join(damaged);
  Values damage;
  damage.lay_out(damaged, 1);
  direction_.resize(particles.size());  // of particles that reach damaged nodes
  sector_.assign(particles.size(), static_cast<std::uint8_t>(no_sector));
  visit(damaged, every, [&](std::uint32_t p) {
    direction_[p].setZero();
    sector_[p] = static_cast<std::uint8_t>(undecided);
    const Lanes brought = particles.mass[p] * Lanes{1.0, particles.failed[p] != 0 ? 1.0 : 0.0, 0.0, 0.0};
    return [&, brought](const Place& place) {
      *damage.at(damaged, place.contact_slot, place.node) += place.weight * brought;
    };
  });
  visit_elements(damaged, [&](std::uint32_t a) {
    return [&, whole = nodes.mass[a] * Lanes{1.0, 0.0, 0.0, 0.0}](const Place& place) {
      *damage.at(damaged, place.contact_slot, place.node) += place.weight * whole;
    };
  });
  if (grid.is_shared()) grid.sum_to_owners(damage.of);
  Nodes candidates(grid.slots(), 0);
  for_each_owned(damaged, [&](std::size_t slot, unsigned node) {
    Lanes& value = *damage.at(damaged, slot, node);
    value[0] = value[1] / value[0];
    if (value[0] > least_damage) candidates[slot] |= std::uint64_t{1} << node;
  });
  if (grid.is_shared()) grid.borrow_from_owners(damage.of);
  join(candidates);

  // (2) Directions to the crack
  visit(damaged, every, [&](std::uint32_t p) {
    return [&, p](const Place& place) {
      direction_[p] +=
          (*damage.at(damaged, place.contact_slot, place.node))[0] * place.sign.cwiseProduct(place.gradient);
    };
  });
  const double cell_size = grid.geometry().cell_size;
  parallel::for_each(particles.size(), [&](std::size_t p) {
    if (sector_[p] != undecided) return;
    const double norm = direction_[p].norm();
    if (norm * cell_size > least_gradient) {
      direction_[p] /= norm;
      sector_[p] = static_cast<std::uint8_t>(sector_of(direction_[p], planar));
    } else {
      direction_[p].setZero();
      sector_[p] = static_cast<std::uint8_t>(no_sector);
    }
  });

  // (3), (4) Axes and sides
  const std::size_t parts = 1 + fields_.sectors();
  Values sums;
  sums.lay_out(candidates, lanes_of_directions + lanes_of_part * parts);
  visit(candidates, every, [&](std::uint32_t p) {
    const double mass = particles.mass[p];
    const std::size_t part = sector_[p] == no_sector ? 0 : 1U + sector_[p];
    return [&, p, mass, part](const Place& place) {
      // A crack is continuous with its image at a mirror plane: its axis lies in the plane.
      const Vector3 n = place.sign.cwiseProduct(direction_[p]).cwiseProduct(place.off_plane);
      const Vector3 x = place.distance.cwiseProduct(place.off_plane);
      const double m = place.weight * mass;
      Lanes* const sum = sums.at(candidates, place.contact_slot, place.node);
      sum[0] += m * Lanes{n[0] * n[0], n[1] * n[1], n[2] * n[2], n[0] * n[1]};
      sum[1] += m * Lanes{n[1] * n[2], n[2] * n[0], 0.0, 0.0};
      Lanes* const of_part = sum + lanes_of_directions + lanes_of_part * part;
      of_part[0] += m * Lanes{1.0, n[0], n[1], n[2]};
      of_part[1] += m * Lanes{x[0], x[1], x[2], 0.0};
    };
  });
  // Element nodes have no direction and join the particles without one.
  visit_elements(candidates, [&](std::uint32_t a) {
    return [&, mass = nodes.mass[a]](const Place& place) {
      const Vector3 x = place.distance.cwiseProduct(place.off_plane);
      const double m = place.weight * mass;
      Lanes* const of_part = sums.at(candidates, place.contact_slot, place.node) + lanes_of_directions;
      of_part[0] += m * Lanes{1.0, 0.0, 0.0, 0.0};
      of_part[1] += m * Lanes{x[0], x[1], x[2], 0.0};
    };
  });
  if (grid.is_shared()) grid.sum_to_owners(sums.of);
  OfBody& found = of_body_[number];
  found.nodes.assign(grid.slots(), 0);
  found.laid_out = candidates;
  found.cracks.lay_out(candidates, 1);
  for_each_owned(candidates, [&](std::size_t slot, unsigned node) {
    const Crack crack = ridge(
        sums.at(candidates, slot, node), parts, planar, grid.geometry().tolerance(), [&](std::size_t part) {
          const unsigned of_part = part == 0 ? body : fields_.field(number, static_cast<unsigned>(part) - 1);
          return std::uint64_t{1} << of_part;
        });
    if (crack.axis.isZero(0.0)) return;
    found.nodes[slot] |= std::uint64_t{1} << node;
    *found.cracks.at(candidates, slot, node) =
        Lanes{crack.axis[0], crack.axis[1], crack.axis[2], std::bit_cast<double>(crack.side_b)};
  });
  join(found.nodes);
  if (grid.is_shared()) grid.borrow_from_owners(found.cracks.of);

  // Assign fields to the particles that reach a crack; the others keep the field of their body. (6): extents of the
  // faces.
  found.extents.lay_out(candidates, 1, broadcast(-std::numeric_limits<double>::infinity()));
  const auto extend = [&](const Place& place, unsigned of_point, double largest,
                          auto&& half_thickness_along) {
    const Lanes crack = *found.cracks.at(candidates, place.contact_slot, place.node);
    const Vector3 axis = vector(crack);
    const bool on_b = (std::bit_cast<std::uint64_t>(double{crack[3]}) >> of_point & 1U) != 0;
    const double along = (on_b ? -1.0 : 1.0) * axis.dot(place.distance);
    Lanes& extents = *found.extents.at(candidates, place.contact_slot, place.node);
    const int lane = on_b ? 1 : 0;
    if (along + largest <= extents[lane]) return;
    extents[lane] = std::max(extents[lane], along + half_thickness_along(place.sign.cwiseProduct(axis)));
  };
  visit(found.nodes, every, [&](std::uint32_t p) {
    if (sector_[p] != no_sector) field[p] = static_cast<std::uint8_t>(fields_.field(number, sector_[p]));
    return [&, half = HalfThickness(grid.geometry(), particles, p), of_point = field[p]](const Place& place) {
      extend(place, of_point, half.largest(), [&](const Vector3& n) { return half.along(n); });
    };
  });
  visit_elements(found.nodes, [&](std::uint32_t) {
    return [&](const Place& place) { extend(place, body, 0.0, [](const Vector3&) { return 0.0; }); };
  });
  if (grid.is_shared()) grid.maximum_to_owners(found.extents.of);
}

}  // namespace whipple::contact

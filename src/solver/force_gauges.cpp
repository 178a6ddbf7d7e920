// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/force_gauges.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace whipple::solver {
namespace {

constexpr unsigned no_field = grid::maximum_fields + 1;

/// Holds the faces that act on one component of the impulse at a node, with equal parts: none, one, or two equally near.
struct Acting {
  std::array<int, 2> face = {-1, -1};
  int distance = std::numeric_limits<int>::max();  // in cells

  void offer(int candidate, int at) {
    if (at > distance) return;
    face = {candidate, at == distance ? face[0] : -1};
    distance = at;
  }
  [[nodiscard]] double part(int of) const {
    if (of != face[0] && of != face[1]) return 0.0;
    return face[1] < 0 ? 1.0 : 0.5;
  }
};

/// Returns the faces that act on each component (3.6b): the nearest of those that hold it. A plane that slides along
/// takes the components along it only where no other face is near: they cancel between a node and its image.
std::array<Acting, 3> acting_at(const grid::BlockGrid& grid, const grid::Geometry& geometry,
                                const std::array<std::int32_t, 3>& place) {
  std::array<Acting, 3> normal, holding, any;
  for (const grid::MirrorPlane& plane : grid.mirror_planes()) {
    const auto axis = static_cast<std::size_t>(plane.axis);
    const std::int32_t at = plane.face % 2 == 0 ? 0 : geometry.cells[axis];
    const int distance = std::abs(place[axis] - at);
    if (distance > grid::BlockGrid::mirror_reach) continue;
    const bool holds = plane.kind == grid::Boundary::no_slip || plane.kind == grid::Boundary::friction;
    for (std::size_t c = 0; c < 3; ++c) {
      if (c == axis) {
        normal[c].offer(plane.face, distance);
      } else {
        (holds ? holding : any)[c].offer(plane.face, distance);
      }
    }
  }
  std::array<Acting, 3> acting;
  for (std::size_t c = 0; c < 3; ++c) {
    const bool is_normal = normal[c].face[0] >= 0 && normal[c].distance <= holding[c].distance;
    acting[c] = is_normal ? normal[c] : holding[c].face[0] >= 0 ? holding[c] : any[c];
  }
  return acting;
}

}  // namespace

ForceGauges::ForceGauges(const cases::Case& setup)
    : geometry_(setup.geometry), booked_(setup.force_gauges.size()) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const cases::ForceGauge& gauge : setup.force_gauges) {
    Gauge& own = gauges_.emplace_back();
    own.about = gauge.about;
    own.lower.fill(-infinity);
    own.upper.fill(infinity);
    if (gauge.face == cases::Face::none) {
      own.body = gauge.body_number(setup);
      own.field = setup.contact_fields.several() ? setup.contact_fields.of_body[own.body] : 0U;
      own.pieces = setup.contact_fields.parts(own.body) - 1;
      if (own.pieces > 0) own.first_piece = setup.contact_fields.pieces[own.body];
      if (!cases::has_inertia(setup.time.scheme)) own.field = no_field;  // known of driven bodies alone
      continue;
    }
    own.face = static_cast<int>(gauge.face);
    for (int a = 0; gauge.box && a < (geometry_.is_planar() ? 2 : 3); ++a) {
      if (a == own.face / 2) continue;
      const auto axis = static_cast<std::size_t>(a);
      // Nodes beyond the end of a face act for the material before it.
      if (gauge.box->lower[a] > geometry_.lower[a] + geometry_.tolerance())
        own.lower[axis] = gauge.box->lower[a];
      if (gauge.box->upper[a] < geometry_.upper(a) - geometry_.tolerance())
        own.upper[axis] = gauge.box->upper[a];
    }
  }
}

bool ForceGauges::any_of_body() const {
  return std::ranges::any_of(gauges_, [](const Gauge& gauge) { return gauge.face < 0; });
}

/// Returns the part of the cell around a node that is in the patch of a gauge (3.6c).
double ForceGauges::share(const Gauge& gauge, const Vector3& position, double cell_size) const {
  const double half = 0.5 * cell_size;
  double share = 1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double x = position[static_cast<Eigen::Index>(a)];
    const double from = std::max(x - half, gauge.lower[a]), to = std::min(x + half, gauge.upper[a]);
    share *= std::clamp((to - from) / (2.0 * half), 0.0, 1.0);
  }
  return share;
}

void ForceGauges::add(std::size_t gauge, const Vector3& position, const Vector3& impulse) {
  if (geometry_.is_axisymmetric()) {  // all around a ring only the component along the axis adds up
    booked_[gauge].impulse[0] += impulse[0];
  } else {
    booked_[gauge] += {impulse, (position - gauges_[gauge].about).cross(impulse)};
  }
}

void ForceGauges::book_node(const grid::BlockGrid& grid, std::uint32_t node, const Vector3& impulse) {
  if (impulse.isZero(0.0)) return;
  const grid::Geometry& geometry = grid.geometry_of_node(node);
  const Vector3 position = grid.position_of_node(node);
  const unsigned field = grid.whole_of_block(node / grid::nodes_per_block);
  const std::array<Acting, 3> acting = acting_at(grid, geometry, grid.place_of_node(node));
  for (std::size_t g = 0; g < gauges_.size(); ++g) {
    const Gauge& gauge = gauges_[g];
    const bool is_of_piece = field >= gauge.first_piece && field < gauge.first_piece + gauge.pieces;
    if (gauge.face < 0 && gauge.field != field && !is_of_piece) continue;
    Vector3 part = impulse;
    if (gauge.face >= 0) {
      const double of_patch = share(gauge, position, geometry.cell_size);
      for (int c = 0; c < 3; ++c) part[c] *= -of_patch * acting[static_cast<std::size_t>(c)].part(gauge.face);
    }
    add(g, position, part);
  }
}

void ForceGauges::book_held(std::size_t body, const Vector3& position, const Vector3& impulse) {
  book_point(body, static_cast<std::size_t>(cases::Face::none), position, impulse);
}

void ForceGauges::book_point(std::size_t body, std::size_t face, const Vector3& position,
                             const Vector3& impulse) {
  for (std::size_t g = 0; g < gauges_.size(); ++g) {
    const Gauge& gauge = gauges_[g];
    Vector3 part = impulse;
    if (gauge.face < 0) {
      if (gauge.body != body) continue;
    } else if (gauge.face == static_cast<int>(face)) {
      part *= -share(gauge, position, geometry_.cell_size);
    } else {
      continue;
    }
    add(g, position, part);
  }
}

}  // namespace whipple::solver

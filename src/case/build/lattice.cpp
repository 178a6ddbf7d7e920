// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/build/lattice.hpp"

#include "src/case/shapes/points.hpp"

namespace whipple::cases {
namespace {

bool inside_domain(const Case& setup, const Vector3& point) {
  for (int a = 0; a < 3; ++a) {
    if (point[a] < setup.geometry.lower[a] || point[a] > setup.geometry.upper(a)) return false;
  }
  return true;
}

/// Returns a whole cell of the lattice if its centre is inside the body.
std::optional<Site> whole_site(const Case& setup, const Body& body, const Lattice& lattice,
                               const Vector3& point) {
  if (!inside_domain(setup, point) || !setup.holds(body, point)) return std::nullopt;
  const Vector3 half = 0.5 * lattice.spacing;
  return Site{point, 1.0, {half[0] * half[0], half[1] * half[1], half[2] * half[2], 0, 0, 0}};
}

/// Computes volume fraction, centroid and second moments of the part of a cell inside the body, from a sublattice of 4
/// points per axis (12 in two dimensions).
std::optional<Site> partial_site(const Case& setup, const Body& body, const Lattice& lattice,
                                 const Vector3& point) {
  const int parts = setup.geometry.is_planar() ? 12 : 4, parts_z = setup.geometry.is_planar() ? 1 : parts;
  const double all = parts * parts * parts_z;
  if (!setup.may_hold(body, point, 0.5 * lattice.spacing.norm())) return std::nullopt;
  const Vector3 part(lattice.spacing[0] / parts, lattice.spacing[1] / parts, lattice.spacing[2] / parts_z);
  const Vector3 middle(0.5 * (parts - 1), 0.5 * (parts - 1), 0.5 * (parts_z - 1));
  double count = 0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();
  for (int i = 0; i < parts; ++i) {
    for (int j = 0; j < parts; ++j) {
      for (int k = 0; k < parts_z; ++k) {
        const Vector3 offset = part.cwiseProduct(Vector3(i, j, k) - middle);
        if (!inside_domain(setup, point + offset) || !setup.holds(body, point + offset)) continue;
        count += 1;
        first += offset;
        second += offset * offset.transpose();
      }
    }
  }
  if (count == 0) return std::nullopt;
  if (count == all) first.setZero();  // exactly the whole cell
  const Vector3 center = first / count;
  // A domain with half-edges r has the covariance sum r r^T / 3; each sublattice point contributes that of its box.
  Matrix3 extent = 3.0 * (second / count - center * center.transpose());
  extent += (0.5 * part).cwiseAbs2().asDiagonal();
  return Site{point + center, count / all, SymmetricTensor::from(extent)};
}

/// Returns whether the material of a body continues at a point adjacent to one inside it along an axis; beyond a mirror
/// plane or no-slip wall it does.
bool goes_on(const Case& setup, const Body& body, const Vector3& point, int axis) {
  const auto is_continuous = [&](int face) {
    const grid::Boundary kind = setup.geometry.boundary[static_cast<std::size_t>(face)];
    return kind == grid::Boundary::symmetry || kind == grid::Boundary::no_slip;
  };
  if (point[axis] < setup.geometry.lower[axis]) return is_continuous(2 * axis);
  if (point[axis] > setup.geometry.upper(axis)) return is_continuous(2 * axis + 1);
  return setup.holds(body, point);
}

}  // namespace

bool is_mirror(const Case& setup, int face) {
  return setup.geometry.boundary[static_cast<std::size_t>(face)] != grid::Boundary::outflow;
}

/// Returns whether all of a body is in regions of small cells.
static bool is_all_refined(const Case& setup, const Body& body) {
  const grid::Geometry& geometry = setup.geometry;
  if (!geometry.levels.are_two() || body.shape == nullptr) return true;
  const Shape::Bounds box = body.shape->bounds();
  Lanes around = 0.5 * geometry.in_cells(box.upper) - 0.5 * geometry.in_cells(box.lower);
  Lanes middle = geometry.in_cells(box.lower) + around;
  if (geometry.is_planar()) around[2] = middle[2] = 0.0;
  return !geometry.levels.may_need(grid::Level::coarse, middle, around);
}

double wanted_spacing(const Case& setup, const Body& body) {
  const double edge = is_all_refined(setup, body) ? setup.geometry.cell_size : 2.0 * setup.geometry.cell_size;
  return edge / std::cbrt(static_cast<double>(body.discretization.per_cell));
}

Shape::Bounds bounds_of(const Case& setup, const Body& body) {
  Shape::Bounds bounds = body.shape->bounds();
  if (setup.geometry.is_planar()) {
    const double half = 0.5 * wanted_spacing(setup, body);
    bounds.lower[2] = setup.geometry.lower[2] - half;
    bounds.upper[2] = setup.geometry.lower[2] + half;
  }
  return bounds;
}

Shape::Bounds common_part(const Shape::Bounds& a, const Shape::Bounds& b) {
  return {a.lower.cwiseMax(b.lower), a.upper.cwiseMin(b.upper)};
}

Shape::Bounds domain_of(const Case& setup) {
  const grid::Geometry& g = setup.geometry;
  Shape::Bounds domain{g.lower, Vector3(g.upper(0), g.upper(1), g.upper(2))};
  if (g.is_planar()) domain.lower[2] -= g.cell_size;
  return domain;
}

double lattice_size(const Case& setup, const Body& body) {
  if (const auto given = body.shape->particles(); !given.empty()) return static_cast<double>(given.size());
  const Shape::Bounds inside = common_part(bounds_of(setup, body), domain_of(setup));
  return ((inside.upper - inside.lower).cwiseMax(0.0) / wanted_spacing(setup, body)).prod();
}

Lattice lattice_of(const Case& setup, const Body& body) {
  const Shape::Bounds bounds = bounds_of(setup, body);
  const double wanted = wanted_spacing(setup, body);
  Lattice lattice;
  lattice.is_divided = !is_all_refined(setup, body);
  lattice.lower = bounds.lower;
  if (const auto given = body.shape->particles(); !given.empty()) {
    lattice.spacing = Vector3::Constant(mean_edge(given, setup.geometry.is_planar()));
    return lattice;
  }
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const double length = bounds.upper[axis] - bounds.lower[axis];
    const double middle = 0.5 * (bounds.upper[axis] + bounds.lower[axis]);
    const bool halved = (is_mirror(setup, static_cast<int>(2 * a)) &&
                         std::abs(middle - setup.geometry.lower[axis]) < 1e-9 * length) ||
                        (is_mirror(setup, static_cast<int>(2 * a + 1)) &&
                         std::abs(middle - setup.geometry.upper(static_cast<int>(a))) < 1e-9 * length);
    const double part = halved ? 0.5 * length : length;
    const long n = std::max(1L, std::lround(part / wanted)) * (halved ? 2 : 1);
    lattice.count[a] = n;
    lattice.halvings += halved ? 1 : 0;
    lattice.spacing[axis] = length / static_cast<double>(n);
  }
  return lattice;
}

Site site_of(const Case& setup, const Lattice& lattice, const GivenParticle& particle) {
  const double half = 0.5 * particle.edge, edges = particle.edge / lattice.spacing[0];
  const bool planar = setup.geometry.is_planar();
  Vector3 place = particle.position;
  if (planar) place[2] = setup.geometry.lower[2];
  return {place,
          planar ? edges * edges : edges * edges * edges,
          {half * half, half * half, half * half, 0, 0, 0}};
}

Vector3 place_of_particle(const Case& setup, const Body& body, const Lattice& lattice, const Site& site) {
  const bool is_given = !body.shape->particles().empty();
  if (is_given || body.discretization.lattice == Arrangement::regular || site.fraction < 1.0)
    return site.position;
  if (site.part < 1.0) {
    Site whole = site;
    whole.part = 1.0;
    return place_of_particle(setup, body, lattice.of_parts(setup.geometry.is_planar()), whole);
  }
  const bool planar = setup.geometry.is_planar();
  const int axes = planar ? 2 : 3;
  std::size_t part = 0;
  for (int a = 0; a < axes; ++a) {
    const long i = std::lround((site.position[a] - lattice.lower[a]) / lattice.spacing[a] - 0.5);
    part += (i % 2 != 0 ? std::size_t{1} : std::size_t{0}) << a;
  }
  Vector3 offset = (planar ? planar_layer_offset(part) : layer_offset(part)).cwiseProduct(lattice.spacing);
  for (int a = 0; a < axes; ++a) {
    Vector3 step = Vector3::Zero();
    step[a] = lattice.spacing[a];
    if (!goes_on(setup, body, site.position - step, a) || !goes_on(setup, body, site.position + step, a)) {
      offset[a] = 0.0;
    }
  }
  return site.position + offset;
}

std::optional<Site> site_at(const Case& setup, const Body& body, const Lattice& lattice,
                            const Vector3& point) {
  return body.discretization.partial_volumes ? partial_site(setup, body, lattice, point)
                                             : whole_site(setup, body, lattice, point);
}

}  // namespace whipple::cases

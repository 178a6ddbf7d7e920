// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "src/case/case.hpp"

/// Lattice on which the particles of a body are initially placed, and the lattice sites that the body fills.
namespace whipple::cases {

/// Describes a lattice of points at the centres of equal cells that divide the bounding box of a body.
struct Lattice {
  Vector3 lower;
  Vector3 spacing;
  std::array<long, 3> count{};
  int halvings = 0;         ///< number of mirror planes through the middle of the body
  bool is_divided = false;  ///< cells in regions of refinement are four in a plane, eight in space

  /// Returns the lattice of these parts.
  [[nodiscard]] Lattice of_parts(bool planar) const {
    Lattice parts = *this;
    parts.is_divided = false;
    for (std::size_t a = 0; a < (planar ? 2U : 3U); ++a) {
      parts.spacing[static_cast<Eigen::Index>(a)] *= 0.5;
      parts.count[a] *= 2;
    }
    return parts;
  }

  [[nodiscard]] Vector3 point(long i, long j, long k) const {
    return lower +
           Vector3(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5, static_cast<double>(k) + 0.5)
               .cwiseProduct(spacing);
  }
};

/// Describes the part of a lattice cell occupied by a particle.
struct Site {
  Vector3 position;
  double fraction = 1.0;   ///< of the volume of the cell
  SymmetricTensor extent;  ///< defined as in Particles
  double part = 1.0;       ///< of a cell of the lattice that the cell is

  /// Returns the volume in cells of the lattice.
  [[nodiscard]] double volume() const { return fraction * part; }
};

/// Returns whether a face of the domain mirrors or stops material.
bool is_mirror(const Case& setup, int face);

/// Returns the edge (m) of the cube occupied by one particle at the requested number per cell; that in the largest cells
/// that the body lies in.
double wanted_spacing(const Case& setup, const Body& body);

/// Returns the bounding box of a body; in two dimensions that of its section, one particle thick.
Shape::Bounds bounds_of(const Case& setup, const Body& body);

/// Returns the intersection of two boxes; upper is below lower if it is empty.
Shape::Bounds common_part(const Shape::Bounds& a, const Shape::Bounds& b);

/// Returns the box of the domain; in two dimensions one cell deeper, so that the plane is inside.
Shape::Bounds domain_of(const Case& setup);

/// Estimates the number of lattice points of a body inside the domain before the lattice is made; it may exceed any
/// integer.
double lattice_size(const Case& setup, const Body& body);

/// Creates the lattice of a body. It divides the bounding box evenly, so that faces of boxes and ends of cylinders are
/// represented exactly; a body halved by a mirror plane gets an even number of cells, so that its image continues the
/// lattice.
Lattice lattice_of(const Case& setup, const Body& body);

/// Returns the site in a lattice cell: with `partial_volumes` the part of the cell inside the body, otherwise the whole
/// cell if its centre is inside; nothing outside of the body or the domain.
std::optional<Site> site_at(const Case& setup, const Body& body, const Lattice& lattice,
                            const Vector3& point);

/// Returns the position of the particle of a site: that of the site, or in a layered body offset from it, but not
/// across a face of the body, whose outermost layer remains flat.
Vector3 place_of_particle(const Case& setup, const Body& body, const Lattice& lattice, const Site& site);

/// Returns the particle that the shape of a body gives, as a site of its lattice.
Site site_of(const Case& setup, const Lattice& lattice, const GivenParticle& particle);

/// Returns whether f(site) is true for any given particle inside a box, up to the first match.
template <class Function>
bool any_given(const Case& setup, std::span<const GivenParticle> particles, const Lattice& lattice,
               const Shape::Bounds& box, Function&& f) {
  for (const GivenParticle& particle : particles) {
    const Site site = site_of(setup, lattice, particle);
    const bool is_near = (site.position.array() >= box.lower.array() - particle.edge).all() &&
                         (site.position.array() <= box.upper.array() + particle.edge).all();
    if (is_near && f(site)) return true;
  }
  return false;
}

/// Returns whether f(site) is true for any particle of the body inside the domain. Only sites in and near a box are
/// tested, up to the first match.
template <class Function>
bool any_site(const Case& setup, const Body& body, const Lattice& lattice, const Shape::Bounds& box,
              Function&& f) {
  const Shape::Bounds part = common_part(box, domain_of(setup));
  if (const auto given = body.shape->particles(); !given.empty()) {
    return any_given(setup, given, lattice, part, std::forward<Function>(f));
  }
  std::array<long, 3> first{}, end{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const auto cell = [&](double x, double margin) {
      const double at = std::floor((x - lattice.lower[axis]) / lattice.spacing[axis]) + margin;
      return static_cast<long>(std::clamp(at, 0.0, static_cast<double>(lattice.count[a])));
    };
    first[a] = cell(part.lower[axis], -1.0);
    end[a] = cell(part.upper[axis], 2.0);
  }
  const bool planar = setup.geometry.is_planar();
  const Lattice parts = lattice.of_parts(planar);
  const auto any_part = [&](long i, long j, long k) {
    for (int n = 0; n < 8; n += planar ? 2 : 1) {  // z last
      const Vector3 point = parts.point(2 * i + n / 4, 2 * j + n / 2 % 2, planar ? k : 2 * k + n % 2);
      std::optional<Site> site = site_at(setup, body, parts, point);
      if (!site) continue;
      site->part = planar ? 0.25 : 0.125;
      if (f(*site)) return true;
    }
    return false;
  };
  for (long i = first[0]; i < end[0]; ++i) {
    for (long j = first[1]; j < end[1]; ++j) {
      for (long k = first[2]; k < end[2]; ++k) {
        const Vector3 point = lattice.point(i, j, k);
        if (lattice.is_divided && setup.geometry.levels.is_refined(setup.geometry.in_cells(point))) {
          if (any_part(i, j, k)) return true;
          continue;
        }
        const std::optional<Site> site = site_at(setup, body, lattice, point);
        if (site && f(*site)) return true;
      }
    }
  }
  return false;
}

/// Calls f(site) for every particle of the body inside the domain.
template <class Function>
void for_each_site(const Case& setup, const Body& body, const Lattice& lattice, Function&& f) {
  any_site(setup, body, lattice, domain_of(setup), [&](const Site& site) {
    f(site);
    return false;
  });
}

}  // namespace whipple::cases

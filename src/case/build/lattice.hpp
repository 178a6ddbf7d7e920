// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "src/case/case.hpp"

/// The lattice on which the particles of a body are placed at the start, and the sites on it that the body fills.
namespace whipple::cases {

/// Holds the points at the centres of equal cells that divide the bounding box of a body.
struct Lattice {
  Vector3 lower;
  Vector3 spacing;
  std::array<long, 3> count{};
  int halvings = 0;  ///< mirror planes through the middle of the body

  [[nodiscard]] Vector3 point(long i, long j, long k) const {
    return lower +
           Vector3(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5, static_cast<double>(k) + 0.5)
               .cwiseProduct(spacing);
  }
};

/// Describes the part of a cell of the lattice that a particle takes.
struct Site {
  Vector3 position;
  double fraction = 1.0;   ///< of the volume of the cell
  SymmetricTensor extent;  ///< as of Particles
};

/// Returns whether a face of the domain mirrors or stops material.
bool is_mirror(const Case& setup, int face);

/// Returns the edge (m) of the cubes of one particle each that the number per cell asks for.
double wanted_spacing(const Case& setup, const Body& body);

/// Returns the box around a body; in two dimensions around its section, one particle thick.
Shape::Bounds bounds_of(const Case& setup, const Body& body);

/// Returns the part of space in both boxes; upper below lower where there is none.
Shape::Bounds common_part(const Shape::Bounds& a, const Shape::Bounds& b);

/// Returns the box of the domain; in two dimensions one cell deeper, so that the plane is inside.
Shape::Bounds domain_of(const Case& setup);

/// Returns the number of points of the lattice of a body inside the domain, before it is made: it may exceed any integer.
double lattice_size(const Case& setup, const Body& body);

/// Makes the lattice of a body. It divides the bounding box evenly, so that faces of boxes and ends of cylinders are met
/// exactly; a body that a mirror plane halves gets an even number, so that its image continues the lattice.
Lattice lattice_of(const Case& setup, const Body& body);

/// Returns the site in a cell of the lattice: with `partial_volumes` the part of the cell that lies in the body, else the
/// whole cell if its centre does; nothing where the body or the domain does not reach.
std::optional<Site> site_at(const Case& setup, const Body& body, const Lattice& lattice,
                            const Vector3& point);

/// Returns the place of the particle of a site: that of the site, or in a layered body beside it, but not across a
/// face of the body, whose outermost layer stays flat.
Vector3 place_of_particle(const Case& setup, const Body& body, const Lattice& lattice, const Site& site);

/// Returns whether f(site) holds for some particle of the body inside the domain. Only those in and near a box are tried,
/// up to the first one.
template <class Function>
bool any_site(const Case& setup, const Body& body, const Lattice& lattice, const Shape::Bounds& box,
              Function&& f) {
  const Shape::Bounds part = common_part(box, domain_of(setup));
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
  for (long i = first[0]; i < end[0]; ++i) {
    for (long j = first[1]; j < end[1]; ++j) {
      for (long k = first[2]; k < end[2]; ++k) {
        const std::optional<Site> site = site_at(setup, body, lattice, lattice.point(i, j, k));
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

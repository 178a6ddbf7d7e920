// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/case/case.hpp"

namespace whipple::cases {

ParameterTable<Faces> Faces::parameters() {
  const auto face = [](const char* name, grid::Boundary Faces::* member) {
    return choice(name, member,
                  "material leaves the domain and is counted | frictionless mirror plane | no-slip wall | "
                  "frictionless wall that transmits compression only | the same with Coulomb friction")
        .optional();
  };
  return {face("x_lower", &Faces::x_lower), face("x_upper", &Faces::x_upper),
          face("y_lower", &Faces::y_lower), face("y_upper", &Faces::y_upper),
          face("z_lower", &Faces::z_lower), face("z_upper", &Faces::z_upper)};
}

bool Faces::any(grid::Boundary kind) const { return std::ranges::count(in_order(), kind) > 0; }

Faces Faces::in_section(std::size_t first) const {
  const std::array<grid::Boundary, 6> f = in_order();
  const auto at = [&](std::size_t i) { return f[(2 * first + i) % 6]; };
  return {at(0), at(1), at(2), at(3), at(4), at(5)};
}

ParameterTable<Domain> Domain::parameters() {
  return {
      vector("lower", &Domain::lower, "m", range::any(), "lower corner of the domain"),
      vector("upper", &Domain::upper, "m", range::any(),
             "upper corner; moved outwards to whole cells at outflow faces"),
      real("cell_size", &Domain::cell_size, "m", range::positive(),
           "edge of the cells of the background grid; with regions of refinement that of the cells inside, "
           "and "
           "twice as much elsewhere"),
      real("friction", &Domain::friction, "", range::non_negative(),
           "Coulomb coefficient of the faces of kind friction")
          .optional("none"),
      choice("dimension", &Domain::dimension,
             "three dimensions | uniform along z, 1 m thick | x along the axis, y >= 0 the radius, masses of "
             "whole rings; in two dimensions bodies are defined by their section z = 0, and vectors may have "
             "two "
             "components")
          .optional(),
      choice(
          "axis", &Domain::axis,
          "in two dimensions: direction that becomes x, the axis of rings, for vectors of three components, "
          "faces and axes; the next one of x, y, z, x becomes y")
          .optional()};
}

std::span<const Section<Domain>> Domain::sections() {
  static const std::array all = {
      section<&Domain::boundary>("boundary", ", or boundary = { x_lower = \"symmetry\", ... }"),
      section<&Domain::refinement>("refinement", ", a region of cells of 'cell_size' among larger ones")};
  return all;
}

namespace {

/// Holds the number of the largest cells along an extent, and whether it is an integer up to round-off.
struct Count {
  double exact, nearest;
  [[nodiscard]] bool whole() const { return std::abs(exact - nearest) < 1e-6 * std::max(nearest, 1.0); }
  [[nodiscard]] bool possible() const { return exact > 0.0 && exact <= 1e6; }
};

Count cells_along(const Domain& domain, Eigen::Index axis) {
  if (domain.is_planar() && axis == 2) return {1.0, 1.0};
  const double exact = (domain.upper[axis] - domain.lower[axis]) / domain.coarse_cell_size();
  return {exact, std::round(exact)};
}

}  // namespace

grid::Geometry Domain::geometry() const {
  grid::Geometry g;
  if (!(cell_size > 0.0)) return g;
  g.lower = lower;
  g.cell_size = cell_size;
  g.boundary = boundary.in_order();
  g.dimension = dimension;
  if (std::isfinite(friction)) g.friction = friction;
  if (is_planar()) {
    g.lower[2] = 0.0;
    g.boundary[4] = g.boundary[5] = grid::Boundary::outflow;  // not reached
  }
  if (dimension == grid::Dimension::axisymmetric) g.boundary[2] = grid::Boundary::symmetry;  // the axis
  for (std::size_t a = 0; a < 3; ++a) {
    const Count count = cells_along(*this, static_cast<Eigen::Index>(a));
    if (!count.possible()) continue;
    const std::int32_t finest = refinement.empty() || (is_planar() && a == 2) ? 1 : 2;
    g.cells[a] = finest * static_cast<std::int32_t>(count.whole() ? count.nearest : std::ceil(count.exact));
  }
  return g;
}

void Domain::check(const Case& setup, const Faults& faults) const {
  if (!(cell_size > 0.0)) return;  // reported as out of range
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const Count count = cells_along(*this, axis);
    const grid::Boundary end = boundary.in_order()[2 * a + 1];
    if (!count.possible()) {
      faults.add("upper",
                 fmt::format("the domain has {} cells along {}; expected 1 to 1e6", count.exact, "xyz"[a]));
    } else if (!count.whole() && end != grid::Boundary::outflow) {
      faults.add("upper",
                 fmt::format("{}_upper is a {} face, so the domain must hold a whole number of cells "
                             "along {}: {} m holds {:.6g} cells of {} m",
                             "xyz"[a], word_of(end), "xyz"[a], upper[axis] - lower[axis], count.exact,
                             coarse_cell_size()));
    }
  }
  if (!is_planar() && axis != Axis::x) {
    faults.add("axis",
               "'axis' is that of a section: set 'dimension' to \"axisymmetric\" or \"plane_strain\" too");
  }
  if (is_planar()) {
    const auto faces = boundary.in_order();
    const auto counts = [](grid::Boundary face) {
      return face != grid::Boundary::outflow && face != grid::Boundary::symmetry;
    };
    if (counts(faces[4]) || counts(faces[5])) {
      faults.add("boundary",
                 "in two dimensions nothing reaches faces across z: leave 'z_lower' and 'z_upper' out");
    }
  }
  if (dimension == grid::Dimension::axisymmetric) {
    const grid::Boundary axis = boundary.y_lower;
    if (lower[1] != 0.0) {
      faults.add("lower",
                 fmt::format("y is the radius and the axis the lower face: 'lower' has y = {} m, expected 0",
                             lower[1]));
    }
    if (axis != grid::Boundary::outflow && axis != grid::Boundary::symmetry) {
      faults.add("boundary", "'y_lower' is the axis, a mirror plane: leave it out");
    }
  }
  if (boundary.any(grid::Boundary::friction) != std::isfinite(friction)) {
    faults.add("friction", std::isfinite(friction)
                               ? "'friction' is the coefficient of faces of kind \"friction\": there is none"
                               : "faces of kind \"friction\" need the coefficient 'domain.friction'");
  }
  if (std::ranges::any_of(boundary.in_order(), grid::lets_part) && setup.time.scheme == Scheme::usf) {
    faults.add(
        "boundary",
        "a separating wall, with or without friction, is found to be in contact by the forces on the grid, "
        "which scheme \"usf\" "
        "does not determine yet where it needs them: take \"symplectic\", \"musl\" or \"usl\"");
  }
}

}  // namespace whipple::cases

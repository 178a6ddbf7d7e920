// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/build/placement.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "src/case/build/bars.hpp"
#include "src/case/build/lattice.hpp"
#include "src/case/build/meshing.hpp"
#include "src/case/shapes/points.hpp"
#include "src/core/base/error.hpp"

namespace whipple::cases {
namespace {

/// Returns a question for bodies whose size a file and a unit determine; empty for others.
std::string question_of_unit(const Body& body) {
  bool is_from_file = false;
  body.shape->visit([&](const Shape& part) { is_from_file = is_from_file || part.source().has_value(); });
  return is_from_file ? "; is 'unit' of its file right?" : "";
}

/// Returns why the particles or elements of a body are too many to be created.
std::optional<std::string> too_many(const Case& setup, const Body& body) {
  constexpr double most_particles = 1e9;  // about 500 GB
  constexpr double most_elements = 2e7;   // about 10 GB: every rank creates the whole mesh
  constexpr double longest_edge = 1e12;   // beyond it round-off merges neighbours
  const bool elements = body.discretization.has_elements();
  const Vector3 edges =
      (bounds_of(setup, body).upper - bounds_of(setup, body).lower) /
      (elements ? body.discretization.size(setup.domain.cell_size) : wanted_spacing(setup, body));
  const double count = elements ? edges.prod() : lattice_size(setup, body);
  const double most = elements ? most_elements : most_particles;
  if (count <= most && edges.maxCoeff() <= longest_edge) return std::nullopt;
  if (!body.discretization.mesh.empty()) {
    return fmt::format("the mesh of body \"{}\" is {:.3g} m long, {:.2g} cells: is 'mesh_unit' right?",
                       body.name, (bounds_of(setup, body).upper - bounds_of(setup, body).lower).maxCoeff(),
                       edges.maxCoeff());
  }
  return fmt::format(
      "body \"{}\" takes a lattice of {:.2g} {}, {:.2g} along an edge; at most {:.0e} and {:.0e}: "
      "enlarge 'cell_size' or reduce 'per_cell'{}",
      body.name, count, elements ? "elements" : "particles", edges.maxCoeff(), most, longest_edge,
      question_of_unit(body));
}

/// Returns the volume of the particles of a body over that of the part of its shape inside the domain, minus 1; 0 if a
/// mirror plane does not cut the body in its middle, as that part is then unknown.
double excess_volume(const Case& setup, const Body& body) {
  if (setup.geometry.is_planar()) return 0.0;
  const Lattice lattice = lattice_of(setup, body);
  const Shape::Bounds bounds = body.shape->bounds(), domain = domain_of(setup);
  const double tolerance = 1e-9 * setup.geometry.cell_size;
  int cuts = 0;
  for (int a = 0; a < 3; ++a) {
    if (bounds.lower[a] < domain.lower[a] - tolerance || bounds.upper[a] > domain.upper[a] + tolerance) {
      ++cuts;
    }
  }
  if (cuts != lattice.halvings) return 0.0;
  double sites = 0.0;
  for_each_site(setup, body, lattice, [&](const Site& site) { sites += site.volume(); });
  return std::ldexp(sites * lattice.spacing.prod(), cuts) / body.shape->volume() - 1.0;
}

/// Returns a fault if a given particle lies beyond a mirror plane or wall, or reaches beyond the domain elsewhere.
std::optional<std::string> given_outside(const Case& setup, const Body& body) {
  const grid::Geometry& g = setup.geometry;
  const std::span<const GivenParticle> particles = body.shape->particles();
  const double tolerance = 1e-9 * g.cell_size;
  std::string first;
  std::size_t count = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    for (int face = 0; face < (g.is_planar() ? 4 : 6); ++face) {
      const int a = face / 2;
      const bool mirror = is_mirror(setup, face), below = face % 2 == 0;
      const double plane = below ? g.lower[a] : g.upper(a), reach = mirror ? 0.0 : 0.5 * particles[i].edge;
      const double beyond =
          below ? plane - (particles[i].position[a] - reach) : particles[i].position[a] + reach - plane;
      if (!(beyond > tolerance)) continue;
      if (count++ == 0) {
        first =
            mirror
                ? fmt::format(
                      "{}: lies at {} = {:.9g} m, beyond the mirror plane or wall at {:.9g} m: give only the "
                      "particles of the part that is computed",
                      body.shape->source_of(i), "xyz"[a], particles[i].position[a], plane)
                : fmt::format(
                      "{}: at {} = {:.9g} m, {:.4g} m wide, reaches beyond the end of the domain at {:.9g} "
                      "m: "
                      "is the unit of its file right?",
                      body.shape->source_of(i), "xyz"[a], particles[i].position[a], particles[i].edge, plane);
      }
      break;
    }
  }
  if (count == 0) return std::nullopt;
  return count == 1 ? first : fmt::format("{} ({} such particles)", first, count);
}

bool boxes_meet(const Shape::Bounds& a, const Shape::Bounds& b) {
  return (a.lower.array() < b.upper.array()).all() && (b.lower.array() < a.upper.array()).all();
}

/// Returns a fault if a particle of one of two bodies is inside the other; both directions are tested, as one body may
/// fit between the particles of the other. The middle of a part of a cell may lie outside of its own shape, where that
/// is hollow: there two bodies may share a cell without a common point.
std::optional<std::string> overlap(const Case& setup, const Body& body, const Body& former) {
  const Shape::Bounds bounds = bounds_of(setup, body), theirs = bounds_of(setup, former);
  if (!boxes_meet(bounds, theirs)) return std::nullopt;
  const Shape::Bounds both = common_part(bounds, theirs);
  Vector3 at;
  const auto lies_in = [&](const Body& other, const Body& own) {
    return [&](const Site& site) {
      at = site.position;
      return other.shape->contains(at) && (site.fraction >= 1.0 || own.shape->contains(at));
    };
  };
  if (!any_site(setup, body, lattice_of(setup, body), both, lies_in(former, body)) &&
      (former.discretization.is_bars() ||
       !any_site(setup, former, lattice_of(setup, former), both, lies_in(body, former)))) {
    return std::nullopt;
  }
  return fmt::format("body \"{}\" overlaps body \"{}\" at ({:.6g}, {:.6g}, {:.6g}) m", body.name, former.name,
                     at[0], at[1], at[2]);
}

}  // namespace

std::vector<std::uint8_t> faces_touched(const Case& setup) {
  const grid::Geometry& g = setup.geometry;
  const double near = 0.05 * g.cell_size;
  std::vector<std::uint8_t> faces(setup.bodies.size(), 0);
  for (std::size_t b = 0; b < faces.size(); ++b) {
    const Body& body = setup.bodies[b];
    if (body.discretization.is_bars()) continue;  // they share the field of the surrounding material
    const Shape::Bounds bounds = bounds_of(setup, body);
    const Lattice lattice = lattice_of(setup, body);
    for (int face = 0; face < 6; ++face) {
      const int a = face / 2;
      const double plane = face % 2 == 0 ? g.lower[a] : g.upper(a);
      if (!is_mirror(setup, face)) continue;
      if (face % 2 == 0 ? bounds.lower[a] > plane + near : bounds.upper[a] < plane - near) continue;
      // The box may be larger than the shape, and the lattice may exclude the part cut off by the plane.
      Shape::Bounds layer = domain_of(setup);
      const double depth = lattice.spacing[a] + near;
      (face % 2 == 0 ? layer.upper[a] : layer.lower[a]) = face % 2 == 0 ? plane + depth : plane - depth;
      const auto is_in_layer = [&](const Site& site) { return std::abs(site.position[a] - plane) <= depth; };
      if (any_site(setup, body, lattice, layer, is_in_layer))
        faces[b] |= static_cast<std::uint8_t>(1U << face);
    }
  }
  return faces;
}

double expected_memory(const Case& setup) {
  constexpr double bytes_per_particle = 500.0;  // in full blocks: docs/manual/performance.md
  double particles = 0.0;
  for (const Body& body : setup.bodies) {
    if (!body.discretization.is_bars()) particles += lattice_size(setup, body);
  }
  return bytes_per_particle * particles;
}

std::vector<PlacementFault> placement_faults(const Case& setup) {
  std::vector<PlacementFault> faults;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    if (setup.bodies[b].discretization.is_bars()) continue;
    if (const auto fault = too_many(setup, setup.bodies[b])) faults.push_back({b, *fault});
  }
  if (!faults.empty()) return faults;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const Body& body = setup.bodies[b];
    const Shape::Bounds bounds = bounds_of(setup, body);
    const double tolerance = 1e-9 * setup.geometry.cell_size;
    const bool is_given = !body.shape->particles().empty();
    if (is_given) {
      if (const auto fault = given_outside(setup, body)) faults.push_back({b, *fault});
    }
    for (int face = 0; face < (setup.geometry.is_planar() ? 4 : 6); ++face) {
      const int a = face / 2;
      const bool beyond = face % 2 == 0 ? bounds.lower[a] < setup.geometry.lower[a] - tolerance
                                        : bounds.upper[a] > setup.geometry.upper(a) + tolerance;
      if (beyond && !is_given && !is_mirror(setup, face)) {
        faults.push_back(
            {b, fmt::format("body \"{}\" reaches {} = {} m, outside of the domain, which goes from {} m "
                            "to {} m{}",
                            body.name, "xyz"[a], face % 2 == 0 ? bounds.lower[a] : bounds.upper[a],
                            setup.geometry.lower[a], setup.geometry.upper(a), question_of_unit(body))});
      }
    }
    if (body.discretization.is_bars()) {
      if (const auto fault = fault_of_bars(setup, body)) faults.push_back({b, *fault});
      continue;
    }
    if (body.discretization.has_elements()) {
      try {
        static_cast<void>(hexahedra_of(setup, body));
      } catch (const InputError& error) {
        faults.push_back({b, error.what()});
      }
    }
    const Lattice lattice = lattice_of(setup, body);
    const double widest =
        is_given ? largest_edge(body.shape->particles()) : double{lattice.spacing.maxCoeff()};
    if (setup.transfer.shape_function == transfer::ShapeFunction::gimp &&
        widest > (1.0 + 1e-9) * setup.geometry.cell_size) {
      faults.push_back({b, fmt::format("body \"{}\": its particles are {:.3g} cells wide, and "
                                       "shape_function = \"gimp\" takes particles of one cell at most: raise "
                                       "'per_cell' to 8, or take \"convected_gimp\" or a B-spline",
                                       body.name, widest / setup.geometry.cell_size)});
    }
    for (std::size_t other = 0; other < b; ++other) {
      if (const auto fault = overlap(setup, body, setup.bodies[other])) faults.push_back({b, *fault});
    }
    if (!any_site(setup, body, lattice, bounds, [](const Site&) { return true; })) {
      faults.push_back(
          {b, fmt::format("body \"{}\" holds no particle: it is outside of the domain or thinner than a "
                          "particle spacing",
                          body.name)});
    }
  }
  return faults;
}

std::vector<std::string> placement_warnings(const Case& setup) {
  std::vector<std::string> warnings;
  const double cell = setup.geometry.cell_size;
  for (const Body& body : setup.bodies) {
    if (body.discretization.is_bars() || body.discretization.has_elements()) continue;
    Eigen::Index axis = 0;
    const Shape::Bounds bounds = bounds_of(setup, body);
    const double thickness =
        (bounds.upper - bounds.lower).head(setup.geometry.is_planar() ? 2 : 3).minCoeff(&axis);
    if (thickness < (1.0 - 1e-9) * cell) {
      warnings.push_back(fmt::format(
          "body \"{}\" is thinner than a cell: {:.4g} mm along {}, cells of {:.4g} mm; the grid sees "
          "no wave that crosses it",
          body.name, 1e3 * thickness, "xyz"[axis], 1e3 * cell));
    }
    constexpr double tolerance = 0.01;
    if (const double excess = excess_volume(setup, body); std::abs(excess) > tolerance) {
      warnings.push_back(fmt::format(
          "body \"{}\": its particles have {:.2g} % {} volume and mass than its shape; {}", body.name,
          100.0 * std::abs(excess), excess > 0.0 ? "more" : "less",
          body.discretization.partial_volumes
              ? "smaller cells or a larger 'per_cell' meet it more closely"
              : "discretization.partial_volumes = true gives those at its surface the part that lies in it"));
    }
  }
  return warnings;
}

std::vector<Shape::Bounds> particle_boxes(const Case& setup, const Body& body, const Shape::Bounds& near) {
  std::vector<Shape::Bounds> boxes;
  if (too_many(setup, body)) return boxes;  // reported elsewhere as a fault
  Body whole = body;
  whole.discretization.partial_volumes = false;
  const Lattice lattice = lattice_of(setup, whole);
  const bool is_given = !body.shape->particles().empty();
  any_site(setup, whole, lattice, near, [&](const Site& site) {
    const Vector3 half =
        is_given ? Vector3::Constant(std::sqrt(site.extent.xx)) : Vector3(0.5 * lattice.spacing);
    boxes.push_back({site.position - half, site.position + half});
    return false;
  });
  return boxes;
}

}  // namespace whipple::cases

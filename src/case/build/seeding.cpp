// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/build/seeding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "src/case/build/bars.hpp"
#include "src/case/build/meshing.hpp"
#include "src/core/base/error.hpp"

namespace whipple::cases {
namespace {

/// Points at the centres of equal cells that divide the bounding box of a body.
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

bool is_mirror(const Case& setup, int face) {
  return setup.geometry.boundary[static_cast<std::size_t>(face)] != grid::Boundary::outflow;
}

/// Edge of the cubes of a particle each.
double wanted_spacing(const Case& setup, const Body& body) {
  return setup.geometry.cell_size / std::cbrt(static_cast<double>(body.discretization.per_cell));
}

/// Returns the box around a body; in two dimensions around its section, one particle thick.
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

/// Points of the lattice of a body inside the domain, before it is made: the number may be beyond any
/// integer.
double lattice_size(const Case& setup, const Body& body) {
  const Shape::Bounds inside = common_part(bounds_of(setup, body), domain_of(setup));
  return ((inside.upper - inside.lower).cwiseMax(0.0) / wanted_spacing(setup, body)).prod();
}

/// Why the particles or elements of a body are too many to be made.
std::optional<std::string> too_many(const Case& setup, const Body& body) {
  constexpr double most_particles = 1e9;  // some 500 GB
  constexpr double most_elements = 2e7;   // some 10 GB: every rank makes the whole mesh
  constexpr double longest_edge = 1e12;   // beyond it round-off joins neighbours
  const bool elements = body.discretization.has_elements();
  const Vector3 edges =
      (bounds_of(setup, body).upper - bounds_of(setup, body).lower) /
      (elements ? body.discretization.size(setup.domain.cell_size) : wanted_spacing(setup, body));
  const double count = elements ? edges.prod() : lattice_size(setup, body);
  const double most = elements ? most_elements : most_particles;
  if (count <= most && edges.maxCoeff() <= longest_edge) return std::nullopt;
  if (!body.discretization.mesh.empty()) {
    return fmt::format("the mesh of body \"{}\" is {:.3g} m long, {:.2g} cells: is 'mesh_unit' right?", body.name,
                       (bounds_of(setup, body).upper - bounds_of(setup, body).lower).maxCoeff(), edges.maxCoeff());
  }
  return fmt::format(
      "body \"{}\" takes a lattice of {:.2g} {}, {:.2g} along an edge; at most {:.0e} and {:.0e}: "
      "enlarge 'cell_size' or reduce 'per_cell'",
      body.name, count, elements ? "elements" : "particles", edges.maxCoeff(), most, longest_edge);
}

/// The lattice divides the bounding box evenly, so that faces of boxes and ends of cylinders are met exactly;
/// a body that a mirror plane halves gets an even number, so that its image continues the lattice.
Lattice lattice_of(const Case& setup, const Body& body) {
  const Shape::Bounds bounds = bounds_of(setup, body);
  const double wanted = wanted_spacing(setup, body);
  Lattice lattice;
  lattice.lower = bounds.lower;
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

bool inside_domain(const Case& setup, const Vector3& point) {
  for (int a = 0; a < 3; ++a) {
    if (point[a] < setup.geometry.lower[a] || point[a] > setup.geometry.upper(a)) return false;
  }
  return true;
}

/// Describes the part of a cell of the lattice that a particle takes.
struct Site {
  Vector3 position;
  double share = 1.0;      // of the cell's volume
  SymmetricTensor extent;  // as of Particles
};

/// A whole cell of the lattice: its centre decides whether it belongs to the body.
std::optional<Site> whole_site(const Case& setup, const Body& body, const Lattice& lattice,
                               const Vector3& point) {
  if (!inside_domain(setup, point) || !setup.holds(body, point)) return std::nullopt;
  const Vector3 half = 0.5 * lattice.spacing;
  return Site{point, 1.0, {half[0] * half[0], half[1] * half[1], half[2] * half[2], 0, 0, 0}};
}

/// The part of a cell that lies in the body, by the points of a lattice four times as fine, in two dimensions twelve
/// times: its volume, centroid and second moments.
std::optional<Site> partial_site(const Case& setup, const Body& body, const Lattice& lattice,
                                 const Vector3& point) {
  const int parts = setup.geometry.is_planar() ? 12 : 4, parts_z = setup.geometry.is_planar() ? 1 : parts;
  const double all = parts * parts * parts_z;
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
  // A domain with half-edges r has the covariance sum r r^T / 3; every part brings that of its own box.
  Matrix3 extent = 3.0 * (second / count - center * center.transpose());
  extent += (0.5 * part).cwiseAbs2().asDiagonal();
  return Site{point + center, count / all, SymmetricTensor::from(extent)};
}

/// Returns whether f(site) holds for some particle of the body inside the domain; asks those in and near a box only,
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
  const auto site_at = body.discretization.partial_volumes ? partial_site : whole_site;
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

/// The place of a ring: the centre of mass of a small part of it, as far from the axis as makes a uniform pressure
/// nearly balanced there: r + (mean square distance of the section from r) / r.
Vector3 centre_of_mass(const Site& site) {
  const double r = site.position[1];
  return {site.position[0], r + site.extent.yy / (3.0 * r), site.position[2]};
}

/// Which sites of a body become particles, and of how much volume. A particle of a few per cent of a cell is
/// squeezed without bound between heavy ones, which it cannot stop; sites with less than `least_share` are
/// left out, and the others at the surface get their volume in proportion, unless there is too little of
/// them.
struct Allotment {
  std::size_t particles = 0;
  double volume = 0.0;    // of the body, in cells of the lattice
  double least = 0.0;     // fraction of the smallest site that becomes a particle
  double enlarged = 1.0;  // factor of the fraction of a cut site

  [[nodiscard]] bool takes(const Site& site) const { return site.share >= least; }
  [[nodiscard]] double share(const Site& site) const {
    return site.share < 1.0 ? enlarged * site.share : site.share;
  }
};

Allotment allotment_of(const Case& setup, const Body& body, const Lattice& lattice) {
  constexpr double least_share = 0.125;
  std::size_t small_sites = 0, sites = 0;
  double small = 0.0, cut = 0.0, volume = 0.0;
  for_each_site(setup, body, lattice, [&](const Site& site) {
    const bool is_small = site.share < least_share;
    ++sites;
    small_sites += is_small ? 1 : 0;
    volume += site.share;
    if (site.share < 1.0) (is_small ? small : cut) += site.share;
  });
  if (small > 0.25 * cut) return {.particles = sites, .volume = volume};
  return {.particles = sites - small_sites,
          .volume = volume,
          .least = least_share,
          .enlarged = small > 0.0 ? 1.0 + small / cut : 1.0};
}

/// Volume of the particles of a body over that of the part of its shape inside the domain, less 1; 0 where a
/// mirror plane cuts the body elsewhere than in its middle, so that this part is not known.
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
  for_each_site(setup, body, lattice, [&](const Site& site) { sites += site.share; });
  return std::ldexp(sites * lattice.spacing.prod(), cuts) / body.shape->volume() - 1.0;
}

bool boxes_meet(const Shape::Bounds& a, const Shape::Bounds& b) {
  return (a.lower.array() < b.upper.array()).all() && (b.lower.array() < a.upper.array()).all();
}

/// A fault where a particle of one of two bodies lies in the other: the one may lie between the particles of
/// the other.
std::optional<std::string> overlap(const Case& setup, const Body& body, const Body& former) {
  const Shape::Bounds bounds = bounds_of(setup, body), theirs = bounds_of(setup, former);
  if (!boxes_meet(bounds, theirs)) return std::nullopt;
  const Shape::Bounds both = common_part(bounds, theirs);
  Vector3 at;
  const auto lies_in = [&](const Shape& shape) {
    return [&](const Site& site) {
      at = site.position;
      return shape.contains(site.position);
    };
  };
  if (!any_site(setup, body, lattice_of(setup, body), both, lies_in(*former.shape)) &&
      (former.discretization.is_bars() ||
       !any_site(setup, former, lattice_of(setup, former), both, lies_in(*body.shape)))) {
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
    if (body.discretization.is_bars()) continue;  // they share the field of the material around
    const Shape::Bounds bounds = bounds_of(setup, body);
    const Lattice lattice = lattice_of(setup, body);
    for (int face = 0; face < 6; ++face) {
      const int a = face / 2;
      const double plane = face % 2 == 0 ? g.lower[a] : g.upper(a);
      if (!is_mirror(setup, face)) continue;
      if (face % 2 == 0 ? bounds.lower[a] > plane + near : bounds.upper[a] < plane - near) continue;
      // The box may be larger than the shape, and the lattice may have left out what the plane cuts.
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
    for (int face = 0; face < (setup.geometry.is_planar() ? 4 : 6); ++face) {
      const int a = face / 2;
      const bool beyond = face % 2 == 0 ? bounds.lower[a] < setup.geometry.lower[a] - tolerance
                                        : bounds.upper[a] > setup.geometry.upper(a) + tolerance;
      if (beyond && !is_mirror(setup, face)) {
        faults.push_back(
            {b, fmt::format("body \"{}\" reaches {} = {} m, outside of the domain, which goes from {} m "
                            "to {} m",
                            body.name, "xyz"[a], face % 2 == 0 ? bounds.lower[a] : bounds.upper[a],
                            setup.geometry.lower[a], setup.geometry.upper(a))});
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
    if (setup.transfer.shape_function == transfer::ShapeFunction::gimp &&
        lattice.spacing.maxCoeff() > (1.0 + 1e-9) * setup.geometry.cell_size) {
      faults.push_back({b, fmt::format("body \"{}\": its particles are {:.3g} cells wide, and "
                                       "shape_function = \"gimp\" takes particles of one cell at most: raise "
                                       "'per_cell' to 8, or take \"convected_gimp\" or a B-spline",
                                       body.name, lattice.spacing.maxCoeff() / setup.geometry.cell_size)});
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
  if (too_many(setup, body)) return boxes;  // a fault that is reported elsewhere
  Body whole = body;
  whole.discretization.partial_volumes = false;
  const Lattice lattice = lattice_of(setup, whole);
  const Vector3 half = 0.5 * lattice.spacing;
  any_site(setup, whole, lattice, near, [&](const Site& site) {
    boxes.push_back({site.position - half, site.position + half});
    return false;
  });
  return boxes;
}

Seeding seed(const Case& setup, int rank, int ranks) {
  Seeding seeding;
  Particles& particles = seeding.particles;
  std::size_t first_id = 0;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const Body& body = setup.bodies[b];
    const Material& material = *setup.materials[b];
    if (body.discretization.is_bars()) {
      seeding.bodies.push_back({.first = particles.size()});
      continue;
    }
    if (body.discretization.has_elements()) {
      use_fields(material, particles);  // of those that its elements may become
      if (body.failure_scatter.given()) particles.failure_threshold_factor.resize(particles.size(), 1.0);
      seeding.bodies.push_back({.first = particles.size()});
      continue;
    }
    const Lattice lattice = lattice_of(setup, body);
    const Allotment allotment = allotment_of(setup, body, lattice);
    const auto share_begin = [&](int r) {
      return allotment.particles * static_cast<std::size_t>(r) / static_cast<std::size_t>(ranks);
    };
    const std::size_t begin = share_begin(rank), behind = share_begin(rank + 1);
    BodySummary summary{.first = particles.size(), .count = behind - begin};
    const std::size_t end = summary.first + summary.count;
    resize(particles, end);
    particles.affine_velocity.resize(end);
    particles.extent.resize(end);
    const eos::State state = body.initial.of(material);
    const double density = body_density(material, state);
    const bool planar = setup.geometry.is_planar();
    const double area = lattice.spacing[0] * lattice.spacing[1];
    const double mass = density * lattice.spacing.prod();  // of a whole site in three dimensions
    const Shape::Bounds bounds = bounds_of(setup, body);
    const Vector3 center = 0.5 * (bounds.lower + bounds.upper);
    const Vector3& w = body.angular_velocity;
    Matrix3 spin;
    spin << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
    std::size_t index = 0;
    for_each_site(setup, body, lattice, [&](const Site& site) {
      // The volume of a ring is its area times the way of its section's centroid (Pappus).
      const double mass_of_site = planar ? density * area * setup.geometry.depth(site.position) : mass;
      if (planar) summary.mass += mass_of_site * site.share;
      if (!allotment.takes(site)) return;
      const std::size_t number = index++;
      if (number < begin || number >= behind) return;
      const std::size_t p = summary.first + number - begin;
      particles.id[p] = first_id + number;
      particles.body[p] = static_cast<std::uint32_t>(b);
      particles.mass[p] = mass_of_site * allotment.share(site);
      particles.position[p] = setup.geometry.is_axisymmetric() ? centre_of_mass(site) : site.position;
      particles.velocity[p] = body.velocity + spin * (site.position - center);
      particles.affine_velocity[p] = spin;
      particles.extent[p] = site.extent;
      particles.generation[p] = 0;
    });
    initialise(material, particles, summary.first, end, state);
    if (body.failure_scatter.given()) particles.failure_threshold_factor.resize(end, 1.0);
    for (std::size_t p = summary.first; body.failure_scatter.given() && p < end; ++p) {
      particles.failure_threshold_factor[p] =
          body.failure_scatter.factor(particles.id[p], lattice.spacing.prod());
    }
    if (!planar) summary.mass = mass * allotment.volume;
    first_id += allotment.particles;
    summary.shape_mass = planar ? summary.mass : density * body.shape->volume();
    seeding.bodies.push_back(summary);
  }
  if (setup.has_elements()) {
    seeding.meshes = make_meshes(setup, first_id, seeding.wall_impulse);
    for (const fem::Mesh& mesh : seeding.meshes) {
      cases::BodySummary& summary = seeding.bodies[mesh.body];
      const Material& material = *setup.materials[mesh.body];
      summary.mass = fem::totals(mesh).mass;
      summary.shape_mass = body_density(material, setup.bodies[mesh.body].initial.of(material)) *
                           setup.bodies[mesh.body].shape->volume();
    }
  }
  std::uint64_t nodes = 0, elements = (first_id + 7) / 8;
  for (const fem::Mesh& mesh : seeding.meshes) {
    nodes += mesh.nodes.size();
    elements += mesh.elements.size();
  }
  seeding.bars = make_bars(setup, nodes, elements);
  for (const fem::Bars& bars : seeding.bars) {
    cases::BodySummary& summary = seeding.bodies[bars.body];
    summary.mass = std::accumulate(bars.nodes.mass.begin(), bars.nodes.mass.end(), 0.0);
    summary.shape_mass = bars.material.density * setup.bodies[bars.body].shape->volume();
  }
  if (setup.dissipation.keeps_losses()) use_stores(particles);
  return seeding;
}

}  // namespace whipple::cases

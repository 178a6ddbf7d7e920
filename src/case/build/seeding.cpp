// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/build/seeding.hpp"

#include <numeric>

#include "src/case/build/bars.hpp"
#include "src/case/build/lattice.hpp"
#include "src/case/build/lighting.hpp"
#include "src/case/build/lithostatic.hpp"
#include "src/case/build/meshing.hpp"

namespace whipple::cases {
namespace {

/// Returns the position of a ring: the centre of mass of a small sector of it, at the radius where a uniform pressure
/// is nearly balanced: r + (mean square distance of the section from r) / r.
Vector3 centre_of_mass(const Site& site) {
  const double r = site.position[1];
  return {site.position[0], r + site.extent.yy / (3.0 * r), site.position[2]};
}

/// Determines which sites of a body become particles, and their volumes. A particle of a few per cent of a cell is
/// compressed without bound between heavier ones, which it cannot stop; sites with less than `least_fraction` are
/// therefore excluded, and their volume is distributed in proportion over the other surface sites, unless these hold
/// too little.
struct Allotment {
  std::size_t particles = 0;
  double volume = 0.0;    // of the body, in cells of the lattice
  double least = 0.0;     // minimum fraction of a site that becomes a particle
  double enlarged = 1.0;  // factor of the fraction of a cut site
  bool is_given = false;  // by a file, with their volumes

  [[nodiscard]] bool takes(const Site& site) const { return site.fraction >= least; }
  [[nodiscard]] double volume_of(const Site& site) const {
    return site.fraction < 1.0 ? enlarged * site.volume() : site.volume();
  }
};

Allotment allotment_of(const Case& setup, const Body& body, const Lattice& lattice) {
  constexpr double least_fraction = 0.125;
  std::size_t small_sites = 0, sites = 0;
  double small = 0.0, cut = 0.0, volume = 0.0;
  for_each_site(setup, body, lattice, [&](const Site& site) {
    const bool is_small = site.fraction < least_fraction;
    ++sites;
    small_sites += is_small ? 1 : 0;
    volume += site.volume();
    if (site.fraction < 1.0) (is_small ? small : cut) += site.volume();
  });
  if (!body.shape->particles().empty()) return {.particles = sites, .volume = volume, .is_given = true};
  if (small > 0.25 * cut) return {.particles = sites, .volume = volume};
  return {.particles = sites - small_sites,
          .volume = volume,
          .least = least_fraction,
          .enlarged = small > 0.0 ? 1.0 + small / cut : 1.0};
}

}  // namespace

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
      use_fields(material, particles);  // of the particles to which its elements may be converted
      if (body.varies_failure()) particles.failure_threshold_factor.resize(particles.size(), 1.0);
      if (body.strength_scatter.given()) particles.strength_factor.resize(particles.size(), 1.0);
      seeding.bodies.push_back({.first = particles.size()});
      continue;
    }
    const Lattice lattice = lattice_of(setup, body);
    const Allotment allotment = allotment_of(setup, body, lattice);
    const auto part_begin = [&](int r) {
      return allotment.particles * static_cast<std::size_t>(r) / static_cast<std::size_t>(ranks);
    };
    const std::size_t begin = part_begin(rank), behind = part_begin(rank + 1);
    BodySummary summary{.first = particles.size(), .count = behind - begin};
    const std::size_t end = summary.first + summary.count;
    resize(particles, end);
    particles.affine_velocity.resize(end);
    particles.extent.resize(end);
    const eos::State state = body.initial.of(material);
    const double density = body_density(material, state);
    const bool planar = setup.geometry.is_planar();
    const double area = lattice.spacing[0] * lattice.spacing[1];
    const double volume = lattice.spacing.prod();  // of a whole site in three dimensions
    const double mass = density * volume;
    const Shape::Bounds bounds = bounds_of(setup, body);
    const Vector3 center = 0.5 * (bounds.lower + bounds.upper);
    const Vector3 &w = body.angular_velocity, &e = body.expansion_rate;
    Matrix3 gradient;  // of the velocity
    gradient << e[0], -w[2], w[1], w[2], e[1], -w[0], -w[1], w[0], e[2];
    std::vector<double> threshold_factor;
    std::size_t index = 0;
    for_each_site(setup, body, lattice, [&](const Site& site) {
      // The volume of a ring is its area times the path of the centroid of its section (Pappus).
      const double depth = setup.geometry.depth(site.position);
      const double mass_of_site = planar ? density * area * depth : mass;
      if (planar) summary.mass += mass_of_site * site.volume();
      if (!allotment.takes(site)) return;
      const std::size_t number = index++;
      if (number < begin || number >= behind) return;
      const std::size_t p = summary.first + number - begin;
      particles.id[p] = first_id + number;
      particles.body[p] = static_cast<std::uint32_t>(b);
      particles.mass[p] = mass_of_site * allotment.volume_of(site);
      const Vector3 place = place_of_particle(setup, body, lattice, site);
      particles.position[p] =
          setup.geometry.is_axisymmetric() && !allotment.is_given ? centre_of_mass(site) : place;
      particles.velocity[p] = body.velocity_at_start() + gradient * (place - center);
      particles.affine_velocity[p] = gradient;
      particles.extent[p] = site.extent;
      particles.generation[p] = 0;
      if (body.varies_failure()) {
        const double whole = planar ? area * depth : volume;
        threshold_factor.push_back(body.failure_factor(
            particles.id[p], allotment.is_given ? site.fraction * whole : site.part * whole,
            particles.position[p], setup.geometry));
      }
    });
    initialise(material, particles, summary.first, end, state);
    if (body.initial.lithostatic) set_lithostatic(setup, b, particles, summary.first, end);
    if (body.varies_failure()) {
      particles.failure_threshold_factor.resize(summary.first, 1.0);
      particles.failure_threshold_factor.insert(particles.failure_threshold_factor.end(),
                                                threshold_factor.begin(), threshold_factor.end());
    }
    if (body.strength_scatter.given()) {
      particles.strength_factor.resize(end, 1.0);
      for (std::size_t p = summary.first; p < end; ++p) {
        particles.strength_factor[p] = body.strength_scatter.factor(particles.id[p]);
      }
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
  set_lighting_times(setup, particles);
  if (setup.dissipation.keeps_losses()) use_stores(particles);
  return seeding;
}

}  // namespace whipple::cases

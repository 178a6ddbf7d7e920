// SPDX-License-Identifier: BSD-3-Clause
// Domains of the particles: deformation with the material, particle splitting, separated particles (docs/theory/mpm.md,
// section 2).
#include "src/solver/carriers/domains.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "src/core/base/vector_math.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/material/fluid.hpp"
#include "src/transfer/formulas.hpp"

namespace whipple::solver::domains {

namespace {

using cases::Divided;

Fluidity fluidity_of(const State& state, std::size_t body) { return fluidity(*state.setup.materials[body]); }

/// Returns an upper bound of the largest eigenvalue (Gershgorin).
double largest_at_most(const SymmetricTensor& e) {
  const double xy = std::abs(e.xy), yz = std::abs(e.yz), zx = std::abs(e.zx);
  return std::max({e.xx + xy + zx, e.yy + xy + yz, e.zz + zx + yz});
}

/// Computes the principal directions of a domain, in two dimensions of its section with the plane; eigenvalues (m^2)
/// ascending.
Eigen::SelfAdjointEigenSolver<Matrix3> principal_directions(const SymmetricTensor& extent, bool planar) {
  Matrix3 moments = extent.matrix();
  if (planar) {
    moments.row(2).setZero();
    moments.col(2).setZero();
  }
  return Eigen::SelfAdjointEigenSolver<Matrix3>(moments);
}

/// Returns the longest half-edge of a domain, m. Of directions equal to round-off, as those of a cube, that nearest to the
/// first axis is taken: round-off must not decide.
Vector3 longest_half_edge(const SymmetricTensor& extent, bool planar) {
  constexpr double equal = 1.0 - 1e-6;
  const auto principal = principal_directions(extent, planar);
  const auto& squares = principal.eigenvalues();
  Eigen::Index first = 2;
  while (first > 0 && squares[first - 1] >= equal * squares[2]) --first;
  const auto longest = principal.eigenvectors().rightCols(3 - first);
  Vector3 direction = longest.col(longest.cols() - 1);
  for (int a = 0; longest.cols() > 1 && a < 3; ++a) {
    const Vector3 along = longest * longest.row(a).transpose();  // the part of an axis in their plane
    if (along.norm() < 0.5) continue;
    direction = along.normalized();
    break;
  }
  return std::sqrt(squares[2]) * direction;
}

/// Returns whether a particle's material remains continuous when it is stretched, and may be split further.
bool may_be_divided(const Particles& particles, std::size_t p, const cases::Splitting& splitting,
                    Fluidity fluidity) {
  if (particles.generation[p] >= splitting.maximum_generations) return false;
  return is_continuous_fluid(fluidity, particles, p) ||
         (splitting.of == Divided::all && particles.failed[p] == failure::intact);
}

/// Returns whether both parts of a particle are inside the domain; excludes rings of radius 0.
bool fits(const grid::Geometry& geometry, const Vector3& position, const Vector3& half_edge) {
  for (int a = 0; a < (geometry.is_planar() ? 2 : 3); ++a) {
    const double reach = 0.5 * std::abs(half_edge[a]);
    if (!(position[a] - reach > geometry.lower[a] && position[a] + reach < geometry.upper(a))) return false;
  }
  return true;
}

/// Longest half-edges of the particles to split, in ascending order of the particles.
using Divisions = std::vector<std::pair<std::uint32_t, Vector3>>;

/// Adds the division of a particle along its longest direction, unless a part of it would leave the domain.
/// @param least  square of the half-edge (m^2) up to which it stays whole
void add_division(Divisions& divisions, const Particles& particles, std::size_t p,
                  const grid::Geometry& geometry, double least) {
  const Vector3 half_edge = longest_half_edge(particles.extent[p], geometry.is_planar());
  if (half_edge.squaredNorm() <= least) return;
  if (fits(geometry, particles.position[p], half_edge))
    divisions.emplace_back(static_cast<std::uint32_t>(p), half_edge);
}

/// Finds the particles in regions of small cells that are larger than those want them (docs/theory/levels.md, section 4):
/// they came from large cells.
Divisions find_entries(const State& state) {
  constexpr double too_large = 1.5;  // between one and two particles of a small cell
  const Particles& particles = state.particles;
  const grid::Geometry& geometry = state.setup.geometry;
  Divisions divisions;
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const double edge =
        geometry.cell_size / std::cbrt(static_cast<double>(state.setup.bodies[b].discretization.per_cell));
    const double most = too_large * edge * edge * (geometry.is_planar() ? 1.0 : edge);
    const std::size_t first = state.bodies[b].first;
    const std::vector<std::uint32_t> large = parallel::where(state.bodies[b].count, [&](std::size_t i) {
      const std::size_t p = first + i;
      const double volume = particles.mass[p] / state.initial_density[b];
      if (!geometry.is_planar() && volume <= most) return false;
      return geometry.size_in_section(volume, particles.position[p]) > most &&
             geometry.levels.is_refined(geometry.in_cells(particles.position[p]));
    });
    for (const std::uint32_t i : large) add_division(divisions, particles, first + i, geometry, 0.0);
  }
  return divisions;
}

Divisions find_divisions(const State& state) {
  const Particles& particles = state.particles;
  const cases::Splitting& splitting = state.setup.splitting;
  const grid::Geometry& geometry = state.setup.geometry;
  const auto limit_at = [&](std::size_t p) {
    const double half = 0.5 * splitting.length * state.cell_size_at(p);
    return half * half;
  };
  Divisions divisions;
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    if (!follow_deformation(state, b)) continue;
    const std::size_t first = state.bodies[b].first;
    const Fluidity fluid = fluidity_of(state, b);
    const std::vector<std::uint32_t> long_ones = parallel::where(state.bodies[b].count, [&](std::size_t i) {
      return largest_at_most(particles.extent[first + i]) > limit_at(first + i) &&
             may_be_divided(particles, first + i, splitting, fluid);
    });
    for (const std::uint32_t i : long_ones)
      add_division(divisions, particles, first + i, geometry, limit_at(first + i));
  }
  return divisions;
}

}  // namespace

bool may_divide(const cases::Case& setup) {
  return setup.splitting.length > 0.0 && setup.transfer.shape_function != transfer::ShapeFunction::gimp;
}

bool may_divide(const cases::Case& setup, std::size_t body) {
  return may_divide(setup) &&
         (setup.splitting.of == Divided::all || fluidity(*setup.materials[body]) != Fluidity::never);
}

bool follow_deformation(const State& state, std::size_t body) {
  using enum transfer::ShapeFunction;
  const transfer::ShapeFunction kind = state.setup.transfer.shape_function;
  return kind == convected_gimp || may_divide(state.setup, body) ||
         (kind != gimp && state.setup.geometry.levels.are_two());
}

bool are_needed(const State& state, bool may_meet_images) {
  bool any = state.setup.transfer.shape_function == transfer::ShapeFunction::gimp ||
             state.setup.contact_fields.several() || state.setup.geometry.levels.are_two() ||
             !state.setup.contact_fields.cracked.empty() || may_meet_images;
  for (std::size_t b = 0; b < state.setup.bodies.size(); ++b) any = any || follow_deformation(state, b);
  return any;
}

std::size_t deform(State& state, std::span<const std::uint32_t> particles,
                   std::span<const Matrix3> gradients) {
  const double dt = state.run.time_step;
  const bool counted = state.setup.transfer.shape_function == transfer::ShapeFunction::convected_gimp;
  std::size_t larger = 0;
  for (std::size_t k = 0; k < particles.size(); ++k) {
    const double* const l = gradients[k].data();
    SymmetricTensor& e = state.particles.extent[particles[k]];
    const Lanes x = Lanes{1.0, 0.0, 0.0, 0.0} + dt * load_vector(l),  // columns of I + dt L
        y = Lanes{0.0, 1.0, 0.0, 0.0} + dt * load_vector(l + 3),
                z = Lanes{0.0, 0.0, 1.0, 0.0} + dt * load_vector(l + 6);
    const Lanes of_x = e.xx * x + e.xy * y + e.zx * z,  // columns of (I + dt L) E
        of_y = e.xy * x + e.yy * y + e.yz * z, of_z = e.zx * x + e.yz * y + e.zz * z;
    const Lanes first = x[0] * of_x + y[0] * of_y + z[0] * of_z,
                second = x[1] * of_x + y[1] * of_y + z[1] * of_z,
                third = x[2] * of_x + y[2] * of_y + z[2] * of_z;
    e = {first[0], second[1], third[2], first[1], second[2], first[2]};
    if (!counted) continue;
    const double largest = transfer::half_sizes(e, state.cell_size_at(particles[k])).maxCoeff();
    larger += largest > transfer::ConvectedGimp::largest_half_size ? 1 : 0;
  }
  return larger;
}

double parted_square(const cases::Case& setup, double cell_size) {
  const double dx = cell_size, length = setup.splitting.length;
  return std::max(0.75, 0.25 * length * length) * dx * dx;
}

std::size_t hold_back_pressure(Particles& particles, std::span<const std::uint32_t> list, const State& state,
                               std::size_t body) {
  const Fluidity fluid = fluidity_of(state, body);
  if (!may_divide(state.setup) || fluid == Fluidity::never) return 0;
  std::size_t held = 0;
  for (const std::uint32_t p : list) {
    const double parted = parted_square(state.setup, state.cell_size_at(p));
    if (largest_at_most(particles.extent[p]) <= parted ||
        !has_thinned(particles, p, state.initial_density[body]) || !is_filling_fluid(fluid, particles, p)) {
      continue;
    }
    const auto principal = principal_directions(particles.extent[p], state.setup.geometry.is_planar());
    Matrix3 parting = Matrix3::Zero();  // I - S
    for (int a = 0; a < 3; ++a) {
      const Vector3 n = principal.eigenvectors().col(a);
      if (principal.eigenvalues()[a] > parted) parting += n * n.transpose();
    }
    if (parting.isZero(0.0)) continue;
    const SymmetricTensor back = SymmetricTensor::from(particles.pressure[p] * parting);
    SymmetricTensor& s = particles.deviatoric_stress[p];
    s = {s.xx + back.xx, s.yy + back.yy, s.zz + back.zz, s.xy + back.xy, s.yz + back.yz, s.zx + back.zx};
    ++held;
  }
  return held;
}

double divide(Particles& particles, std::size_t p, std::size_t other, const Vector3& half_edge,
              double inertia) {
  particles.mass[p] *= 0.5;
  particles.volume[p] *= 0.5;
  particles.void_volume[p] *= 0.5;
  ++particles.generation[p];
  particles.extent[p] =
      SymmetricTensor::from(particles.extent[p].matrix() - 0.75 * half_edge * half_edge.transpose());
  const Vector3 offset = 0.5 * half_edge;
  Vector3 difference = Vector3::Zero();
  double heat = 0.0;  // J/kg
  if (inertia > 0.0) {
    Matrix3& c = particles.affine_velocity[p];
    const double most = std::max(inertia, offset.squaredNorm());
    const Vector3 along = c * offset;
    const double before = 0.5 * inertia * c.squaredNorm();
    c -= along * offset.transpose() / most;
    difference = inertia / most * along;
    heat = before - 0.5 * inertia * c.squaredNorm() - 0.5 * difference.squaredNorm();
    (particles.unresolved_energy.empty() ? particles.specific_internal_energy
                                         : particles.unresolved_energy)[p] += heat;
  }
  for_each_field(particles, [&](const auto& field) {
    auto& values = field.of(particles);
    if (!values.empty()) values[other] = values[p];  // optional field that may not be in use
  });
  particles.position[p] -= offset;
  particles.velocity[p] -= difference;
  particles.position[other] += offset;
  particles.velocity[other] += difference;
  return 2.0 * particles.mass[p] * heat;
}

namespace {

/// Whether a division counts as one of the generations of a particle.
enum class Generation { next, same };

/// Gives a particle the affine field that fits the cells around it (docs/theory/levels.md, 8).
/// @param before, after  inertia per mass there and where the particle was, m^2
/// @returns its loss of kinetic energy, J, which it keeps as unresolved or internal energy
double fit_affine_field(Particles& particles, std::size_t p, double before, double after) {
  if (before == after) return 0.0;
  Matrix3& c = particles.affine_velocity[p];
  const transfer::formulas::FittedField fitted = transfer::formulas::fit_field(before, after);
  const double loss = fitted.loss * c.squaredNorm();
  c *= fitted.factor;
  (particles.unresolved_energy.empty() ? particles.specific_internal_energy
                                       : particles.unresolved_energy)[p] += loss;
  return particles.mass[p] * loss;
}

/// Splits particles in two. Collective.
/// @returns whether there were any, on any rank, and memory for them
bool perform(State& state, const Carriers& carriers, ParticleCarrier& of_particles,
             const Divisions& divisions, Generation generation) {
  if (!parallel::any(state.communicator, !divisions.empty())) return false;

  // New particles are numbered above all existing ones, rank by rank.
  std::uint64_t largest = 0;
  for (const Carrier* carrier : carriers) largest = std::max(largest, carrier->largest_particle_id());
  largest = static_cast<std::uint64_t>(parallel::maximum(state.communicator, static_cast<double>(largest)));
  std::vector<double> count(static_cast<std::size_t>(parallel::size(state.communicator)), 0.0);
  const auto rank = static_cast<std::size_t>(parallel::rank(state.communicator));
  count[rank] = static_cast<double>(divisions.size());
  parallel::sum(state.communicator, count);
  std::uint64_t next = largest + 1;
  for (std::size_t r = 0; r < rank; ++r) next += static_cast<std::uint64_t>(count[r]);
  std::size_t after = state.particle_count;
  for (const double n : count) after += static_cast<std::size_t>(n);
  if (after > static_cast<std::size_t>(state.setup.splitting.maximum_particles)) {
    state.booked.refused_divisions += static_cast<double>(divisions.size());
    return false;
  }
  state.particle_count = after;

  const AffineInertia inertia = state.inertia_of_particles();
  const std::size_t before = state.particles.size();
  resize(state.particles, before + divisions.size());
  for (std::size_t i = 0; i < divisions.size(); ++i) {
    const auto& [p, half_edge] = divisions[i];
    const std::uint8_t generations = state.particles.generation[p];
    const double whole = inertia.at(state.particles.position[p]);
    double loss = divide(state.particles, p, before + i, half_edge, whole);
    for (const std::size_t part : {std::size_t{p}, before + i}) {
      loss += fit_affine_field(state.particles, part, whole, inertia.at(state.particles.position[part]));
    }
    (state.keeps_losses() ? state.booked.unresolved_kept : state.booked.transfer_heat) += loss;
    state.particles.id[before + i] = next++;
    if (generation == Generation::same)
      state.particles.generation[p] = state.particles.generation[before + i] = generations;
  }
  of_particles.reallocated();
  return true;
}

}  // namespace

void split(State& state, const Carriers& carriers, ParticleCarrier& of_particles) {
  if (state.setup.geometry.levels.are_two()) {
    state.profile.time("split", [&] {
      while (perform(state, carriers, of_particles, find_entries(state), Generation::same)) {
      }
    });
  }
  if (!may_divide(state.setup)) return;
  state.profile.time(
      "split", [&] { perform(state, carriers, of_particles, find_divisions(state), Generation::next); });
}

}  // namespace whipple::solver::domains

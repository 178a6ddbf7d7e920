// SPDX-License-Identifier: BSD-3-Clause
// Domains of the particles: deformation with the material, particle splitting (docs/theory/mpm.md,
// section 2).
#include "src/solver/carriers/domains.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::solver::domains {

bool follow_deformation(const State& state) {
  return state.setup.transfer.shape_function == transfer::ShapeFunction::convected_gimp ||
         state.setup.splitting.length > 0.0;
}

bool are_needed(const State& state, bool may_meet_images) {
  return follow_deformation(state) || state.setup.transfer.shape_function == transfer::ShapeFunction::gimp ||
         state.setup.contact_fields.several() || may_meet_images;
}

std::size_t deform(State& state, std::span<const std::uint32_t> particles,
                   std::span<const Matrix3> gradients) {
  const double dt = state.run.time_step, dx = state.setup.domain.cell_size;
  const bool counted = state.setup.transfer.shape_function == transfer::ShapeFunction::convected_gimp;
  std::size_t larger = 0;
  for (std::size_t k = 0; k < particles.size(); ++k) {
    const Matrix3 step = Matrix3::Identity() + dt * gradients[k];
    SymmetricTensor& extent = state.particles.extent[particles[k]];
    extent = SymmetricTensor::from(step * extent.matrix() * step.transpose());
    if (!counted) continue;
    const double largest = transfer::half_sizes(extent, dx).maxCoeff();
    larger += largest > transfer::ConvectedGimp::largest_half_size ? 1 : 0;
  }
  return larger;
}

namespace {

/// Returns the longest half-edge of a particle's domain: the eigenvector of the largest eigenvalue of its extent, in
/// two dimensions of its section with the plane.
Vector3 longest_half_edge(const SymmetricTensor& extent, bool planar) {
  Matrix3 moments = extent.matrix();
  if (planar) {
    moments.row(2).setZero();
    moments.col(2).setZero();
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(moments);
  return std::sqrt(solver.eigenvalues()[2]) * solver.eigenvectors().col(2);
}

/// Divides a particle in two halves of its domain along a half-edge (2.6), (2.7). Its second half becomes
/// `other`, a copy of it. Mass, momentum, angular momentum and second moments of the mass stay exactly; what
/// the affine field loses becomes unresolved energy if there is a store of it, else internal energy.
/// @param inertia  of the affine field; 0 without one
/// @returns J, that loss
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
  double heat = 0.0;  // per mass
  if (inertia > 0.0) {
    Matrix3& c = particles.affine_velocity[p];
    difference = c * offset;
    const double before = 0.5 * inertia * c.squaredNorm();
    c -= difference * offset.transpose() / inertia;
    heat = before - 0.5 * inertia * c.squaredNorm() - 0.5 * difference.squaredNorm();
    (particles.unresolved_energy.empty() ? particles.specific_internal_energy
                                         : particles.unresolved_energy)[p] += heat;
  }
  for_each_field(particles, [&](const auto& field) {
    auto& values = field.of(particles);
    if (!values.empty()) values[other] = values[p];  // optional fields may not be in use
  });
  particles.position[p] -= offset;
  particles.velocity[p] -= difference;
  particles.position[other] += offset;
  particles.velocity[other] += difference;
  return 2.0 * particles.mass[p] * heat;
}

}  // namespace

void split(State& state, const Carriers& carriers, ParticleCarrier& of_particles) {
  if (state.setup.splitting.length <= 0.0) return;
  state.profile.time("split", [&] {
    const double limit =
        0.5 * state.setup.splitting.length * state.setup.domain.cell_size;  // half the length
    const grid::Geometry& geometry = state.setup.geometry;
    std::vector<std::pair<std::uint32_t, Vector3>> divided;
    for (std::uint32_t p = 0; p < state.particles.size(); ++p) {
      const SymmetricTensor& e = state.particles.extent[p];
      if (e.xx + e.yy + e.zz <= limit * limit) continue;  // the largest eigenvalue is smaller still
      if (state.particles.failed[p] != 0 ||
          state.particles.generation[p] >= state.setup.splitting.maximum_generations) {
        continue;
      }
      const Vector3 half_edge = longest_half_edge(e, geometry.is_planar());
      if (half_edge.squaredNorm() <= limit * limit) continue;
      bool inside = true;
      for (int a = 0; a < (geometry.is_planar() ? 2 : 3); ++a) {  // no ring of radius 0
        const double reach = 0.5 * std::abs(half_edge[a]);
        inside = inside && state.particles.position[p][a] - reach > geometry.lower[a] &&
                 state.particles.position[p][a] + reach < geometry.upper(a);
      }
      if (inside) divided.emplace_back(p, half_edge);
    }
    if (!parallel::any(state.communicator, !divided.empty())) return;

    // New particles take the numbers above all present ones, rank by rank.
    std::uint64_t largest = 0;
    for (const Carrier* carrier : carriers) largest = std::max(largest, carrier->largest_particle_id());
    largest = static_cast<std::uint64_t>(parallel::maximum(state.communicator, static_cast<double>(largest)));
    std::vector<double> count(static_cast<std::size_t>(parallel::size(state.communicator)), 0.0);
    const auto rank = static_cast<std::size_t>(parallel::rank(state.communicator));
    count[rank] = static_cast<double>(divided.size());
    parallel::sum(state.communicator, count);
    std::uint64_t next = largest + 1;
    for (std::size_t r = 0; r < rank; ++r) next += static_cast<std::uint64_t>(count[r]);
    for (const double n : count) state.particle_count += static_cast<std::size_t>(n);

    const std::size_t before = state.particles.size();
    resize(state.particles, before + divided.size());
    for (std::size_t i = 0; i < divided.size(); ++i) {
      (state.keeps_losses() ? state.booked.unresolved_kept : state.booked.transfer_heat) += divide(
          state.particles, divided[i].first, before + i, divided[i].second, state.particle_affine_inertia());
      state.particles.id[before + i] = next++;
    }
    of_particles.reallocated();
  });
}

}  // namespace whipple::solver::domains

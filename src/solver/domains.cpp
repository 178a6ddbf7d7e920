// SPDX-License-Identifier: BSD-3-Clause
// Domains of the particles: deformation with the material, division of stretched particles (docs/theory/mpm.md,
// section 2).
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::solver {

bool Simulation::follows_domains() const {
  return setup_.transfer.shape_function == transfer::ShapeFunction::convected_gimp || setup_.splitting.length > 0.0;
}

/// Returns whether anything asks for the domains of the particles.
bool Simulation::carries_extent() const {
  return follows_domains() || setup_.transfer.shape_function == transfer::ShapeFunction::gimp || setup_.contact_fields.several() ||
         may_meet_images();
}

/// E <- (I + dt L) E (I + dt L)^T (2.4). @returns how many domains are larger than the shape function takes
std::size_t Simulation::deform_domains(std::span<const std::uint32_t> particles,
                                       std::span<const Matrix3> gradients) {
  const double dt = state_.time_step, dx = setup_.domain.cell_size;
  const bool counted = setup_.transfer.shape_function == transfer::ShapeFunction::convected_gimp;
  std::size_t larger = 0;
  for (std::size_t k = 0; k < particles.size(); ++k) {
    const Matrix3 step = Matrix3::Identity() + dt * gradients[k];
    SymmetricTensor& extent = particles_.extent[particles[k]];
    extent = SymmetricTensor::from(step * extent.matrix() * step.transpose());
    if (!counted) continue;
    const double largest = transfer::half_sizes(extent, dx).maxCoeff();
    larger += largest > transfer::ConvectedGimp::largest_half_size ? 1 : 0;
  }
  return larger;
}

namespace {

/// Longest half-edge of a particle's domain: the eigenvector of the largest eigenvalue of its extent.
Vector3 longest_half_edge(const SymmetricTensor& extent) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(extent.matrix());
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
  for_each_field<Particles>([&](const auto& field) {
    auto& values = particles.*(field.values);
    if (!values.empty()) values[other] = values[p];  // optional fields may not be in use
  });
  particles.position[p] -= offset;
  particles.velocity[p] -= difference;
  particles.position[other] += offset;
  particles.velocity[other] += difference;
  return 2.0 * particles.mass[p] * heat;
}

}  // namespace

/// Intact particles longer than wanted (Ma, Zhang & Huang, CMES 54 (2009) 61: L = (1 + eps) V0^(1/3) > alpha
/// dx) are divided along their longest direction, those that leave the domain by it are not.
void Simulation::split_particles() {
  if (setup_.splitting.length <= 0.0) return;
  profile_.time("split", [&] {
    const double limit = 0.5 * setup_.splitting.length * setup_.domain.cell_size;  // half the length
    std::vector<std::pair<std::uint32_t, Vector3>> divided;
    for (std::uint32_t p = 0; p < particles_.size(); ++p) {
      const SymmetricTensor& e = particles_.extent[p];
      if (e.xx + e.yy + e.zz <= limit * limit) continue;  // the largest eigenvalue is smaller still
      if (particles_.failed[p] != 0 || particles_.generation[p] >= setup_.splitting.maximum_generations) {
        continue;
      }
      const Vector3 half_edge = longest_half_edge(e);
      if (half_edge.squaredNorm() <= limit * limit) continue;
      bool inside = true;
      for (int a = 0; a < 3; ++a) {
        const double reach = 0.5 * std::abs(half_edge[a]);
        inside = inside && particles_.position[p][a] - reach >= setup_.geometry.lower[a] &&
                 particles_.position[p][a] + reach <= setup_.geometry.upper(a);
      }
      if (inside) divided.emplace_back(p, half_edge);
    }
    if (!parallel::any(communicator_, !divided.empty())) return;

    // New particles take the numbers above all present ones, rank by rank.
    std::uint64_t largest = 0;
    for (const std::uint64_t id : particles_.id) largest = std::max(largest, id);
    for (const fem::Mesh& mesh : meshes_) {  // whose elements may become particles, eight each
      for (const std::uint64_t id : mesh.elements.id) largest = std::max(largest, 8 * id + 7);
    }
    largest = static_cast<std::uint64_t>(parallel::maximum(communicator_, static_cast<double>(largest)));
    std::vector<double> count(static_cast<std::size_t>(parallel::size(communicator_)), 0.0);
    const auto rank = static_cast<std::size_t>(parallel::rank(communicator_));
    count[rank] = static_cast<double>(divided.size());
    parallel::sum(communicator_, count);
    std::uint64_t next = largest + 1;
    for (std::size_t r = 0; r < rank; ++r) next += static_cast<std::uint64_t>(count[r]);
    for (const double n : count) particle_count_ += static_cast<std::size_t>(n);

    const std::size_t before = particles_.size();
    resize(particles_, before + divided.size());
    for (std::size_t i = 0; i < divided.size(); ++i) {
      (losses_.kept ? step_.unresolved_kept : step_.transfer_heat) +=
          divide(particles_, divided[i].first, before + i, divided[i].second, particle_affine_inertia());
      particles_.id[before + i] = next++;
    }
    particles_reallocated();
  });
}

}  // namespace whipple::solver

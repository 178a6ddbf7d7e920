// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "src/solver/carriers/particle_carrier.hpp"

/// Domains of the particles: deformation with the material, particle splitting, separated particles
/// (docs/theory/mpm.md, section 2).
namespace whipple::solver::domains {

/// Returns whether particles of a case may be split. Domains of the shape function `gimp` keep their size.
bool may_divide(const cases::Case& setup);
/// Returns whether particles of a body of the case may be split.
bool may_divide(const cases::Case& setup, std::size_t body);

/// Returns whether the domains of the particles of a body deform with the material.
bool follow_deformation(const State& state, std::size_t body);

/// Returns whether any option of the case requires the domains of the particles.
/// @param may_meet_images  whether any material may be in contact with its image
bool are_needed(const State& state, bool may_meet_images);

/// Deforms the domains of the listed particles by their velocity gradients (1/s): E <- (I + dt L) E (I + dt L)^T (2.4).
/// @returns number of domains that exceed the maximum of the shape function
std::size_t deform(State& state, std::span<const std::uint32_t> particles,
                   std::span<const Matrix3> gradients);

/// Returns the square of the half-edge beyond which a particle of a fluid has parted from its neighbours, lambda of (2.8),
/// m^2.
double parted_square(const cases::Case& setup, double cell_size);

/// Removes the pressure of fluid particles of a body along the directions in which they are separated from their
/// neighbours (2.8). Call after the material update, which sets the stress.
/// @returns number of such particles
std::size_t hold_back_pressure(Particles& particles, std::span<const std::uint32_t> list, const State& state,
                               std::size_t body);

/// Splits a particle in two halves of its domain along a half-edge (2.5) to (2.7); `other` becomes the second half.
/// Mass, momentum, angular momentum and second moments of the mass are conserved exactly; the loss of the affine field
/// becomes unresolved energy if this is stored, otherwise internal energy.
/// @param inertia  inertia per mass of the affine field, m^2; 0 without affine fields
/// @returns that loss, J
double divide(Particles& particles, std::size_t p, std::size_t other, const Vector3& half_edge,
              double inertia);

/// Splits particles that entered a region of small cells until they are as small as those want them, and particles that
/// are longer than the limit of the case along their longest direction (Ma, Zhang & Huang, CMES
/// 54 (2009) 61: L = (1 + eps) V0^(1/3) > alpha dx), except where a half would leave the domain. If the maximum number
/// of particles would be exceeded, none is split and the divisions are counted as refused. Collective.
void split(State& state, const Carriers& carriers, ParticleCarrier& of_particles);

}  // namespace whipple::solver::domains

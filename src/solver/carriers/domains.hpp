// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "src/solver/carriers/particle_carrier.hpp"

/// Domains of the particles: deformation with the material, particle splitting, particles that have parted
/// (docs/theory/mpm.md, section 2).
namespace whipple::solver::domains {

/// Returns whether particles of a case may be divided. Domains of the shape function `gimp` keep their size.
bool may_divide(const cases::Case& setup);
/// Returns whether those of a body of the case may be.
bool may_divide(const cases::Case& setup, std::size_t body);

/// Returns whether the domains of the particles of a body deform with the material.
bool follow_deformation(const State& state, std::size_t body);

/// Returns whether anything asks for the domains of the particles.
/// @param may_meet_images  is there material that may meet its image as another body?
bool are_needed(const State& state, bool may_meet_images);

/// Deforms the domains of the particles of a list by their velocity gradients (1/s): E <- (I + dt L) E (I + dt L)^T
/// (2.4).
/// @returns how many domains are larger than the shape function takes
std::size_t deform(State& state, std::span<const std::uint32_t> particles,
                   std::span<const Matrix3> gradients);

/// Takes the pressure of fluid particles of a body off the directions along which they have parted from their
/// neighbours (2.8); after the material update, which sets the stress.
/// @returns how many have
std::size_t hold_back_pressure(Particles& particles, std::span<const std::uint32_t> list, const State& state,
                               std::size_t body);

/// Divides a particle in two halves of its domain along a half-edge (2.6), (2.7). Its second half becomes
/// `other`, a copy of it. Mass, momentum, angular momentum and second moments of the mass stay exactly; what
/// the affine field loses becomes unresolved energy if there is a store of it, else internal energy.
/// @param inertia  of the affine field; 0 without one
/// @returns J, that loss
double divide(Particles& particles, std::size_t p, std::size_t other, const Vector3& half_edge,
              double inertia);

/// Divides particles that are longer than the case wants along their longest direction (Ma, Zhang & Huang, CMES
/// 54 (2009) 61: L = (1 + eps) V0^(1/3) > alpha dx); those that would leave the domain by it are not. None if there
/// would be more than the case takes: then the divisions are counted as refused. Collective.
void split(State& state, const Carriers& carriers, ParticleCarrier& of_particles);

}  // namespace whipple::solver::domains

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "src/solver/carriers/particle_carrier.hpp"

/// Domains of the particles: deformation with the material, particle splitting (docs/theory/mpm.md,
/// section 2).
namespace whipple::solver::domains {

/// Returns whether the domains deform with the material.
bool follow_deformation(const State& state);

/// Returns whether anything asks for the domains of the particles.
/// @param may_meet_images  is there material that may meet its image as another body?
bool are_needed(const State& state, bool may_meet_images);

/// Deforms the domains of the particles of a list by their velocity gradients (1/s): E <- (I + dt L) E (I + dt L)^T
/// (2.4).
/// @returns how many domains are larger than the shape function takes
std::size_t deform(State& state, std::span<const std::uint32_t> particles,
                   std::span<const Matrix3> gradients);

/// Divides intact particles that are longer than the case wants along their longest direction (Ma, Zhang & Huang, CMES
/// 54 (2009) 61: L = (1 + eps) V0^(1/3) > alpha dx); those that would leave the domain by it are not. Collective.
void split(State& state, const Carriers& carriers, ParticleCarrier& of_particles);

}  // namespace whipple::solver::domains

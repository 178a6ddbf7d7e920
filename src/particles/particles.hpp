// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/core/base/gaps.hpp"
#include "src/particles/material_points.hpp"

namespace whipple {

/// Holds material points that move through the grid. The solver keeps them sorted by body, then by grid block.
struct Particles : MaterialPoints {
  std::vector<std::uint64_t> id;    ///< unique, never changes
  std::vector<std::uint32_t> body;  ///< index of the body in the case
  std::vector<Vector3> position;    ///< m
  std::vector<Vector3> velocity;    ///< m/s
  /// Holds the affine velocity field, 1/s: a_p(x) = v_p + C_p (x - x_p) (docs/theory/mpm.md, 1); optional
  std::vector<Matrix3> affine_velocity;
  /// Holds the sum of r r^T over the three half-edges r of the domain of the particle, m^2 (docs/theory/mpm.md, 2);
  /// optional
  std::vector<SymmetricTensor> extent;
  /// Holds the kinetic energy that the transfers removed from the motion of the grid and that is not yet heat, J/kg,
  /// >= 0 (docs/theory/dissipation.md, 2); optional
  std::vector<double> unresolved_energy;
  /// Holds the part of the transfer losses that may still become heat immediately, J/kg, >= 0
  /// (docs/theory/dissipation.md, 3); optional
  std::vector<double> heat_allowance;
  std::vector<double> closing_rate;      ///< 1/s, -tr L of the last step, 0 in expansion; optional
  std::vector<std::uint8_t> generation;  ///< number of splits since seeding (0: as seeded)

  [[nodiscard]] std::size_t size() const { return mass.size(); }

  static constexpr auto fields() {
    using P = Particles;
    return std::tuple_cat(
        MaterialPoints::fields(),
        std::make_tuple(Field{"id", "1", &P::id}, Field{"body", "1", &P::body},
                        Field{"position", "m", &P::position}, Field{"velocity", "m/s", &P::velocity},
                        Field{"affine_velocity", "1/s", &P::affine_velocity, true},
                        Field{"extent", "m^2", &P::extent, true},
                        Field{"unresolved_energy", "J/kg", &P::unresolved_energy, true},
                        Field{"heat_allowance", "J/kg", &P::heat_allowance, true},
                        Field{"closing_rate", "1/s", &P::closing_rate, true},
                        Field{"generation", "1", &P::generation}));
  }
};

/// Activates the fields of unresolved energy: no energy, no allowance, and all viscosity heats.
inline void use_stores(Particles& particles) {
  const std::size_t size = particles.size();
  particles.unresolved_energy.resize(size, 0.0);
  particles.heat_allowance.resize(size, 0.0);
  particles.closing_rate.resize(size, 0.0);
  const std::vector<double>& viscosity = particles.artificial_viscosity;
  std::vector<double>& heating = particles.heating_viscosity;
  heating.insert(heating.end(), viscosity.begin() + static_cast<std::ptrdiff_t>(heating.size()),
                 viscosity.end());
}

/// Holds memory that is reused from one sort to the next: new pages cost more than the copy.
struct SortBuffers {
  std::vector<Vector3> vectors;
  std::vector<double> numbers;
};

/// Reorders every field as new[i] = old[order[i]]; `order` may be shorter than the particles (removal). Equal orders
/// give bitwise equal particles.
void reorder(Particles& particles, std::span<const std::uint32_t> order, SortBuffers& buffers);

/// Removes particles: `moves` from `moves_into_gaps` on their bodies; `size` particles remain.
void remove(Particles& particles, std::span<const Move> moves, std::size_t size);

/// Groups the particles by body; within a body the order is preserved.
void sort_by_body(Particles& particles);

}  // namespace whipple

// SPDX-License-Identifier: BSD-3-Clause
#include "src/bench/stage_cost.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/shape_function.hpp"

namespace whipple::bench {
namespace {

template <class... Values>
constexpr double bytes_of(std::vector<Values> Particles::*...) {
  return static_cast<double>((sizeof(Values) + ... + 0));
}
template <class... Values>
constexpr double bytes_of(std::vector<Values> MaterialPoints::*...) {
  return static_cast<double>((sizeof(Values) + ... + 0));
}

using M = MaterialPoints;
using P = Particles;

constexpr double place = bytes_of(&P::position) + sizeof(std::uint32_t);  // and its entry in the block's list
constexpr double stress = bytes_of(&M::deviatoric_stress, &M::pressure, &M::artificial_viscosity, &M::volume);
constexpr double node = sizeof(grid::Node);

/// Read and written by the constitutive update.
constexpr double material_state =
    bytes_of(&M::volume, &M::void_volume, &M::specific_internal_energy, &M::pressure,
             &M::artificial_viscosity, &M::deviatoric_stress, &M::temperature, &M::sound_speed,
             &M::plastic_strain, &M::melted_fraction, &M::vaporised_fraction, &M::damage, &M::failed,
             &M::maximum_pressure, &M::maximum_temperature, &M::melting_time);

/// One multiplication and one addition per component of a vector of four.
constexpr double multiply_add = 2.0 * 4.0;

/// Sums over n x n x n nodes that factorise: `inner` multiply-adds of vectors per node, `row` per row of
/// nodes, and the weights of three directions.
double sums(double n, double inner, double row) {
  constexpr double weights = 15.0;  // value, derivative and distance of one node in one direction
  return multiply_add * (n * n * n * inner + n * n * row) + 3.0 * n * weights;
}

}  // namespace

StageCost stage_cost(std::string_view stage, const cases::Case& setup, double nodes_per_particle) {
  const double n = transfer::stencil(transfer::shape_function(setup.transfer.shape_function)).count;
  const std::string& update = setup.transfer.particle_update;
  const bool affine = update == "relaxed_affine" || update == "apic";
  const bool exact_energy = setup.time.scheme == "symplectic";
  const double c = affine ? bytes_of(&P::affine_velocity) : 0.0;
  const double nodes = node * nodes_per_particle;
  const double velocity = bytes_of(&P::velocity);
  if (stage == "particles to grid") {
    return {place + velocity + c + stress + bytes_of(&M::mass, &M::sound_speed) + 2.0 * nodes,
            sums(n, 4.0, 9.0)};
  }
  if (stage == "grid") return {2.0 * nodes, 40.0 * nodes_per_particle};
  if (stage == "grid to particles" && exact_energy) {
    // v, dv/dz, d, dd/dz, b, heat; with C: moments of d and b, and C r in the particle's field
    return {place + 3.0 * velocity + 2.0 * c + stress + bytes_of(&M::mass, &M::specific_internal_energy) +
                bytes_of(&M::specific_internal_energy) + nodes,
            sums(n, affine ? 11.0 : 8.0, affine ? 16.0 : 10.0)};
  }
  if (stage == "grid to particles") return {place + 3.0 * velocity + nodes, sums(n, 2.0, 2.0)};
  if (stage == "momentum to grid") {
    return {place + velocity + bytes_of(&M::mass) + nodes, sums(n, 1.0, 1.0)};
  }
  if (stage == "velocity gradient") return {place + nodes, sums(n, 2.0, 3.0)};
  if (stage == "material") return {bytes_of(&M::mass) + 2.0 * material_state, 0.0};
  if (stage == "bin particles") return {bytes_of(&P::position) + 2.0 * sizeof(std::uint32_t), 0.0};
  if (stage == "time step") return {velocity + bytes_of(&M::sound_speed), 4.0};
  if (stage == "ledger") {
    return {velocity + bytes_of(&P::affine_velocity) + bytes_of(&M::mass, &M::specific_internal_energy),
            50.0};
  }
  return {};
}

}  // namespace whipple::bench

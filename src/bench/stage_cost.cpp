// SPDX-License-Identifier: BSD-3-Clause
#include "src/bench/stage_cost.hpp"

#include <algorithm>
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

/// Sums the bytes read and written by the constitutive update.
constexpr double material_state = bytes_of(
    &M::volume, &M::void_volume, &M::specific_internal_energy, &M::pressure, &M::artificial_viscosity,
    &M::deviatoric_stress, &M::temperature, &M::sound_speed, &M::plastic_strain, &M::melted_fraction,
    &M::vaporised_fraction, &M::failed, &M::maximum_pressure, &M::maximum_temperature, &M::melting_time);

/// Counts one multiplication and one addition per component of a vector of four.
constexpr double multiply_add = 2.0 * 4.0;

/// Counts the flops of factorised sums over n x n x n nodes: `inner` multiply-adds of vectors per node, `row` per row
/// of nodes, and the weights of three directions.
double sums(double n, double inner, double row) {
  constexpr double weights = 15.0;  // value, derivative and distance of one node in one direction
  return multiply_add * (n * n * n * inner + n * n * row) + 3.0 * n * weights;
}

/// Holds the properties of a problem on which the cost of a stage depends.
struct Method {
  double reach;  ///< nodes per direction in the support of a particle
  bool affine;
  bool exact_energy;
  double nodes;  ///< per particle, in the active blocks

  [[nodiscard]] double affine_bytes() const { return affine ? bytes_of(&P::affine_velocity) : 0.0; }
  [[nodiscard]] double node_bytes() const { return node * nodes; }
};

constexpr double velocity = bytes_of(&P::velocity);

StageCost particles_to_grid(const Method& m) {
  return {place + velocity + m.affine_bytes() + stress + bytes_of(&M::mass, &M::sound_speed) +
              2.0 * m.node_bytes(),
          sums(m.reach, 4.0, 9.0)};
}

StageCost grid_to_particles(const Method& m) {
  if (!m.exact_energy) return {place + 3.0 * velocity + m.node_bytes(), sums(m.reach, 2.0, 2.0)};
  // v, dv/dz, d, dd/dz, b, heat; with C: moments of d and b, and C r in the particle's field
  return {place + 3.0 * velocity + 2.0 * m.affine_bytes() + stress +
              bytes_of(&M::mass, &M::specific_internal_energy) + bytes_of(&M::specific_internal_energy) +
              m.node_bytes(),
          sums(m.reach, m.affine ? 11.0 : 8.0, m.affine ? 16.0 : 10.0)};
}

struct StageEntry {
  std::string_view name;  ///< in solver::Profile
  StageCost (*cost)(const Method&);
};

constexpr std::array<StageEntry, 9> stages = {{
    {"particles to grid", particles_to_grid},
    {"grid", [](const Method& m) { return StageCost{2.0 * m.node_bytes(), 40.0 * m.nodes}; }},
    {"grid to particles", grid_to_particles},
    {"momentum to grid",
     [](const Method& m) {
       return StageCost{place + velocity + bytes_of(&M::mass) + m.node_bytes(), sums(m.reach, 1.0, 1.0)};
     }},
    {"velocity gradient",
     [](const Method& m) { return StageCost{place + m.node_bytes(), sums(m.reach, 2.0, 3.0)}; }},
    {"material", [](const Method&) { return StageCost{bytes_of(&M::mass) + 2.0 * material_state, 0.0}; }},
    {"bin particles",
     [](const Method&) { return StageCost{bytes_of(&P::position) + 2.0 * sizeof(std::uint32_t), 0.0}; }},
    {"time step", [](const Method&) { return StageCost{velocity + bytes_of(&M::sound_speed), 4.0}; }},
    {"ledger",
     [](const Method&) {
       return StageCost{
           velocity + bytes_of(&P::affine_velocity) + bytes_of(&M::mass, &M::specific_internal_energy), 50.0};
     }},
}};

}  // namespace

StageCost stage_cost(std::string_view stage, const cases::Case& setup, double nodes_per_particle) {
  const auto* const entry = std::ranges::find(stages, stage, &StageEntry::name);
  if (entry == stages.end()) return {};
  return entry->cost({.reach = static_cast<double>(transfer::stencil(setup.transfer.shape_function).count),
                      .affine = cases::is_affine(setup.transfer.particle_update),
                      .exact_energy = setup.time.scheme == cases::Scheme::symplectic,
                      .nodes = nodes_per_particle});
}

}  // namespace whipple::bench

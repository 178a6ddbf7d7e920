// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "src/device/contact/nodes.hpp"
#include "src/device/engine.hpp"
#include "src/device/points.hpp"

/// What a step costs a device: memory, traffic and arithmetic (docs/manual/devices.md).
namespace whipple::device {

/// Sizes of a step on which its cost depends.
struct StepSize {
  double particles = 0.0;
  double slots = 0.0;     ///< blocks with nodes, of all fields
  double cells = 0.0;     ///< cells with particles (lists by the first node of the stencil)
  double blocks = 0.0;    ///< of the domain, of all fields
  bool reflects = false;  ///< mirror planes or walls: the sums before folding are kept
  std::uint32_t fields = 1;
  bool conducts = false;  ///< shock conduction is on
  bool planar = false;    ///< a section: stencils of 9 nodes

  [[nodiscard]] constexpr double stencil() const {
    return planar ? SectionLattice::stencil_nodes : SpaceLattice::stencil_nodes;
  }
};

/// Cost of a stage of the step, per particle.
struct StageCost {
  double least_bytes = 0.0;  ///< every number that it reads or writes once between memory and core
  double moved_bytes = 0.0;  ///< with the lists and sums that its kernels leave for one another
  double flops = 0.0;        ///< of the equations on nodes, as bench::stage_cost counts them; 0: not counted
};

namespace cost {

constexpr double number = sizeof(double), index = sizeof(std::uint32_t), node = sizeof(Node);

/// Flops of factorised sums over the nodes of a stencil (bench::stage_cost): `inner` multiply-adds of vectors of four per
/// node, `row` per row of nodes, and the weights.
constexpr double sums(double stencil, double inner, double row) {
  constexpr double n = stencil_edge, multiply_add = 8.0, weights = 15.0;
  return multiply_add * (stencil * inner + stencil / n * row) + 3.0 * n * weights;
}

// Numbers of a particle.
constexpr double place = 3.0 * number + index, motion = 15.0 * number,  // x; x, v, C
    stress = 9.0 * number;                                              // s, p, q, V
constexpr double sort_passes = 4.0, steps_of_sort = 20.0;

}  // namespace cost

/// Returns the cost of a stage per particle. Contact, folding at planes and conduction depend on how many particles
/// they concern, and are not counted.
inline StageCost cost_of(Stage stage, const StepSize& size) {
  using namespace cost;
  const double nodes = size.slots * block_nodes / size.particles, cells = size.cells / size.particles,
               stencil = size.stencil();
  switch (stage) {
    case Stage::bins: {
      constexpr double components = state_components;
      const double pairs = sort_passes * 4.0 * index;                      // key and value, read and written
      const double lists = 14.0 * index + cells * (stencil + 2.0) * index  // flags, numbers, nodes of cells
                           + 2.0 * nodes * index;
      const double sort = 4.0 * (components * number + 2.0 * index) / steps_of_sort;
      return {place + 2.0 * index, place + 3.0 * index + pairs + lists + sort, 0.0};
    }
    case Stage::conduction: {
      const double asked = size.conducts ? 2.0 * number + index : 0.0;
      return {asked, asked, 0.0};
    }
    case Stage::scatter: {
      const double read = motion + stress + 2.0 * number + index, brought = size.reflects ? 2.0 : 0.0;
      // The sums of each cell are written and read again; each node is written once more.
      return {read + 2.0 * node * nodes, read + 2.0 * node * stencil * cells + (1.0 + brought) * node * nodes,
              sums(stencil, 4.0, 9.0)};
    }
    case Stage::grid:
      return {2.0 * node * nodes, 2.0 * node * nodes, 40.0 * nodes};
    case Stage::gather: {
      const double read = motion + stress + 9.0 * number + 3.0 * index;
      const double written = motion + 9.0 * number + 10.0 * number;  // L; stores, energy and sums
      return {read + written + node * nodes, read + written + node * nodes + stencil * index * cells,
              sums(stencil, 11.0, 16.0)};
    }
    case Stage::material: {
      constexpr double state = 26.0 * number, gradients = 12.0 * number, results = 5.0 * number;
      return {2.0 * state + gradients + results + index, 2.0 * state + gradients + results + index, 0.0};
    }
    case Stage::ends: {
      const double read = motion + 14.0 * number + 2.0 * index;
      return {read, read, 50.0};
    }
    case Stage::contact:
      break;
  }
  return {};
}

/// Returns the cost of the whole step per particle.
inline StageCost cost_of_step(const StepSize& size) {
  StageCost all;
  for (std::size_t stage = 0; stage < stage_count; ++stage) {
    const StageCost of = cost_of(static_cast<Stage>(stage), size);
    all.least_bytes += of.least_bytes;
    all.moved_bytes += of.moved_bytes;
    all.flops += of.flops;
  }
  return all;
}

/// Memory of a step on a device, bytes.
struct MemoryNeed {
  double per_particle, per_slot, per_cell,
      per_block;  ///< of a block with nodes, of a cell with particles, of a block
  double all;
};

/// Returns what the arrays of Store, Cells and Contact need, with their reserve of an eighth. Nodes in contact add a
/// tenth at most where a twentieth of the nodes are.
inline MemoryNeed memory_need(const StepSize& size) {
  using namespace cost;
  constexpr double reserve = 1.125;
  constexpr double components = all_components;
  // Store: components, a spare one, five lists; Cells: five lists; two more of the sort.
  const double per_particle = reserve * ((components + 1.0) * number + (5 + 5 + 2) * index);
  // Nodes, their cells; sums before folding; flags of contact and of its places.
  const bool contact = size.fields > 1;
  const double per_slot =
      reserve * block_nodes *
      (node + index + (size.reflects ? node : 0.0) + 2.0 * index + (contact ? sizeof(ContactRole) : 0.0));
  const double per_cell = reserve * (size.stencil() * (node + index) + index);
  const double per_block = reserve * 3.0 * index;
  return {per_particle, per_slot, per_cell, per_block,
          per_particle * size.particles + per_slot * size.slots + per_cell * size.cells +
              per_block * size.blocks};
}

}  // namespace whipple::device

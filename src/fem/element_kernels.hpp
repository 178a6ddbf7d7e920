// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "src/fem/element_kernels/deformation.hpp"
#include "src/fem/element_kernels/forces.hpp"

/// The loops over the elements of a block, one element per lane: four at a time with AVX2, eight with AVX-512. Each lane
/// performs the same operations in the same order in both, and sums over lanes are taken in groups of four, so the
/// results are bitwise identical.
namespace whipple::fem {

/// Prefetches part g of the node data that the next block copies.
template <class... Fields>
WHIPPLE_INLINE inline void prefetch_next_block(const Mesh& mesh, std::size_t block, std::size_t g,
                                               const Fields&... fields) {
  const Blocks& blocks = mesh.blocks;
  if (block + 1 >= blocks.count()) return;
  const std::size_t groups = blocks.first_group[block + 1] - blocks.first_group[block];
  const std::size_t first = blocks.first_slot[block + 1], count = blocks.first_slot[block + 2] - first;
  for (std::size_t s = first + count * g / groups; s < first + count * (g + 1) / groups; ++s) {
    (__builtin_prefetch(fields[blocks.slot_node[s]].data(), 0, 2), ...);
  }
}

/// Provides the entry points for registers, Narrow or Wide. All functions called by them are inlined.
template <class Registers>
struct Kernels {
  using Vector = typename Registers::Register;
  using Field = BlockField<Vector>;

  /// Copies the positions of the nodes of a block.
  static void copy_positions(const Mesh& mesh, std::size_t block, Field& position) {
    Registers::run([&]() WHIPPLE_INLINE { position.copy(mesh, block, mesh.nodes.position); });
  }

  /// Calls kernel(step, group, fields, tally) for the elements of a block.
  /// @param position  on return, the positions at the end of the step
  template <class Kernel>
  static DeformationReport deform(const DeformationStep& step, const Motion& motion, std::size_t block,
                                  const Kernel& kernel, Field& position) {
    return Registers::run([&]() WHIPPLE_INLINE {
      Field mean, end;
      position.copy(step.mesh, block, step.mesh.nodes.position);
      mean.copy(step.mesh, block, motion.mean);
      end.copy(step.mesh, block, motion.end);
      Tally<Vector> tally;
      const std::span<const ElementGroup> groups = groups_of(step.mesh, block);
      for (std::size_t g = 0; g < groups.size(); ++g) {
        prefetch_next_block(step.mesh, block, g, step.mesh.nodes.position, motion.mean, motion.end);
        for_each_part<Vector>(groups[g], [&](const Group<Vector>& group) WHIPPLE_INLINE {
          kernel(step, group, Fields<Vector>{position.of(group), mean.of(group), end.of(group)}, tally);
        });
      }
      position.advance(step.mesh, block, step.dt, end);
      return tally.report();
    });
  }

  /// Computes the forces that kernel(mesh, group, positions, forces) adds for the elements of a block, at its slots.
  template <class Kernel>
  static void forces(Mesh& mesh, std::size_t block, const Kernel& kernel, Field& position) {
    Registers::run([&]() WHIPPLE_INLINE {
      Field force;
      force.zero(mesh, block);
      for (const ElementGroup& all : groups_of(mesh, block)) {
        for_each_part<Vector>(all, [&](const Group<Vector>& group)
                                       WHIPPLE_INLINE { kernel(mesh, group, position.of(group), force); });
      }
      Blocks& blocks = mesh.blocks;
      const std::uint32_t first = blocks.first_slot[block];
      force.copy_to(std::span(blocks.slot_force).subspan(first, blocks.first_slot[block + 1] - first));
    });
  }

  template <Quadrature quadrature>
  using Viscous = OnePoint<Vector, HourglassControl::Kind::viscous, quadrature>;
  template <Quadrature quadrature>
  using Stiffness = OnePoint<Vector, HourglassControl::Kind::stiffness, quadrature>;
  using EightPoints = DeformEightPoints<Vector>;
  template <Quadrature quadrature>
  using OnePointForces = ForcesOfOnePoint<Vector, quadrature>;
  using BBarForces = ForcesOfBBar<Vector>;
};

/// Calls f(Kernels{}) with the registers of the processor.
template <class Function>
void with_kernels(Function&& f) {
#if WHIPPLE_WIDE_KERNELS
  if (kernel_set() == KernelSet::wide) return f(Kernels<Wide>{});
#endif
  f(Kernels<Narrow>{});
}

}  // namespace whipple::fem

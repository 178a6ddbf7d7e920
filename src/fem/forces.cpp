// SPDX-License-Identifier: BSD-3-Clause
#include "src/fem/element_kernels.hpp"
#include "src/fem/step.hpp"
#include "src/parallel/threads.hpp"

namespace whipple::fem {
void internal_forces(Mesh& mesh) {
  parallel::for_each(block_count(mesh), [&](std::size_t block) {
    with_kernels([&]<class Kernels>(Kernels) {
      if (mesh.quadrature == Quadrature::b_bar) {
        Kernels::forces(mesh, block, typename Kernels::BBarForces{});
      } else {
        Kernels::forces(mesh, block, typename Kernels::OnePointForces{});
      }
    });
  });
  const Blocks& blocks = mesh.blocks;
  parallel::for_each(mesh.nodes.size(), [&](std::size_t a) {
    Vector3 force = Vector3::Zero();
    for (std::uint32_t k = blocks.first_of_node[a]; k < blocks.first_of_node[a + 1]; ++k) {
      force += blocks.slot_force[blocks.slots_of_node[k]];
    }
    mesh.nodes.force[a] = force;
  });
}

}  // namespace whipple::fem

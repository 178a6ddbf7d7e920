// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "src/core/base/error.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/fem/element_kernels.hpp"
#include "src/fem/step.hpp"

namespace whipple::fem {

DeformationReport& DeformationReport::operator+=(const DeformationReport& other) {
  work += other.work;
  hourglass_work += other.hourglass_work;
  hourglass_overdrawn += other.hourglass_overdrawn;
  limited_hourglass += other.limited_hourglass;
  inverted += other.inverted;
  first_inverted = std::min(first_inverted, other.first_inverted);
  return *this;
}

Matrix3 VelocityGradients::at(std::size_t point) const {
  Matrix3 gradient;
  for (std::size_t k = 0; k < component.size(); ++k) {
    gradient(static_cast<int>(k / 3), static_cast<int>(k % 3)) = component[k][point];
  }
  return gradient;
}

std::array<const double*, 9> VelocityGradients::from(std::size_t first) const {
  std::array<const double*, 9> values;
  for (std::size_t k = 0; k < component.size(); ++k) values[k] = component[k].data() + first;
  return values;
}

namespace {

/// Computes the forces of a block of elements with nodes at `position`, at its slots.
template <class Kernels>
void forces_of_block(Mesh& mesh, std::size_t block, typename Kernels::Field& position) {
  if (mesh.quadrature == Quadrature::b_bar) {
    Kernels::forces(mesh, block, typename Kernels::BBarForces{}, position);
  } else {
    with_shape_of(mesh.quadrature, [&]<Quadrature quadrature>() {
      Kernels::forces(mesh, block, typename Kernels::template OnePointForces<quadrature>{}, position);
    });
  }
}

/// Deforms the elements of a block. @param position  of the nodes, at the end of the step
template <class Kernels>
DeformationReport deform_block(const DeformationStep& step, const Motion& motion, std::size_t block,
                               typename Kernels::Field& position) {
  const auto deform_by = [&](const auto& kernel) {
    return Kernels::deform(step, motion, block, kernel, position);
  };
  if (step.mesh.quadrature == Quadrature::b_bar) return deform_by(typename Kernels::EightPoints{});
  return with_shape_of(step.mesh.quadrature, [&]<Quadrature quadrature>() {
    if (step.hourglass.kind == HourglassControl::Kind::viscous) {
      return deform_by(typename Kernels::template Viscous<quadrature>{});
    }
    return deform_by(typename Kernels::template Stiffness<quadrature>{});
  });
}

}  // namespace

DeformationReport deform(Mesh& mesh, const Motion& motion, double dt, const HourglassControl& hourglass,
                         VelocityGradients& velocity_gradient, const BlockUpdate& update) {
  if (velocity_gradient.size() != mesh.points.size() || motion.end.size() != mesh.nodes.size() ||
      motion.mean.size() != mesh.nodes.size()) {
    throw InternalError("fem::deform: velocities or gradients do not fit the mesh");
  }
  const DeformationStep step{mesh, dt, hourglass, velocity_gradient};
  std::vector<DeformationReport> reports(mesh.blocks.count());
  parallel::for_each(mesh.blocks.count(), [&](std::size_t block) {
    with_kernels([&]<class Kernels>(Kernels) {
      typename Kernels::Field position;
      Kernels::copy_positions(mesh, block, position);
      reports[block] = deform_block<Kernels>(step, motion, block, position);
      if (!update) return;
      const std::size_t rows = Blocks::size * points_per_element(mesh.quadrature);
      update(block * rows, std::min((block + 1) * rows, mesh.points.size()));
      forces_of_block<Kernels>(mesh, block, position);
    });
  });
  mesh.blocks.forces_stand = static_cast<bool>(update);
  DeformationReport sum;
  for (const DeformationReport& report : reports) sum += report;
  return sum;
}

void internal_forces(Mesh& mesh) {
  if (!mesh.blocks.forces_stand) {
    parallel::for_each(mesh.blocks.count(), [&](std::size_t block) {
      with_kernels([&]<class Kernels>(Kernels) {
        typename Kernels::Field position;
        Kernels::copy_positions(mesh, block, position);
        forces_of_block<Kernels>(mesh, block, position);
      });
    });
  }
  const Blocks& blocks = mesh.blocks;
  std::vector<Vector3>& total = mesh.nodes.force;
  parallel::for_each(blocks.runs.size(), [&](std::size_t r) {
    const Blocks::Run& run = blocks.runs[r];
    std::copy_n(&blocks.slot_force[run.slot], run.count, &total[run.node]);
  });
  parallel::for_each(blocks.shared_nodes.size(), [&](std::size_t i) {
    const std::uint32_t a = blocks.shared_nodes[i];
    Lanes force{};
    for (std::uint32_t k = blocks.first_of_node[a]; k < blocks.first_of_node[a + 1]; ++k) {
      force += load_vector(blocks.slot_force[blocks.slots_of_node[k]].data());
    }
    store_vector(total[a].data(), force);
  });
}

}  // namespace whipple::fem

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "src/base/error.hpp"
#include "src/fem/element_kernels.hpp"
#include "src/fem/step.hpp"
#include "src/parallel/threads.hpp"

namespace whipple::fem {

DeformationReport& DeformationReport::operator+=(const DeformationReport& other) {
  work += other.work;
  hourglass_work += other.hourglass_work;
  inverted += other.inverted;
  first_inverted = std::min(first_inverted, other.first_inverted);
  return *this;
}

DeformationReport deform(Mesh& mesh, const Motion& motion, double dt, const HourglassControl& hourglass,
                         std::span<Matrix3> velocity_gradient, const AfterBlock& after_block) {
  if (velocity_gradient.size() != mesh.points.size() || motion.end.size() != mesh.nodes.size() ||
      motion.mean.size() != mesh.nodes.size()) {
    throw InternalError("fem::deform: velocities or gradients do not fit the mesh");
  }
  const DeformationStep step{mesh, dt, hourglass, velocity_gradient};
  std::vector<DeformationReport> reports(block_count(mesh));
  parallel::for_each(block_count(mesh), [&](std::size_t block) {
    with_kernels([&]<class Kernels>(Kernels) {
      const auto deform_by = [&](const auto& kernel) {
        Kernels::deform(step, motion, block, kernel, reports[block]);
      };
      if (mesh.quadrature == Quadrature::b_bar) {
        deform_by(typename Kernels::EightPoints{});
      } else if (hourglass.kind == HourglassControl::Kind::viscous) {
        deform_by(typename Kernels::Viscous{});
      } else {
        deform_by(typename Kernels::Stiffness{});
      }
    });
    if (after_block) {
      const std::size_t rows = Blocks::size * points_per_element(mesh.quadrature);
      after_block(block * rows, std::min((block + 1) * rows, mesh.points.size()));
    }
  });
  DeformationReport sum;
  for (const DeformationReport& report : reports) sum += report;
  return sum;
}

}  // namespace whipple::fem

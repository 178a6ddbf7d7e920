// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/carriers/element_totals.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "src/core/base/marks.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::solver {
namespace {

/// Holds a vector that is initially zero.
struct VectorSum {
  Vector3 value = Vector3::Zero();
  VectorSum& operator+=(const VectorSum& other) {
    value += other.value;
    return *this;
  }
};

}  // namespace

Totals totals_of(const fem::Mesh& mesh, double affine_inertia) {
  const fem::MeshTotals of_mesh = fem::totals(mesh);
  const fem::Nodes& nodes = mesh.nodes;
  double affine = 0.0;
  Vector3 rotation = parallel::sum<VectorSum>(nodes.size(), [&](std::size_t a) {
                       return VectorSum{nodes.mass[a] * nodes.position[a].cross(nodes.velocity[a])};
                     }).value;
  for_each_marked(nodes.in_transition, [&](std::size_t a) {
    affine += 0.5 * nodes.mass[a] * affine_inertia * nodes.affine_velocity[a].squaredNorm();
    rotation += nodes.mass[a] * affine_inertia * rotation_of(nodes.affine_velocity[a]);
  });
  return {.mass = of_mesh.mass,
          .momentum = of_mesh.momentum,
          .momentum_scale = of_mesh.momentum_scale,
          .angular_momentum = rotation,
          .kinetic_energy = of_mesh.kinetic_energy,
          .affine_kinetic_energy = affine,
          .internal_energy = of_mesh.internal_energy,
          .hourglass_energy = of_mesh.hourglass_energy};
}

Totals totals_of(const fem::Bars& bars, double affine_inertia) {
  const fem::Nodes& nodes = bars.nodes;
  Totals sums = parallel::sum<Totals>(nodes.size(), [&](std::size_t a) {
    const double m = nodes.mass[a], speed2 = nodes.velocity[a].squaredNorm();
    return Totals{.mass = m,
                  .momentum = m * nodes.velocity[a],
                  .momentum_scale = m * std::sqrt(speed2),
                  .angular_momentum = m * (nodes.position[a].cross(nodes.velocity[a]) +
                                           affine_inertia * rotation_of(nodes.affine_velocity[a])),
                  .kinetic_energy = 0.5 * m * speed2,
                  .affine_kinetic_energy = 0.5 * m * affine_inertia * nodes.affine_velocity[a].squaredNorm()};
  });
  sums.internal_energy = fem::internal_energy(bars);
  return sums;
}

}  // namespace whipple::solver

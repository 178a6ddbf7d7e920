// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "src/fem/four_elements.hpp"
#include "src/fem/gauss_points.hpp"
#include "src/fem/step.hpp"
#include "src/parallel/threads.hpp"

namespace whipple::fem {
namespace {

/// Forces f_a = sum_k F_k phi_ka of a stress on the mean gradient (eq. 2.6).
[[gnu::always_inline]] inline Modes<Lanes> mean_gradient_forces(const Columns<Lanes>& stress,
                                                                const VolumeGradient<Lanes>& beta) {
  return {-(stress * beta.xi),      -(stress * beta.eta),    -(stress * beta.zeta), -(stress * beta.eta_zeta),
          -(stress * beta.zeta_xi), -(stress * beta.xi_eta), Triple<Lanes>{}};
}

[[gnu::always_inline]] inline Modes<Lanes> one_point_forces(const Mesh& mesh, const FourElements& four,
                                                            const Modes<Lanes>& x) {
  const VolumeGradient<Lanes> beta = volume_gradient(x);
  Columns<Lanes> stress = deviator_at(mesh.points, four.index);
  add_to_diagonal(stress, mean_stress_at(mesh.points, four.index));
  const auto q = hourglass_forces_of(mesh.elements, four);
  // Hourglass resistance (eq. 3.5): its part along B_a acts like a stress, the rest on the four modes.
  const Lanes scale = -root8 / beta.volume;
  const std::array<Triple<Lanes>, 4> shape = {x.eta_zeta, x.zeta_xi, x.xi_eta, x.xi_eta_zeta};
  for (std::size_t m = 0; m < 4; ++m) add_dyad(stress, scale * q[m], shape[m]);
  Modes<Lanes> f = mean_gradient_forces(stress, beta);
  f.eta_zeta -= (1.0 / root8) * q[0];
  f.zeta_xi -= (1.0 / root8) * q[1];
  f.xi_eta -= (1.0 / root8) * q[2];
  f.xi_eta_zeta -= (1.0 / root8) * q[3];
  return f;
}

Modes<Lanes> b_bar_forces(const Mesh& mesh, const FourElements& four, const Modes<Lanes>& x) {
  const VolumeGradient<Lanes> beta = volume_gradient(x);
  Modes<Lanes> f{};
  Lanes mean_stress{};  // times the volume
  for (std::size_t g = 0; g < 8; ++g) {
    const GaussPoint at(g);
    const auto rows = at.rows(four);
    const Columns<Lanes> jacobian = at.gradient(x);
    mean_stress += determinant(jacobian) * mean_stress_at(mesh.points, rows);
    // Deviator: det J s : grad u = (s cof J) : du/dxi
    const Columns<Lanes> cofactor = cofactors(jacobian), s = deviator_at(mesh.points, rows);
    const Triple<Lanes> px = -0.125 * (s * cofactor.x), py = -0.125 * (s * cofactor.y),
                        pz = -0.125 * (s * cofactor.z);
    f.xi += px;
    f.eta += py;
    f.zeta += pz;
    f.eta_zeta += at.zeta * py + at.eta * pz;
    f.zeta_xi += at.zeta * px + at.xi * pz;
    f.xi_eta += at.eta * px + at.xi * py;
    f.xi_eta_zeta += (at.eta * at.zeta) * px + (at.zeta * at.xi) * py + (at.xi * at.eta) * pz;
  }
  // Pressure on the mean gradient.
  Columns<Lanes> mean{};
  add_to_diagonal(mean, mean_stress / beta.volume);
  return f + mean_gradient_forces(mean, beta);
}

template <class Kernel>
WHIPPLE_KERNEL void forces_of_block(Mesh& mesh, std::size_t block, const Kernel& kernel) {
  BlockField position, force;
  position.copy(mesh, block, mesh.nodes.position);
  force.zero(mesh, block);
  for_each_four(block, mesh.elements.size(), [&](const FourElements& four) {
    force.add(mesh, four, kernel(mesh, four, position.modes(mesh, four)));
  });
  Blocks& blocks = mesh.blocks;
  const std::uint32_t first = blocks.first_slot[block];
  for (std::uint32_t s = first; s < blocks.first_slot[block + 1]; ++s) {
    const Lanes f = force[s - first];
    blocks.slot_force[s] = {f[0], f[1], f[2]};
  }
}

}  // namespace

void internal_forces(Mesh& mesh) {
  parallel::for_each(block_count(mesh), [&](std::size_t block) {
    if (mesh.quadrature == Quadrature::b_bar) {
      forces_of_block(mesh, block, b_bar_forces);
    } else {
      forces_of_block(mesh, block, [](const auto&... arguments) __attribute__((always_inline)) {
        return one_point_forces(arguments...);
      });
    }
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

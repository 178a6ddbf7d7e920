// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "src/fem/four_elements.hpp"
#include "src/fem/gauss_points.hpp"
#include "src/fem/step.hpp"
#include "src/parallel/threads.hpp"

namespace whipple::fem {
namespace {

/// Forces f_a = sum_k F_k phi_ka of a stress on the mean gradient (eq. 2.6).
Modes<Lanes> mean_gradient_forces(const Columns<Lanes>& stress, const VolumeGradient<Lanes>& beta) {
  return {-(stress * beta.xi),      -(stress * beta.eta),    -(stress * beta.zeta), -(stress * beta.eta_zeta),
          -(stress * beta.zeta_xi), -(stress * beta.xi_eta), Triple<Lanes>{}};
}

Modes<Lanes> one_point_forces(const Mesh& mesh, const FourElements& four, const Modes<Lanes>& x) {
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
    // Deviator (eq. 4.2): det J s : grad u = (s cof J) : du/dxi
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
  // Pressure on the mean gradient (eq. 4.3).
  Columns<Lanes> mean{};
  add_to_diagonal(mean, mean_stress / beta.volume);
  return f + mean_gradient_forces(mean, beta);
}

}  // namespace

void internal_forces(Mesh& mesh) {
  const std::size_t elements = mesh.elements.size();
  parallel::for_each(FourElements::groups(elements), [&](std::size_t group) {
    const FourElements four(group, elements);
    const Modes<Lanes> x = gather_modes(four, mesh.elements.corners, mesh.nodes.position);
    const auto forces = corners_of(mesh.quadrature == Quadrature::one_point ? one_point_forces(mesh, four, x)
                                                                            : b_bar_forces(mesh, four, x));
    const auto place = [&](std::size_t l) { return mesh.corner_force[8 * four.index[l]].data(); };
    scatter_columns<8>(four, forces, {place(0), place(1), place(2), place(3)});
  });
  parallel::for_each(mesh.nodes.size(), [&](std::size_t a) {
    Vector3 force = Vector3::Zero();
    for (const std::uint32_t corner : mesh.corners_at(a)) force += mesh.corner_force[corner];
    mesh.nodes.force[a] = force;
  });
}

}  // namespace whipple::fem

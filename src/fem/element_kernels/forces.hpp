// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "src/fem/element_kernels/formulas.hpp"
#include "src/fem/quadrilateral.hpp"

/// Forces of the stresses in elements and of hourglass control.
namespace whipple::fem {

/// Returns the forces f_a = sum_k F_k phi_ka of a stress on the mean gradient (eq. 2.6).
template <class Vector>
WHIPPLE_INLINE inline Modes<Vector> mean_gradient_forces(const Columns<Vector>& stress,
                                                         const VolumeGradient<Vector>& beta) {
  return {-(stress * beta.xi),      -(stress * beta.eta),    -(stress * beta.zeta), -(stress * beta.eta_zeta),
          -(stress * beta.zeta_xi), -(stress * beta.xi_eta), Triple<Vector>{}};
}

template <class Vector, Quadrature quadrature>
struct ForcesOfOnePoint {
  WHIPPLE_INLINE void operator()(const Mesh& mesh, const Group<Vector>& group,
                                 const typename BlockField<Vector>::OfGroup& position,
                                 BlockField<Vector>& forces) const {
    const Modes<Vector> x = position.modes();
    Vector radius{};
    if constexpr (quadrature == Quadrature::ring) radius = position.mean(1);
    const VolumeGradient<Vector> beta = volume_gradient_of<quadrature>(x, radius);
    Columns<Vector> stress = deviator_at<Vector>(mesh.points, group);
    add_to_diagonal(stress,
                    -(group.load(mesh.points.pressure) + group.load(mesh.points.artificial_viscosity)));
    if constexpr (quadrature == Quadrature::ring) {  // of the hoop, outwards (eq. 8.3)
      forces.add_constant(group, 1, -0.125 * (stress.z.z * beta.volume / radius));
    }
    const auto q = hourglass_forces_of(mesh.elements, group);
    // Hourglass resistance (eq. 3.5): the part along B_a acts like a stress, the rest on the four modes.
    const Vector scale = -root8 / beta.volume;
    const std::array<Triple<Vector>, 4> shape = {x.eta_zeta, x.zeta_xi, x.xi_eta, x.xi_eta_zeta};
    for (std::size_t m = 0; m < 4; ++m) add_dyad(stress, scale * q[m], shape[m]);
    Modes<Vector> f = mean_gradient_forces(stress, beta);
    f.eta_zeta -= (1.0 / root8) * q[0];
    f.zeta_xi -= (1.0 / root8) * q[1];
    f.xi_eta -= (1.0 / root8) * q[2];
    f.xi_eta_zeta -= (1.0 / root8) * q[3];
    forces.add(group, f);
  }
};

template <class Vector>
struct ForcesOfBBar {
  WHIPPLE_INLINE void operator()(const Mesh& mesh, const Group<Vector>& group,
                                 const typename BlockField<Vector>::OfGroup& position,
                                 BlockField<Vector>& forces) const {
    const Modes<Vector> x = position.modes();
    const VolumeGradient<Vector> beta = volume_gradient(x);
    Modes<Vector> f{};
    Vector mean_stress{};  // times the volume
    for (std::size_t g = 0; g < 8; ++g) {
      const GaussPoint at(g);
      const auto rows = at.rows(group);
      const Columns<Vector> jacobian = at.gradient(x);
      mean_stress += determinant(jacobian) * mean_stress_at<Vector>(mesh.points, rows);
      // Deviator: det J s : grad u = (s cof J) : du/dxi
      const Columns<Vector> cofactor = cofactors(jacobian), s = deviator_at<Vector>(mesh.points, rows);
      const Triple<Vector> px = -0.125 * (s * cofactor.x), py = -0.125 * (s * cofactor.y),
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
    Columns<Vector> mean{};
    add_to_diagonal(mean, mean_stress / beta.volume);
    forces.add(group, f + mean_gradient_forces(mean, beta));
  }
};

}  // namespace whipple::fem

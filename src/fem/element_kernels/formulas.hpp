// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "src/fem/element_kernels/blocks.hpp"
#include "src/fem/step.hpp"

/// Formulas at integration points.
namespace whipple::fem {

inline constexpr double root8 = 2.8284271247461900976;  ///< norm of a mode's corner values

/// Describes one of the 2 x 2 x 2 Gauss points; weight 1.
struct GaussPoint {
  std::size_t number;
  double xi, eta, zeta;

  explicit GaussPoint(std::size_t g)
      : number(g),
        xi(gauss_coordinate * corner_coordinates[g][0]),
        eta(gauss_coordinate * corner_coordinates[g][1]),
        zeta(gauss_coordinate * corner_coordinates[g][2]) {}

  template <class Vector>
  [[nodiscard]] Rows<Vector> rows(const Group<Vector>& group) const {
    Rows<Vector> rows;
    for (std::size_t l = 0; l < width<Vector>; ++l) rows[l] = 8 * group.index(l) + number;
    return rows;
  }
  template <class T>
  [[nodiscard]] Columns<T> gradient(const Modes<T>& u) const {
    return natural_gradient(u, xi, eta, zeta);
  }
};

template <class T>
void add_to_diagonal(Columns<T>& m, const T& value) {
  m.x.x += value;
  m.y.y += value;
  m.z.z += value;
}

/// Loads the deviators of points, those of lane l from row(l) on.
template <class Vector, class Row>
WHIPPLE_INLINE inline Columns<Vector> deviator_of(Row&& row) {
  static_assert(sizeof(SymmetricTensor) == 6 * sizeof(double));
  std::array<Lanes, width<Vector>> front, back;
  for (std::size_t l = 0; l < width<Vector>; ++l) {
    const double* const s = row(l);
    front[l] = load(s);
    back[l] = load(s + 2);
  }
  const auto normal = transposed(front), shear = transposed(back);  // xx yy zz xy, zz xy yz zx
  const Vector &xy = normal[3], &yz = shear[2], &zx = shear[3];
  return {{normal[0], xy, zx}, {xy, normal[1], yz}, {zx, yz, normal[2]}};
}
template <class Vector>
WHIPPLE_INLINE inline Columns<Vector> deviator_at(const GaussPoints& points, const Rows<Vector>& at) {
  return deviator_of<Vector>([&](std::size_t l)
                                 WHIPPLE_INLINE { return &points.deviatoric_stress[at[l]].xx; });
}
/// Loads the deviators of a group of one-point elements. (Lanes without an element may read the following entries of
/// the block.)
template <class Vector>
WHIPPLE_INLINE inline Columns<Vector> deviator_at(const GaussPoints& points, const Group<Vector>& group) {
  constexpr std::size_t n = 6;
  const std::vector<SymmetricTensor>& all = points.deviatoric_stress;
  const double* from = &all[group.first].xx;
  std::array<double, n * width<Vector>> last;  // without initialisation
  if (group.first % Blocks::size + width<Vector> > Blocks::size || group.first + width<Vector> > all.size()) {
    for (std::size_t l = 0; l < width<Vector>; ++l) std::copy_n(&all[group.index(l)].xx, n, &last[n * l]);
    from = last.data();
  }
  return deviator_of<Vector>([&](std::size_t l) WHIPPLE_INLINE { return from + n * l; });
}

/// Returns -(p + q).
template <class Vector>
WHIPPLE_INLINE inline Vector mean_stress_at(const GaussPoints& points, const Rows<Vector>& at) {
  Vector stress;
  for (std::size_t l = 0; l < width<Vector>; ++l) {
    stress[l] = -(points.pressure[at[l]] + points.artificial_viscosity[at[l]]);
  }
  return stress;
}

/// Calls f(component of q, its array) for the twelve components of the hourglass forces.
template <class Vector, class Function>
WHIPPLE_INLINE inline void for_each_hourglass_component(std::array<Triple<Vector>, 4>& q, Function&& f) {
  constexpr auto components = Elements::hourglass_components();
  for (std::size_t m = 0; m < 4; ++m) {
    f(q[m].x, components[3 * m]);
    f(q[m].y, components[3 * m + 1]);
    f(q[m].z, components[3 * m + 2]);
  }
}
template <class Vector>
WHIPPLE_INLINE inline std::array<Triple<Vector>, 4> hourglass_forces_of(const Elements& elements,
                                                                        const Group<Vector>& group) {
  std::array<Triple<Vector>, 4> q;
  for_each_hourglass_component(
      q, [&](Vector& x, const auto component) WHIPPLE_INLINE { x = group.load(elements.*component); });
  return q;
}

template <class T>
WHIPPLE_INLINE inline Columns<T> scaled(const Columns<T>& m, const T& factor) {
  return {factor * m.x, factor * m.y, factor * m.z};
}

/// Returns the gradient scaled such that det(I + dt L) is `ratio` (eq. 2.8).
template <class Vector>
WHIPPLE_INLINE inline Columns<Vector> with_volume_ratio(const Columns<Vector>& gradient, const Vector& ratio,
                                                        double dt) {
  Columns<Vector> f = scaled(gradient, broadcast<Vector>(dt));
  add_to_diagonal(f, broadcast<Vector>(1.0));
  const Vector stretch = cube_root_near_one(ratio / determinant(f));
  // (stretch F - I)/dt without a difference of large numbers
  Columns<Vector> result = scaled(gradient, stretch);
  add_to_diagonal(result, (stretch - 1.0) / dt);
  return result;
}

/// Calls f(L_ij, component) for the nine components of a gradient.
template <class Vector, class Function>
WHIPPLE_INLINE inline void for_each_component(const Columns<Vector>& l, Function&& f) {
  f(l.x.x, 0), f(l.y.x, 1), f(l.z.x, 2);
  f(l.x.y, 3), f(l.y.y, 4), f(l.z.y, 5);
  f(l.x.z, 6), f(l.y.z, 7), f(l.z.z, 8);
}

/// Lists the four modes with zero mean gradient.
template <class Vector>
constexpr std::array<Triple<Vector> Modes<Vector>::*, 4> hourglass_modes = {
    &Modes<Vector>::eta_zeta, &Modes<Vector>::zeta_xi, &Modes<Vector>::xi_eta, &Modes<Vector>::xi_eta_zeta};

/// Accumulates the report of a block: sums for each lane of the groups.
template <class Vector>
struct Tally {
  std::array<Vector, ElementGroup::size / width<Vector>> work{}, hourglass_work{}, overdrawn{}, limited{};
  DeformationReport inverted;

  WHIPPLE_INLINE void add(const Group<Vector>& group, Vector work_done, Vector hourglass_work_done) {
    work[group.lane / width<Vector>] += first_lanes(work_done, group.count);
    hourglass_work[group.lane / width<Vector>] += first_lanes(hourglass_work_done, group.count);
  }
  /// Counts limited hourglass forces.
  /// @param overdrawn_energy  J, returned by hourglass forces beyond the stored energy
  /// @param cut               1 if the forces were limited by the stored energy
  WHIPPLE_INLINE void add_limits(const Group<Vector>& group, Vector overdrawn_energy, Vector cut) {
    overdrawn[group.lane / width<Vector>] += first_lanes(overdrawn_energy, group.count);
    limited[group.lane / width<Vector>] += first_lanes(cut, group.count);
  }
  WHIPPLE_INLINE void count_inverted(const Group<Vector>& group, Vector volume) {
    if (all_positive(volume)) return;
    for (std::size_t l = 0; l < group.count; ++l) {
      if (volume[l] > 0.0) continue;
      ++inverted.inverted;
      inverted.first_inverted = std::min(inverted.first_inverted, group.index(l));
    }
  }
  [[nodiscard]] DeformationReport report() const {
    DeformationReport report = inverted;
    for (std::size_t part = 0; part < work.size(); ++part) {
      for (std::size_t l = 0; l < width<Vector>; ++l) {
        report.work += work[part][l];
        report.hourglass_work += hourglass_work[part][l];
        report.hourglass_overdrawn += overdrawn[part][l];
        report.limited_hourglass += limited[part][l];
      }
    }
    return report;
  }
};

/// Returns the factor by which the plastic strain since the last step reduces the hourglass forces (eq. 3.9), and marks
/// it as applied.
/// @param modulus  rho c^2
template <class Vector>
WHIPPLE_INLINE inline Vector return_factor(const Group<Vector>& group, Elements& elements,
                                           const GaussPoints& points, const Columns<Vector>& deviator,
                                           const Vector& modulus) {
  const Vector strain = group.load(points.plastic_strain);
  const Vector increment = strain - group.load(elements.returned_plastic_strain);
  group.store(elements.returned_plastic_strain, strain);
  const Vector overshoot = 0.8 * modulus * maximum(increment, Vector{});  // 3 G dep of metals
  const Vector equivalent = sqrt(1.5 * contraction(deviator, deviator));
  return overshoot > 0.0 ? equivalent / (equivalent + overshoot) : broadcast<Vector>(1.0);
}

/// Holds the fields at the corners of a group that determine its motion.
template <class Vector>
struct Fields {
  typename BlockField<Vector>::OfGroup position, mean_velocity, end_velocity;
};

/// Returns the matrix with the rows row(index, axis).
template <class Vector, class Row>
WHIPPLE_INLINE inline Columns<Vector> by_rows(Row&& row) {
  const Triple<Vector> x = row(0, &Triple<Vector>::x), y = row(1, &Triple<Vector>::y),
                       z = row(2, &Triple<Vector>::z);
  return {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}};
}

}  // namespace whipple::fem

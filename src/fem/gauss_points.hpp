// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "src/fem/four_elements.hpp"

/// State of four elements at one Gauss point each.
namespace whipple::fem {

constexpr double root8 = 2.8284271247461900976;  ///< norm of a mode's corner values

using Rows = std::array<std::size_t, 4>;

/// One of the 2 x 2 x 2 Gauss points; weight 1.
struct GaussPoint {
  std::size_t number;
  double xi, eta, zeta;

  explicit GaussPoint(std::size_t g)
      : number(g),
        xi(gauss_coordinate * corner_coordinates[g][0]),
        eta(gauss_coordinate * corner_coordinates[g][1]),
        zeta(gauss_coordinate * corner_coordinates[g][2]) {}

  [[nodiscard]] Rows rows(const FourElements& four) const {
    return {8 * four.index[0] + number, 8 * four.index[1] + number, 8 * four.index[2] + number,
            8 * four.index[3] + number};
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

inline Columns<Lanes> deviator_at(const GaussPoints& points, const Rows& rows) {
  const auto& s = points.deviatoric_stress;
  static_assert(sizeof(SymmetricTensor) == 6 * sizeof(double));
  const Triple<Lanes> normal = triple_of({&s[rows[0]].xx, &s[rows[1]].xx, &s[rows[2]].xx, &s[rows[3]].xx});
  const Triple<Lanes> shear = triple_of({&s[rows[0]].xy, &s[rows[1]].xy, &s[rows[2]].xy, &s[rows[3]].xy});
  const Lanes &xy = shear.x, &yz = shear.y, &zx = shear.z;
  return {{normal.x, xy, zx}, {xy, normal.y, yz}, {zx, yz, normal.z}};
}

/// -(p + q)
inline Lanes mean_stress_at(const GaussPoints& points, const Rows& rows) {
  const auto at = [&](std::size_t row) { return -(points.pressure[row] + points.artificial_viscosity[row]); };
  return Lanes{at(rows[0]), at(rows[1]), at(rows[2]), at(rows[3])};
}

inline std::array<Triple<Lanes>, 4> hourglass_forces_of(const Elements& elements, const FourElements& four) {
  const auto at = [&](std::size_t l) { return elements.hourglass_force[four.index[l]].data(); };
  return gather_columns<4>({at(0), at(1), at(2), at(3)});
}

}  // namespace whipple::fem

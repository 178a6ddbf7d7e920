// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "src/core/base/vector_math.hpp"

/// The trilinear hexahedron expanded in modes (docs/theory/fem.md, 2): a nodal field u_a = sum_k u_k phi_k(xi_a) with
/// phi = 1, xi, eta, zeta, eta zeta, zeta xi, xi eta, xi eta zeta. T is a number, or a register of numbers for several
/// elements. The formulas, hexahedron.inl, are compiled for each register width (element_kernels.hpp).
namespace whipple::fem {

/// Lists the natural coordinates of the corners (or of the adjacent Gauss points, times sqrt(3)).
constexpr std::array<std::array<double, 3>, 8> corner_coordinates = {
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
constexpr double gauss_coordinate = 0.57735026918962576451;  ///< 1/sqrt(3)

inline double root(double x) { return std::sqrt(x); }
inline bool all_positive(double x) { return x > 0.0; }

#include "src/fem/hexahedron.inl"

}  // namespace whipple::fem

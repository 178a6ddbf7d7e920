// SPDX-License-Identifier: BSD-3-Clause
// Included by src/fem/element_kernels.hpp, once per register width.
// clang-format off: each file needs those before it
#include "src/fem/hexahedron.inl"
#include "src/fem/element_kernels/blocks.inl"
#include "src/fem/element_kernels/formulas.inl"
#include "src/fem/element_kernels/deformation_and_forces.inl"
#include "src/fem/element_kernels/entries.inl"
// clang-format on

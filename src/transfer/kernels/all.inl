// SPDX-License-Identifier: BSD-3-Clause
// Included by src/transfer/register_kernels.hpp, once per set of registers.
// clang-format off: each file needs those before it
#include "src/transfer/kernels/access.inl"
#include "src/transfer/kernels/stencil_sums.inl"
#include "src/transfer/kernels/gather.inl"
#include "src/transfer/kernels/scatter.inl"
#include "src/transfer/kernels/entries.inl"
// clang-format on

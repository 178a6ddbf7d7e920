// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace whipple {

/// Four doubles that compute together: the compiler's vector extension, one register under AVX2. The kernels
/// vectorise over the payload of a node (scalar and vector of three), not over particles.
using Lanes [[gnu::vector_size(32)]] = double;

inline Lanes broadcast(double value) { return Lanes{value, value, value, value}; }

/// Sum of the first three lanes.
inline double sum3(Lanes v) { return v[0] + v[1] + v[2]; }

}  // namespace whipple

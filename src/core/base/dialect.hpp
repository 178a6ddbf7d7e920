// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Marks a formula of one point, which kernels of a graphics processor call as the host does. It uses numbers, plain
/// structs of them and arrays of fixed size: no container, no exception, no call through a pointer.
#ifdef __CUDACC__
#define WHIPPLE_POINT __host__ __device__
#else
#define WHIPPLE_POINT
#endif

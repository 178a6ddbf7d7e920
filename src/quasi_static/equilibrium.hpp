// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "src/quasi_static/response.hpp"
#include "src/quasi_static/system.hpp"

namespace whipple::quasi_static {

/// Controls Newton's iteration.
struct NewtonControl {
  double tolerance = 1e-8;  ///< of the residual, relative to the forces of the nodes
  int iterations = 12;      ///< at most
};

/// Reports a load step.
struct Convergence {
  bool reached = false;
  int iterations = 0;             ///< solutions of the linear system
  std::vector<double> residuals;  ///< relative, before each iteration and at the end
  std::size_t worst_node = 0;     ///< active node with the largest residual
  std::vector<Vector3> u;         ///< displacements of the active nodes, m
  std::vector<Matrix3> f;         ///< deformation gradients of the particles
  std::vector<Vector3> internal;  ///< forces of the nodes at the end, N
  double tangent_seconds = 0.0;   ///< of the differences that give dT/df
  double linear_seconds = 0.0;    ///< of assembly, factors and solutions of K
};

/// Finds the displacements of the nodes with which internal and external forces agree (eq. 3), by Newton's iteration
/// with a line search. The trial state of the response is that of the result.
/// @param external  forces (N) on the active nodes
Convergence find_equilibrium(System& system, const Unknowns& unknowns, Response& response,
                             const Supports& supports, std::span<const Vector3> external,
                             const NewtonControl& control);

}  // namespace whipple::quasi_static

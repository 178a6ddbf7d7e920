// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "src/material/update.hpp"
#include "src/particles/particles.hpp"
#include "src/quasi_static/closed_tangent.hpp"
#include "src/quasi_static/supports.hpp"

namespace whipple::quasi_static {

/// Computes the stresses of particles as functions of their deformation over a load step, from their state at its
/// beginning, which stays as it is: any model of the library, by the update of a time step with L = (f - 1)/dt.
class Response {
 public:
  /// @param before  at the beginning of the load step; must outlive this object
  Response(const Particles& before, std::vector<Group> groups, int strains);

  /// Computes T = V sigma f^-T (J) of all particles for f, the deformation gradient of the step: node i receives the
  /// internal force T grad N_i (eq. 2). Components that displacements change, in the order of `component`.
  /// @param[out] forces  `strains` numbers per particle
  /// @returns whether the update is defined: no state is out of range, no volume is limited
  bool evaluate(std::span<const Matrix3> f, std::span<double> forces);
  /// Computes T of the beginning, where f is the identity.
  void at_beginning(std::span<double> forces) const;
  /// Computes dT/df of all particles (eq. 4), row by row, `strains`^2 numbers per particle: in closed form where the law
  /// has one, otherwise by differences from `forces` at `f`. The trial state is lost.
  void tangents(std::span<const Matrix3> f, std::span<const double> forces, std::span<double> out);

  /// Returns the state after the last `evaluate`.
  [[nodiscard]] const MaterialPoints& trial() const { return trial_; }
  /// Returns the reports of the last `evaluate`, one of each group.
  [[nodiscard]] std::span<const MaterialReport> reports() const { return reports_; }

 private:
  /// Computes dT/df of the particles of groups by differences. The trial state is lost.
  void differences(std::span<const Matrix3> f, std::span<const double> forces, std::span<const Group> groups,
                   std::span<double> out);
  std::vector<MaterialReport> update(std::span<const Matrix3> f, std::span<const Group> groups);
  MaterialReport update(std::span<const Matrix3> f, const Group& group);
  void collect(const MaterialPoints& points, std::span<const Matrix3> f, std::span<double> forces) const;

  const Particles& before_;
  std::vector<Group> groups_;
  int strains_;
  MaterialPoints trial_;
  std::vector<MaterialReport> reports_;
  std::vector<Matrix3> gradient_, moved_;
};

}  // namespace whipple::quasi_static

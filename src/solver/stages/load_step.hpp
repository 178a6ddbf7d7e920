// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "src/quasi_static/equilibrium.hpp"
#include "src/solver/loads.hpp"
#include "src/solver/stages/applied_loads.hpp"
#include "src/solver/stages/partition.hpp"
#include "src/solver/state.hpp"

namespace whipple::solver {

/// Performs load steps without inertia (docs/theory/quasi_static.md): the displacements of the nodes with which the
/// stresses at the end of a step balance the loads at its end. The length of a step is a time, over which loads, paths
/// and laws that depend on rates follow their tables.
class LoadStep {
 public:
  LoadStep(State& state, const Loads& loads, AppliedLoads& applied_loads, Partition& partition);

  /// Sets velocities to zero and declares the fields that a kept grid needs.
  void begin_run();
  /// Performs one load step, at most to the time `until` (s); halves it where Newton's iteration does not converge.
  /// @throws StateError with step, residual and particle if the least step does not converge
  void perform(double until);

 private:
  void choose_length(double until);
  void bin();
  [[nodiscard]] std::vector<Vector3> accelerations(double time);
  [[nodiscard]] quasi_static::Supports find_supports();
  [[nodiscard]] std::vector<quasi_static::Group> groups() const;
  [[nodiscard]] std::vector<std::optional<Vector3>> displacements_of_bodies() const;
  [[nodiscard]] std::vector<double> border_moduli(const quasi_static::Supports& supports) const;
  struct Attempt;
  void commit(const Attempt& attempt);
  void move(const Attempt& attempt);
  void book(const Attempt& attempt);
  [[noreturn]] void give_up(const Attempt& attempt) const;

  State& state_;
  const Loads& loads_;
  AppliedLoads& applied_loads_;
  Partition& partition_;
  bool keeps_grid_;
};

}  // namespace whipple::solver

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "src/solver/loads.hpp"
#include "src/solver/state.hpp"

namespace whipple::solver {

/// Manages the relation of particles and grid: free flight, inactive blocks, and random shifts of the grid
/// (docs/theory/mpm.md, section 8).
class Activity {
 public:
  Activity(State& state, const Loads& loads) : state_(state), loads_(loads) {}

  /// Moves the grid by a random fraction of a cell where the case requests it, before particles are binned.
  void shift_grid();
  /// Finds the particles in free flight in this step, and the inactive blocks. Collective.
  void find();

  /// Returns the particles in free flight in this step.
  [[nodiscard]] const std::vector<std::uint32_t>& flying() const { return flying_; }
  /// Returns the first time (s), not before the present one, at which loads or materials act on material at rest.
  [[nodiscard]] double next_event() const;
  /// Returns whether blocks without motion and stress may be inactive in this step.
  [[nodiscard]] bool material_may_rest() const;
  /// Returns whether a particle moves or carries a stress.
  [[nodiscard]] bool is_restless(std::size_t particle) const;
  /// Returns whether much less material is at rest than when the blocks were distributed over the ranks.
  [[nodiscard]] bool has_much_woken() const;
  /// Records that the blocks have been distributed again.
  void blocks_shared_out() { most_at_rest_ = 0; }

 private:
  void find_free_flight();
  void let_material_rest();
  [[nodiscard]] bool explosives_are_lit(double before) const;
  [[nodiscard]] int layers_ahead_of_motion() const;

  State& state_;
  const Loads& loads_;
  std::vector<std::uint32_t> flying_;
  std::int64_t most_at_rest_ = 0;  // maximum since the blocks were distributed over the ranks
};

}  // namespace whipple::solver

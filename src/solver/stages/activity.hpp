// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "src/solver/loads.hpp"
#include "src/solver/state.hpp"

namespace whipple::solver {

/// Particles and grid apart: free flight, material at rest, and random shifts of the grid (docs/theory/mpm.md,
/// section 8).
class Activity {
 public:
  Activity(State& state, const Loads& loads) : state_(state), loads_(loads) {}

  /// Moves the grid by a random fraction of a cell where the case asks for it, before particles are binned.
  void shift_grid();
  /// Finds the particles that fly without the grid in this step, and the blocks that stay as they are. Collective.
  void find();

  /// Returns the particles that fly without the grid in this step.
  [[nodiscard]] const std::vector<std::uint32_t>& flying() const { return flying_; }
  /// Returns the first time (s), from now on, at which loads or materials act on material at rest.
  [[nodiscard]] double next_event() const;
  /// Returns whether blocks without motion and stress may stay as they are in this step.
  [[nodiscard]] bool material_may_rest() const;
  /// Returns whether a particle moves or bears a stress.
  [[nodiscard]] bool is_restless(std::size_t particle) const;
  /// Returns whether much less material is at rest than when the blocks were shared out among the ranks.
  [[nodiscard]] bool has_much_woken() const;
  /// Takes note that the blocks have been shared out.
  void blocks_shared_out() { most_at_rest_ = 0; }

 private:
  void find_free_flight();
  void let_material_rest();
  [[nodiscard]] bool explosives_are_lit(double before) const;
  [[nodiscard]] int layers_ahead_of_motion() const;

  State& state_;
  const Loads& loads_;
  std::vector<std::uint32_t> flying_;
  std::int64_t most_at_rest_ = 0;  // since the blocks were shared out among the ranks
};

}  // namespace whipple::solver

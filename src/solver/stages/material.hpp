// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "src/material/update.hpp"
#include "src/solver/stages/activity.hpp"
#include "src/solver/state.hpp"
#include "src/transfer/grid_to_particles.hpp"

/// The constitutive half of the step (docs/theory/material.md).
namespace whipple::solver {

/// Returns the settings of the constitutive update of a body in the step under way.
UpdateSettings update_settings(const State& state, std::size_t body);

/// Counts what an update met.
/// @param describe  tells of a point of the update and what is wrong with it
/// @returns an error that ends the run, or nothing
std::string book(State& state, const MaterialReport& report, const Material& material,
                 const std::function<std::string(std::size_t, const std::string&)>& describe);

/// Constitutive update of the particles, each as soon as it has its velocity gradient.
class MaterialStage {
 public:
  MaterialStage(State& state, const Activity& activity) : state_(state), activity_(activity) {}

  /// Source of the internal energy of a particle.
  enum class Energy { by_work_identity, by_constitutive_model };

  /// Updates the material of all particles.
  /// @param stage   what the time of the gather belongs to
  /// @param gather  gather(take) hands the velocity gradients on
  /// @throws StateError on all ranks, if a state is undefined or out of range on any
  void update(std::string_view stage, Energy energy,
              const std::function<void(const transfer::TakeGradients& take)>& gather);

 private:
  State& state_;
  const Activity& activity_;
};

}  // namespace whipple::solver

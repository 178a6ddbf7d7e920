// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/material/update.hpp"
#include "src/solver/stages/activity.hpp"
#include "src/solver/state.hpp"
#include "src/transfer/grid_to_particles.hpp"

/// The constitutive half of the step (docs/theory/material.md).
namespace whipple::solver {

/// Returns the settings of the constitutive update of a body in the step under way.
UpdateSettings update_settings(const State& state, std::size_t body);

/// Tells of a point of an update and what is wrong with it.
using DescribePoint = std::function<std::string(std::size_t point, const std::string& reason)>;

/// Counts what an update met.
/// @returns an error that ends the run, or nothing
std::string book(State& state, const MaterialReport& report, const Material& material,
                 const DescribePoint& describe);

/// Points at the end of their equation of state, by body: whether they are single ones or the material as such
/// is decided by the points of all ranks, so that a run does not depend on their number.
class SqueezedPoints {
 public:
  explicit SqueezedPoints(std::size_t bodies) : counts_(2 * bodies), first_(bodies) {}
  void add(std::size_t body, const MaterialReport& report, const DescribePoint& describe);
  /// Returns an error that ends the run, about a point of this rank, or nothing. Collective.
  [[nodiscard]] std::string fault(MPI_Comm communicator,
                                  std::span<const std::shared_ptr<const Material>> materials);

 private:
  std::vector<double> counts_;  // of squeezed points and of points, of each body
  std::vector<std::function<std::string(const std::string& reason)>> first_;  // that tell of the first one
};

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

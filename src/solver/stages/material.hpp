// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "src/material/update.hpp"
#include "src/solver/stages/activity.hpp"
#include "src/solver/state.hpp"
#include "src/transfer/sweep.hpp"

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

/// Constitutive update of the particles of a step, stretch by stretch as they get their velocity gradients: `begin`,
/// `update` for every stretch on any thread, `end`.
class MaterialStage {
 public:
  MaterialStage(State& state, const Activity& activity);

  /// Source of the internal energy of a particle.
  enum class Energy : std::uint8_t { by_work_identity, by_constitutive_model };

  /// Begins an update of all particles on the grid.
  /// @param stretches  number of stretches that follow
  void begin(Energy energy, std::size_t stretches);
  /// Updates the material of the particles of a stretch by their velocity gradients; by several threads at a time.
  void update(const transfer::Stretch& stretch);
  /// Updates the material of the particles that fly without the grid, hence without strain, and accounts for what the
  /// whole update did. Moves the time that it took from a stage of the profile to "material". Collective.
  /// @throws StateError on all ranks, if a state is undefined or out of range on any
  void end(std::string_view stage);

 private:
  using Clock = std::chrono::steady_clock;
  /// Sums over the particles of an update, by all threads.
  struct Sums {
    std::vector<MaterialReport> reports;                         // of each body
    std::vector<std::pair<std::uint32_t, double>> dissipations;  // J, by the first particle of each list
    std::vector<double> plastic_work;                            // J, of each stretch
    std::size_t limited_domains = 0, held_pressures = 0;
    Clock::duration in_material{};
  };
  /// What a body asks of its update.
  struct OfBody {
    UpdateSettings settings;
    bool deforms_domains;  // as domains::follow_deformation
  };
  double update(std::span<const std::uint32_t> particles, std::span<const Matrix3> gradients);
  [[nodiscard]] std::string account();

  State& state_;
  const Activity& activity_;
  Energy energy_ = Energy::by_work_identity;
  std::vector<OfBody> of_body_;
  Sums sums_;
  std::mutex mutex_;  // of `sums_`
};

}  // namespace whipple::solver

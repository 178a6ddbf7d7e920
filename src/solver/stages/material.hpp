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

/// The constitutive part of the step (docs/theory/material.md).
namespace whipple::solver {

/// Returns the settings of the constitutive update of a body in the current step.
UpdateSettings update_settings(const State& state, std::size_t body);
/// Returns which part of the artificial viscosity of particles heats in this case.
HeatingViscosity heating_viscosity(const State& state);

/// Describes a point of an update for a message, with the reason.
using DescribePoint = std::function<std::string(std::size_t point, const std::string& reason)>;

/// Accounts for the events of an update.
/// @returns an error that ends the run, or nothing
std::string book(State& state, const MaterialReport& report, const Material& material,
                 const DescribePoint& describe);

/// Collects points at the maximum density of their equation of state, by body. Whether these are single points or a
/// substantial part of the material is decided over all ranks, so that a run does not depend on their number.
class SqueezedPoints {
 public:
  explicit SqueezedPoints(std::size_t bodies) : counts_(4 * bodies), first_(bodies) {}
  void add(std::size_t body, const MaterialReport& report, const DescribePoint& describe);
  /// Returns an error that ends the run, about a point of this rank, or nothing. Collective.
  [[nodiscard]] std::string fault(MPI_Comm communicator,
                                  std::span<const std::shared_ptr<const Material>> materials);

 private:
  std::vector<double> counts_;  // of each body: number and mass of such points, and of all points
  // Describe the first such point of each body
  std::vector<std::function<std::string(const std::string& reason)>> first_;
};

/// Performs the constitutive update of the particles of a step, stretch by stretch as their velocity gradients become
/// available: `begin`, `update` for every stretch on any thread, `end`.
class MaterialStage {
 public:
  MaterialStage(State& state, const Activity& activity);

  /// Selects the source of the internal energy of a particle.
  enum class Energy : std::uint8_t { by_work_identity, by_constitutive_model };

  /// Begins an update of all particles on the grid.
  /// @param stretches  number of stretches that follow
  void begin(Energy energy, std::size_t stretches);
  /// Updates the material of the particles of a stretch from their velocity gradients. Thread-safe.
  void update(const transfer::Stretch& stretch);
  /// Updates the material of the particles in free flight, which have no strain, and accounts for the whole update.
  /// Moves its time from a stage of the profile to "material". Collective.
  /// @throws StateError on all ranks if a state on any rank is undefined or out of range
  void end(std::string_view stage);

 private:
  using Clock = std::chrono::steady_clock;
  /// Holds the irreversible energies of a list of particles (J), with its first particle.
  struct Irreversible {
    std::uint32_t first;
    double dissipation, plastic_heat, viscous_heat;
  };
  /// Holds sums over the particles of an update, by all threads.
  struct Sums {
    std::vector<MaterialReport> reports;     // of each body
    std::vector<Irreversible> irreversible;  // of each list
    std::vector<double> plastic_work;        // J, of each stretch
    std::size_t limited_domains = 0, held_pressures = 0;
    Clock::duration in_material{};
  };
  /// Holds the options of a body for its update.
  struct OfBody {
    UpdateSettings settings;
    bool deforms_domains;  // result of domains::follow_deformation
  };
  double update(std::span<const std::uint32_t> particles, std::span<const Matrix3> gradients);
  [[nodiscard]] std::string account();

  State& state_;
  const Activity& activity_;
  Energy energy_ = Energy::by_work_identity;
  std::vector<OfBody> of_body_;
  std::vector<double> lengths_;  // m, of the viscosity of each particle; empty: that of the finest cells
  Sums sums_;
  std::mutex mutex_;  // protects `sums_`
};

}  // namespace whipple::solver

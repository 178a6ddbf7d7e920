// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <memory>
#include <vector>

#include "src/solver/carriers/carrier.hpp"
#include "src/solver/device/device.hpp"
#include "src/solver/loads.hpp"
#include "src/solver/state.hpp"

namespace whipple::device {
struct Problem;
}

namespace whipple::solver {

struct Stages;

/// Represents one simulation in memory: state, carriers of the material and stages of a step. Every rank holds the
/// particles in its own blocks and a part of the elements; global quantities (time step, totals, ledger, errors) are
/// equal on all ranks. Constructors and `advance` are collective.
class Simulation {
 public:
  /// Creates the bodies of the case, on default_device().
  /// @throws InputError naming what the case asks for that a device does not compute, StateError without a device
  explicit Simulation(const cases::Case& setup, MPI_Comm communicator);
  /// Resumes from a checkpoint, or begins with its material if no step has been made.
  /// @param particles this rank's part, in any distribution
  /// @param meshes bodies of elements: on each rank any part of the nodes and elements, with corners as numbers of the
  /// nodes of all ranks
  /// @param bars   bodies of bars, in the same form
  Simulation(const cases::Case& setup, Particles particles, const RunState& state, MPI_Comm communicator,
             std::vector<fem::Mesh> meshes = {}, std::vector<fem::Bars> bars = {});
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  /// Returns the device that steps the particles; null without one.
  [[nodiscard]] DeviceStage* device() { return state_->device; }

  /// Advances by one step of the case's scheme, at most to the time `until` (s).
  /// @throws StateError with step, time, body, particle and state if a state is undefined or out of range, or if the
  /// energy error exceeds the case's limit
  void advance(double until);
  /// Adds a load to the existing ones, which include gravity.
  void add_load(Load load);

  [[nodiscard]] const cases::Case& setup() const { return state_->setup; }
  [[nodiscard]] MPI_Comm communicator() const { return state_->communicator; }
  [[nodiscard]] const RunState& state() const { return state_->run; }
  /// Returns the sums over all ranks.
  [[nodiscard]] const Totals& totals() const { return state_->totals; }
  /// Returns the bound that determined the last time step.
  [[nodiscard]] TimeStepBound time_step_bound() const { return state_->time_step_bound; }
  /// Returns what the load steps of a run without inertia needed.
  [[nodiscard]] const State::Equilibrium& equilibrium() const { return state_->equilibrium; }
  [[nodiscard]] const grid::BlockGrid& grid() const { return state_->grid; }
  [[nodiscard]] Profile& profile() { return state_->profile; }
  /// Returns the bodies as created; `first` and `count` are the present ones of this rank.
  [[nodiscard]] const std::vector<cases::BodySummary>& bodies() const { return state_->bodies; }
  /// Returns whether a body is continuous with its image at a face, as its velocity field is (docs/theory/mpm.md,
  /// section 3).
  [[nodiscard]] bool is_one_with_image(std::size_t body, std::size_t face) const;

  /// Returns this rank's parts of the carriers of the material, particles first.
  [[nodiscard]] std::vector<const Carrier*> carriers() const;
  /// Adds the phases of the bodies and the figures of this rank's material, which need no particles on the host.
  void add_figures(std::span<PhaseMasses> of_body, Figures& figures) const;
  /// Returns the particles of this rank.
  [[nodiscard]] const Particles& particles() const {
    synchronize();
    return state_->particles;
  }
  /// Returns the bodies of elements, without converted elements: this rank's part, with copies of the nodes that it
  /// shares with other ranks (src/fem/distribution.hpp).
  [[nodiscard]] const std::vector<fem::Mesh>& meshes() const;
  /// Returns the bodies of bars: this rank's part, with copies of shared nodes.
  [[nodiscard]] const std::vector<fem::Bars>& bars() const;
  /// Returns the data of a snapshot.
  [[nodiscard]] View view() const;
  /// Returns the data of a checkpoint. Collective.
  [[nodiscard]] Contents contents() const;
  /// Returns the number of particles of all ranks.
  [[nodiscard]] std::size_t particle_count() const { return state_->particle_count; }
  /// Returns the number of hexahedra of all ranks.
  [[nodiscard]] std::size_t element_count() const { return state_->element_count; }
  /// Returns the memory used by this rank, bytes.
  [[nodiscard]] std::size_t bytes() const;

  /// Returns the first time (s), not before the present one, at which loads or materials act on material at rest.
  [[nodiscard]] double next_event() const;
  /// Computes the time step (s) that the state allows, regardless of the previous step. Collective.
  [[nodiscard]] double accurate_time_step();
  /// Returns the minimum fraction of its cells that material above a pressure (Pa) fills; 1e300 if there is none. For
  /// tests. Collective.
  [[nodiscard]] double least_fill(double pressure);
  /// Describes the run as a device needs it; `device_faults` of its case must be empty.
  [[nodiscard]] device::Problem device_problem() const;

 private:
  void begin_accounts();
  /// Keeps the particles on a device from now on.
  void use(Device device);
  /// Fetches the particles from a device.
  void synchronize() const;

  std::unique_ptr<Stages> stages_;
  State* state_ = nullptr;  // owned by the stages
};

}  // namespace whipple::solver

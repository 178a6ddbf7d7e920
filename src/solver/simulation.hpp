// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <memory>
#include <vector>

#include "src/solver/carriers/carrier.hpp"
#include "src/solver/loads.hpp"
#include "src/solver/state.hpp"

namespace whipple::solver {

struct Stages;

/// One simulation in memory: state, carriers of the material and stages of a step. Every rank holds the particles in
/// its own blocks and a part of the elements; whatever concerns the whole (time step, totals, ledger, errors) is the
/// same on all ranks. Constructors and `advance` are collective.
class Simulation {
 public:
  /// Seeds the bodies of the case.
  explicit Simulation(const cases::Case& setup, MPI_Comm communicator);
  /// Goes on from a checkpoint.
  /// @param particles the part of this rank, any part
  /// @param meshes of the bodies of elements: on each rank any part of the nodes and elements, the corners being
  /// numbers of the nodes of all ranks
  /// @param bars   of the bodies of bars, the same
  Simulation(const cases::Case& setup, Particles particles, const RunState& state, MPI_Comm communicator,
             std::vector<fem::Mesh> meshes = {}, std::vector<fem::Bars> bars = {});
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  /// Advances one step of the case's scheme; not beyond `until` (s).
  /// @throws StateError with step, time, body, particle and state if a state is undefined or out of range, or if the
  /// energy error exceeds the case's limit
  void advance(double until);
  /// Adds a load to those that act already, gravity among them.
  void add_load(Load load);

  [[nodiscard]] const cases::Case& setup() const { return state_->setup; }
  [[nodiscard]] MPI_Comm communicator() const { return state_->communicator; }
  [[nodiscard]] const RunState& state() const { return state_->run; }
  /// Returns the sums over all ranks.
  [[nodiscard]] const Totals& totals() const { return state_->totals; }
  /// Returns the bound that determined the last time step.
  [[nodiscard]] TimeStepBound time_step_bound() const { return state_->time_step_bound; }
  [[nodiscard]] const grid::BlockGrid& grid() const { return state_->grid; }
  [[nodiscard]] Profile& profile() { return state_->profile; }
  /// Returns the bodies as seeded; `first` and `count` are those of this rank now.
  [[nodiscard]] const std::vector<cases::BodySummary>& bodies() const { return state_->bodies; }
  /// Returns whether a body is one with its image at a face, as the field that it moves in is (docs/theory/mpm.md, 3).
  [[nodiscard]] bool is_one_with_image(std::size_t body, std::size_t face) const;

  /// Returns what carries the material, particles first: the parts of this rank.
  [[nodiscard]] std::vector<const Carrier*> carriers() const;
  /// Returns the particles of this rank.
  [[nodiscard]] const Particles& particles() const { return state_->particles; }
  /// Returns the bodies of elements, as far as they are still elements: the part of this rank, with copies of the
  /// nodes that it shares with other ranks (src/fem/distribution.hpp).
  [[nodiscard]] const std::vector<fem::Mesh>& meshes() const;
  /// Returns the bodies of bars, the same.
  [[nodiscard]] const std::vector<fem::Bars>& bars() const;
  /// Returns what a snapshot is written from.
  [[nodiscard]] View view() const;
  /// Returns what a checkpoint is written from. Collective.
  [[nodiscard]] Contents contents() const;
  /// Returns the number of particles of all ranks.
  [[nodiscard]] std::size_t particle_count() const { return state_->particle_count; }
  /// Returns the number of hexahedra of all ranks.
  [[nodiscard]] std::size_t element_count() const { return state_->element_count; }
  /// Returns the memory of this rank.
  [[nodiscard]] std::size_t bytes() const;

  /// Returns the first time (s), from now on, at which loads or materials act on material at rest.
  [[nodiscard]] double next_event() const;
  /// Computes the time step (s) that the state allows, whatever the step before it was. Collective.
  [[nodiscard]] double accurate_time_step();
  /// Returns the least fraction of its cells that material of more than a pressure (Pa) fills, 1e300 without any: a
  /// look at the run, for tests. Collective.
  [[nodiscard]] double least_fill(double pressure);

 private:
  std::unique_ptr<Stages> stages_;
  State* state_ = nullptr;  // of the stages
};

}  // namespace whipple::solver

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "src/case/build/seeding.hpp"
#include "src/case/case.hpp"
#include "src/contact/first_touches.hpp"
#include "src/core/base/words.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/solver/ledger.hpp"
#include "src/solver/profile.hpp"
#include "src/transfer/shape_function.hpp"
#include "src/transfer/transition_nodes.hpp"

namespace whipple::solver {

/// Bound that determined a time step (docs/theory/mpm.md, section 6).
enum class TimeStepBound : std::uint8_t {
  none,
  sound_speed,
  diffusion,
  elements,
  acceleration,
  compression,
  first_step,
  growth,
  first_touch,
  output_time
};
constexpr std::array<Word<TimeStepBound>, 10> words(TimeStepBound) {
  using enum TimeStepBound;
  return {{{none, "none yet"},
           {sound_speed, "sound speed and velocity in a cell"},
           {diffusion, "diffusion of momentum or heat"},
           {elements, "elements"},
           {acceleration, "maximum acceleration"},
           {compression, "volumetric strain rate"},
           {first_step, "first step"},
           {growth, "growth since the last step"},
           {first_touch, "first touch of bodies"},
           {output_time, "time of output or end"}}};
}

/// What the next step needs to know of the force that keeps the velocity of a driven body.
struct DrivenBody {
  Vector3 velocity = Vector3::Zero();      ///< m/s, mean of the body at the beginning of the last step
  Vector3 acceleration = Vector3::Zero();  ///< m/s^2, by the force in that step
  double time_step = 0.0;                  ///< s, of that step; 0: there was none
};

/// Holds the state of a run that changes with time, apart from what the carriers hold; what a checkpoint must hold.
struct RunState {
  double time = 0.0;                  ///< s
  double time_step = 0.0;             ///< s, of the last step; 0 before the first
  double unclipped_step = 0.0;        ///< s, the same if it had not been shortened to meet a time
  double largest_step = 0.0;          ///< s, in which nothing crossed more than a cell, the longest so far
  double maximum_acceleration = 0.0;  ///< m/s^2, in the last step
  double compression_rate =
      0.0;  ///< 1/s, that all but a thousandth of the material under pressure kept below
  double squeezed_beside_voids = 0.0;  ///< kg, intact, under pressure in cells that it does not fill
  double first_touch = 1e300;  ///< s, at which bodies that have not touched yet next do; 1e300: not in sight
  contact::FirstTouches::Words touched;  ///< what has
  double releasable_energy = 0.0;        ///< J, that the materials could set free at the start
  double reference_speed = 0.0;          ///< m/s, of the start: of what moved, and what that energy can make
  std::int64_t step = 0;
  std::int64_t particles_at_rest = 0;  ///< of all ranks, left as they were by the last step
  Ledger ledger;
  std::vector<BodyOutflow> outflow_of_body;  ///< of each body, of all ranks
  std::vector<DrivenBody> driven;            ///< of each body
};

/// Holds what several stages of a step read and write, on one rank. Every stage keeps what it alone needs.
struct State {
  State(const cases::Case& setup, MPI_Comm communicator, const RunState& run);

  cases::Case setup;
  transfer::ShapeFunction shape;  ///< that of the case, in two dimensions its planar form
  MPI_Comm communicator;
  grid::BlockGrid grid;
  Particles particles;                         ///< of this rank
  std::vector<cases::BodySummary> bodies;      ///< as seeded; `first` and `count` are those of this rank now
  transfer::TransitionNodes transition;        ///< nodes of elements that move with the grid in this step
  std::vector<std::uint32_t> transition_body;  ///< of each of these nodes
  std::vector<double> initial_density;         ///< kg/m^3, of each body
  RunState run;
  TimeStepBound time_step_bound = TimeStepBound::none;  ///< that determined the last step
  Totals totals;                                        ///< over all ranks, at the end of the last step
  std::size_t particle_count = 0, element_count = 0;    ///< of all ranks
  Ledger booked;                                        ///< what happened on this rank in the step under way
  std::vector<BodyOutflow> booked_outflow;              ///< the same, of each body
  /// Largest rates in the step under way: what the next time step depends on.
  struct Rates {
    double squared_change = 0.0;       ///< m^2/s^2, of a particle's velocity
    double compression = 0.0;          ///< 1/s, of particles under pressure
    double element_compression = 0.0;  ///< 1/s, of elements under pressure
  } rates;
  Profile profile;

  /// Returns the shape functions of forces, velocities and their gradients.
  [[nodiscard]] transfer::ShapeFunctions functions() const { return {shape, setup.transfer.slope_smoothing}; }
  /// Returns the inertia per mass (m^2) of affine fields by this shape function; 0 if it cannot carry them.
  [[nodiscard]] double affine_inertia() const;
  /// Returns the inertia per mass (m^2) of the affine fields that particles of this case carry; 0 without such fields.
  [[nodiscard]] double particle_affine_inertia() const;
  /// Returns whether particles of this case carry affine fields.
  [[nodiscard]] bool carries_affine_fields() const {
    return cases::is_affine(setup.transfer.particle_update);
  }
  /// Returns whether kinetic energy lost in transfers is kept as unresolved energy.
  [[nodiscard]] bool keeps_losses() const { return setup.dissipation.keeps_losses(); }
  [[nodiscard]] bool is_parallel() const { return parallel::size(communicator) > 1; }

  /// Finds the ranges of the bodies; particles are sorted by body.
  void find_bodies();
  /// Counts the part of a body that left the domain.
  void book_outflow(std::size_t body, const Totals& outflow);
  /// Counts the part of a body that left the domain, by the totals of the body before and after.
  void book_outflow(std::size_t body, const Totals& before, Totals after);
  /// Describes a particle at a time (s) for an error message; the step is the one under way.
  [[nodiscard]] std::string describe_particle(std::size_t particle, double time,
                                              const std::string& reason) const;
};

}  // namespace whipple::solver

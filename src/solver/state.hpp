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
#include "src/solver/force_gauges.hpp"
#include "src/solver/ledger.hpp"
#include "src/solver/profile.hpp"
#include "src/transfer/shape_function.hpp"
#include "src/transfer/transition_nodes.hpp"

namespace whipple::solver {

/// Lists the bounds that may determine a time step (docs/theory/mpm.md, section 6).
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
  output_time,
  load_step,
  cut_back
};
constexpr std::array<Word<TimeStepBound>, 12> words(TimeStepBound) {
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
           {output_time, "time of output or end"},
           {load_step, "load step"},
           {cut_back, "load step cut back"}}};
}

/// Holds the data of the last step from which the force on a driven body is computed (equation 3.5a).
struct DrivenBody {
  Vector3 velocity = Vector3::Zero();  ///< mean velocity of the body at the beginning of the last step, m/s
  Vector3 acceleration = Vector3::Zero();       ///< by the driving force in that step, m/s^2
  Vector3 spin = Vector3::Zero();               ///< about its centre of mass at that time, rad/s
  Vector3 spin_acceleration = Vector3::Zero();  ///< by the driving force in that step, rad/s^2
  double time_step = 0.0;                       ///< of that step, s; 0: no step yet
};

/// Holds the state of a run that changes with time, apart from the data of the carriers; saved in checkpoints.
struct RunState {
  double time = 0.0;                  ///< s
  double time_step = 0.0;             ///< of the last step, s; 0 before the first one
  double unclipped_step = 0.0;        ///< of the last step without shortening to meet a time, s
  double largest_step = 0.0;          ///< longest step so far in which nothing crossed more than a cell, s
  double maximum_acceleration = 0.0;  ///< in the last step, m/s^2
  /// Exceeded by material under pressure of at most a thousandth of the mass, 1/s.
  double compression_rate = 0.0;
  /// Mass of intact material under pressure in cells that it does not fill, kg.
  double squeezed_beside_voids = 0.0;
  double first_touch = 1e300;            ///< predicted time of the next first contact, s; 1e300: none
  contact::FirstTouches::Words touched;  ///< fields that have touched
  double releasable_energy = 0.0;        ///< energy that the materials could release at the start, J
  /// Maximum initial speed plus the speed that this energy per mass can produce, m/s.
  double reference_speed = 0.0;
  std::int64_t step = 0;
  std::int64_t particles_at_rest = 0;  ///< of all ranks, in inactive blocks in the last step
  Ledger ledger;
  std::vector<BodyOutflow> outflow_of_body;  ///< of each body, over all ranks
  std::vector<DrivenBody> driven;            ///< of each body
  std::vector<GaugedImpulse> gauged;         ///< of each force gauge, over all ranks, since the start
  std::vector<double> loaded_mass;  ///< on which the force of each load acts at the start, kg; 0: no force
};

class DeviceStage;

/// Holds the data that several stages of a step read and write, on one rank. Data of a single stage are kept there.
struct State {
  State(const cases::Case& setup, MPI_Comm communicator, const RunState& run);

  cases::Case setup;
  transfer::ShapeFunction shape;  ///< that of the case; in two dimensions its planar form
  MPI_Comm communicator;
  grid::BlockGrid grid;
  Particles particles;  ///< of this rank
  /// As created; `first` and `count` are the present ones of this rank.
  std::vector<cases::BodySummary> bodies;
  transfer::TransitionNodes transition;        ///< nodes of elements that move with the grid in this step
  std::vector<std::uint32_t> transition_body;  ///< body of each of these nodes
  std::vector<std::uint8_t> transition_part;  ///< part of it with a field of its own (ContactFields::of_part)
  std::vector<double> initial_density;        ///< of each body, kg/m^3
  RunState run;
  TimeStepBound time_step_bound = TimeStepBound::none;  ///< of the last step
  Totals totals;                                        ///< over all ranks, at the end of the last step
  std::size_t particle_count = 0, element_count = 0;    ///< of all ranks
  Ledger booked;                                        ///< contributions of the current step on this rank
  std::vector<BodyOutflow> booked_outflow;  ///< outflow of each body in the current step on this rank
  ForceGauges force_gauges;
  /// Maximum rates of the current step, which bound the next one.
  struct Rates {
    double squared_change = 0.0;       ///< squared change of a particle's velocity, m^2/s^2
    double compression = 0.0;          ///< of particles under pressure, 1/s
    double element_compression = 0.0;  ///< of elements under pressure, 1/s
  } rates;
  /// Holds what load steps without inertia needed.
  struct Equilibrium {
    double iterations = 0.0;        ///< of Newton's method since the start of this program
    std::vector<double> residuals;  ///< of the last step, relative: before each iteration and after the last

    [[nodiscard]] double residual() const { return residuals.empty() ? 0.0 : residuals.back(); }
  } equilibrium;
  Profile profile;
  DeviceStage* device = nullptr;  ///< that steps the particles; null: the stages do

  /// Returns the shape functions of forces, velocities and their gradients.
  [[nodiscard]] transfer::ShapeFunctions functions() const { return {shape, setup.transfer.slope_smoothing}; }
  /// Returns the inertia per mass (m^2) of affine fields with this shape function in the finest cells; 0 if it does not
  /// support them.
  [[nodiscard]] double affine_inertia() const;
  /// Returns the inertia per mass (m^2) of the affine fields that particles of this case carry; 0 without such fields.
  [[nodiscard]] double particle_affine_inertia() const;
  /// Returns that of a particle by its place.
  [[nodiscard]] AffineInertia inertia_of_particles() const {
    return {particle_affine_inertia(), grid.geometry()};
  }
  /// Returns whether a place has functions of the small cells only (docs/theory/levels.md): all places, with one size.
  [[nodiscard]] bool is_in_small_cells(const Vector3& position) const {
    return !(grid.geometry().blend(position).fine < 1.0);
  }
  /// Returns the edge of the cells around a particle, m.
  [[nodiscard]] double cell_size_at(std::size_t particle) const {
    return grid.geometry().cell_size_at(particles.position[particle]);
  }
  /// Returns whether particles of this case carry affine fields.
  [[nodiscard]] bool carries_affine_fields() const {
    return cases::is_affine(setup.transfer.particle_update);
  }
  /// Returns whether kinetic energy lost in transfers is kept as unresolved energy.
  [[nodiscard]] bool keeps_losses() const { return setup.dissipation.keeps_losses(); }
  [[nodiscard]] bool is_parallel() const { return parallel::size(communicator) > 1; }

  /// Determines the ranges of the bodies; requires that particles are sorted by body.
  void find_bodies();
  /// Accounts for a part of a body that has left the domain.
  void book_outflow(std::size_t body, const Totals& outflow);
  /// Accounts for a part of a body that has left the domain, from the totals of the body before and after.
  void book_outflow(std::size_t body, const Totals& before, Totals after);
  /// Describes a particle at a time (s) of the current step for an error message.
  [[nodiscard]] std::string describe_particle(std::size_t particle, double time,
                                              const std::string& reason) const;
};

}  // namespace whipple::solver

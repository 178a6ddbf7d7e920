// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "src/contact/contact.hpp"
#include "src/fem/bars.hpp"
#include "src/fem/distribution.hpp"
#include "src/fem/mesh.hpp"
#include "src/fem/step.hpp"
#include "src/grid/block_grid.hpp"
#include "src/material/update.hpp"
#include "src/particles/particles.hpp"
#include "src/case/case.hpp"
#include "src/case/build/seeding.hpp"
#include "src/solver/ledger.hpp"
#include "src/solver/profile.hpp"
#include "src/transfer/conduction.hpp"
#include "src/transfer/first_touches.hpp"
#include "src/transfer/full_mass_matrix.hpp"
#include "src/transfer/grid_to_particles.hpp"
#include "src/transfer/grid_update.hpp"
#include "src/transfer/shape_function.hpp"
#include "src/transfer/shock_conduction.hpp"
#include "src/transfer/transition_nodes.hpp"

namespace whipple::solver {

/// State of a run that changes with time, apart from the particles; what a checkpoint must hold.
struct RunState {
  double time = 0.0;                  ///< s
  double time_step = 0.0;             ///< s, of the last step; 0 before the first
  double unclipped_step = 0.0;        ///< s, the same if it had not been shortened to meet a time
  double maximum_acceleration = 0.0;  ///< m/s^2, in the last step
  double compression_rate = 0.0;  ///< 1/s, that all but a thousandth of the material under pressure kept below
  double squeezed_beside_voids = 0.0;  ///< kg, intact, under pressure in cells that it does not fill
  double first_touch = 1e300;  ///< s, at which bodies that have not touched yet next do; 1e300: not in sight
  transfer::FirstTouches::Words touched;  ///< what has
  std::int64_t step = 0;
  std::int64_t particles_at_rest = 0;  ///< of all ranks, left as they were by the last step
  Ledger ledger;
  std::vector<BodyOutflow> outflow_of_body;  ///< of each body, of all ranks
};

/// One simulation in memory: particles, grid, materials, ledger. The schemes are functions of it. Every rank
/// holds the particles in its own blocks and a share of the elements; whatever concerns the whole (time step,
/// totals, ledger, errors) is the same on all ranks. Constructors and `advance` are collective.
class Simulation {
 public:
  /// Seeds the bodies of the case.
  explicit Simulation(const cases::Case& setup, MPI_Comm communicator);
  /// Goes on from a checkpoint.
  /// @param particles the share of this rank, any share
  /// @param meshes of the bodies of elements: on each rank any share of nodes and elements, the corners being
  /// numbers of the nodes of all ranks
  /// @param bars   of the bodies of bars, the same
  Simulation(const cases::Case& setup, Particles particles, const RunState& state, MPI_Comm communicator,
             std::vector<fem::Mesh> meshes = {}, std::vector<fem::Bars> bars = {});

  /// Advances one step of the case's scheme; not beyond `until` (s).
  /// @throws StateError with step, time, body, particle and state if a state is undefined or out of range, or
  /// if the
  ///         energy error exceeds the case's limit
  void advance(double until);

  /// An acceleration by external forces (m/s^2), asked for every particle at the beginning of each step: its
  /// index in `particles()`, and the time. For manufactured solutions.
  using Acceleration = std::function<Vector3(const Particles& particles, std::size_t p, double time)>;
  /// Adds one to those that act already, gravity among them. On particles only.
  void add_acceleration(Acceleration acceleration) { accelerations_.push_back(std::move(acceleration)); }

  [[nodiscard]] const cases::Case& setup() const { return setup_; }
  /// The particles of this rank.
  [[nodiscard]] const Particles& particles() const { return particles_; }
  /// Number of particles of all ranks.
  [[nodiscard]] std::size_t particle_count() const { return particle_count_; }
  /// The bodies of elements, as far as they are still elements: the share of this rank, with copies of the
  /// nodes that it shares with other ranks (src/fem/distribution.hpp).
  [[nodiscard]] const std::vector<fem::Mesh>& meshes() const { return meshes_; }
  /// Returns the meshes as a checkpoint holds them. Collective.
  [[nodiscard]] std::vector<fem::Mesh> meshes_for_checkpoint() const;
  /// The bars, all on one rank. Collective.
  [[nodiscard]] std::vector<fem::Bars> bars_for_checkpoint() const;
  /// Number of elements of all ranks.
  [[nodiscard]] std::size_t element_count() const { return element_count_; }
  /// The bodies of bars: the share of this rank, with copies of the nodes that it shares with other ranks.
  [[nodiscard]] const std::vector<fem::Bars>& bars() const { return bars_; }
  [[nodiscard]] const RunState& state() const { return state_; }
  /// Sums over all ranks.
  [[nodiscard]] const Totals& totals() const { return totals_; }
  [[nodiscard]] const grid::BlockGrid& grid() const { return grid_; }
  /// Returns whether a body is one with its image at a face, as the field that it moves in is (docs/theory/mpm.md, 3).
  [[nodiscard]] bool is_one_with_image(std::size_t body, std::size_t face) const;
  /// The bodies as seeded; `first` and `count` are those of this rank now.
  [[nodiscard]] const std::vector<cases::BodySummary>& bodies() const { return bodies_; }
  [[nodiscard]] MPI_Comm communicator() const { return communicator_; }
  [[nodiscard]] Profile& profile() { return profile_; }
  /// Least fraction of its cells that material of more than a pressure (Pa) fills, 1e300 without any: a look at
  /// the run, for tests. Collective.
  [[nodiscard]] double least_fill(double pressure);
  /// Time step (s) that the state allows, whatever the step before it was. Collective.
  [[nodiscard]] double accurate_time_step();
  /// Memory of this rank.
  [[nodiscard]] std::size_t bytes() const;

 private:
  friend void step_symplectic(Simulation& s, double until);
  friend void step_usf(Simulation& s, double until);
  friend void step_usl(Simulation& s, double until);
  friend void step_musl(Simulation& s, double until);

  // The calls of the schemes, in the order of the step.
  void adapt_elements();
  [[nodiscard]] double stable_time_step();
  [[nodiscard]] double landing_on_touch(double dt) const;
  void watch_touches();
  void foresee_touches();
  [[nodiscard]] double grid_time_step();
  [[nodiscard]] double element_time_step() const;
  [[nodiscard]] double diffusive_time_step() const;
  [[nodiscard]] double compression_rate_of_most(double largest) const;
  void begin_step(double until);
  void split_particles();
  void compute_element_forces();
  void bin_particles();
  void conduct_heat();
  void conduct_in_shocks();
  void map_particles_to_grid();
  void advance_grid();
  void map_grid_to_particles();
  void advance_elements();
  void update_particle_velocity();
  void update_velocity_and_material();
  void map_momentum_to_grid();
  void update_material();
  void reflect_and_remove();
  void end_step();

  void prepare();
  void require_fields() const;
  void set_up_contact();
  [[nodiscard]] std::vector<double> least_relaxation_rates() const;
  void set_up_dissipation();
  void separate_fields();
  void look_at_fill();
  void find_surfaces(bool after_transfer);
  [[nodiscard]] transfer::TouchAtNode touch_at_node() const;
  void set_up_walls();
  [[nodiscard]] bool may_meet_images() const;
  void find_surfaces_at_walls();
  void apply_contact();
  void finish_exchange();
  void gather_velocity(const transfer::TakeGradients& take);
  void convert_elements();
  void add_gravity(fem::Nodes& nodes) const;
  void book_gravity(const fem::Nodes& nodes, const fem::Motion& motion);
  void set_up_bars();
  [[nodiscard]] std::size_t bar_node_count() const;
  void collect_nodes();
  void compute_bar_forces();
  void advance_bars();
  void remove_bars_outside();
  /// Books the part of a body that left the domain.
  void book_outflow(std::size_t body, const Totals& outflow);
  /// Books the part of a body that left the domain, by the totals of the body before and after.
  void book_outflow(std::size_t body, const Totals& before, Totals after);
  void remove_elements_outside();
  void warn_of_contact() const;
  bool bin(grid::Stencil stencil);
  void sum_over_ranks();
  [[nodiscard]] std::function<bool(std::size_t)> stays_since(std::size_t& arrangement) const;
  void follow_particles(grid::Stencil stencil);
  void find_bodies();
  void keep_own_elements();
  void gather_elements();
  void share_out_elements();
  void elements_removed();
  void join_shared_nodes();
  fem::ConstraintBalance advance_free_nodes(std::size_t mesh);
  void sort_particles();
  void particles_reallocated();
  enum class EnergyUpdate { by_work_identity, by_constitutive_model };
  void update_material_with(std::string_view stage, EnergyUpdate energy,
                            const std::function<void(const transfer::TakeGradients&)>& gather);
  [[nodiscard]] UpdateSettings update_settings(std::size_t body) const;
  [[nodiscard]] std::string deform_elements(std::size_t mesh, bool heated);
  [[nodiscard]] std::string book(const MaterialReport& report, const Material& material,
                                 const std::function<std::string(std::size_t, const std::string&)>& describe);
  [[nodiscard]] std::size_t deform_domains(std::span<const std::uint32_t> particles,
                                           std::span<const Matrix3> gradients);
  [[nodiscard]] bool follows_domains() const;
  [[nodiscard]] bool carries_extent() const;
  [[nodiscard]] bool carries_affine_velocity() const;
  void shift_grid();
  void find_free_flight();
  [[nodiscard]] bool is_restless(std::size_t particle) const;
  [[nodiscard]] bool matter_may_rest() const;
  [[nodiscard]] int layers_ahead_of_motion() const;
  void let_matter_rest();
  [[nodiscard]] double affine_inertia() const;
  [[nodiscard]] double particle_affine_inertia() const;
  /// @param time  s, of the state; the step is the one under way
  [[nodiscard]] std::string describe_state(std::size_t particle, double time,
                                           const std::string& reason) const;
  [[nodiscard]] std::string describe_element(const fem::Mesh& mesh, std::size_t point,
                                             const std::string& reason) const;

  cases::Case setup_;
  transfer::ShapeFunction shape_;
  MPI_Comm communicator_;
  Particles particles_;
  std::vector<fem::Mesh> meshes_;
  std::vector<fem::Bars> bars_;
  std::vector<cases::BodySummary> bodies_;
  grid::BlockGrid grid_;
  transfer::GridUpdate grid_update_;
  transfer::FullMassMatrix full_mass_matrix_;
  std::optional<contact::Contact> contact_;  // if bodies have velocity fields of their own
  std::vector<std::uint8_t> contact_field_of_body_;
  std::unique_ptr<transfer::FirstTouches> first_touches_;
  double accurate_step_ = 0.0;   // s, that the state allows, in the step under way
  bool compression_is_followed_ = true;  // by that step, as `time.compression_limit` asks
  bool surfaces_found_ = false;  // in the step under way
  int looks_at_voids_ = 0;       // one after the other that found much material squeezed beside voids
  bool warned_of_voids_ = false;
  std::vector<std::uint8_t> contact_field_;              // of each particle
  std::vector<std::vector<fem::Facet>> surface_facets_;  // of each mesh
  bool surfaces_changed_ = true;                         // since they were found
  contact::SurfacePoints surface_points_;
  std::vector<double> initial_density_;                          // kg/m^3, of each body
  std::vector<transfer::ShockConductivity> shock_conductivity_;  // of each body
  transfer::Losses losses_;
  RunState state_;
  Ledger step_;  // what happened on this rank in the step under way
  std::vector<BodyOutflow> step_outflow_;  // the same
  Totals totals_;
  template <class Value>
  struct KeptByChunk {
    std::vector<Value> values;
    std::size_t arrangement = 0;  // of the particles then
  };
  KeptByChunk<Totals> totals_of_chunk_;
  KeptByChunk<double> fastest_of_chunk_;  // sound speed and velocity, m/s
  std::size_t particle_count_ = 0, element_count_ = 0;
  Profile profile_;
  double squared_change_ = 0.0;    // m^2/s^2, the largest of a particle's velocity in the step under way
  double compression_rate_ = 0.0;  // 1/s, the largest of particles under pressure in the step under way
  double element_compression_rate_ = 0.0;  // 1/s, the same of elements
  std::vector<Acceleration> accelerations_;
  std::vector<Vector3> external_acceleration_;      // of this step; empty without external forces
  std::vector<std::uint32_t> flying_;               // particles that fly without the grid in this step
  std::vector<std::uint32_t> by_stencil_, sorted_;  // of the last sort; their memory is kept for the next
  SortBuffers sort_buffers_;
  std::vector<double> work_;              // of the particles (and elements) for the shares of the ranks
  std::int64_t most_at_rest_ = 0;         // since the blocks were shared out among the ranks
  transfer::TransitionNodes transition_;  // nodes of elements that move with the grid in this step
  fem::SharedNodes shared_nodes_;
  std::vector<std::array<double, 5>> shared_;  // force (N), mass (kg), sound speed of all copies of each
  bool elements_astray_ = false;               // the forest was divided anew since elements were
  // Of each mesh, in the step under way:
  std::vector<fem::Motion> motions_;
  std::vector<std::vector<double>> node_heat_;
  std::vector<fem::VelocityGradients> element_gradient_;
};

/// Symplectic scheme with exact energy (docs/theory/mpm.md, section 4).
void step_symplectic(Simulation& s, double until);
/// Update stress first (Bardenhagen, J. Comput. Phys. 180 (2002) 383; docs/theory/mpm.md, 5).
void step_usf(Simulation& s, double until);
/// Update stress last (Sulsky, Chen & Schreyer, Comput. Methods Appl. Mech. Eng. 118 (1994) 179;
/// docs/theory/mpm.md, 5).
void step_usl(Simulation& s, double until);
/// Modified update stress last (Sulsky, Zhou & Schreyer, Comput. Phys. Commun. 87 (1995) 236;
/// docs/theory/mpm.md, 5).
void step_musl(Simulation& s, double until);

}  // namespace whipple::solver

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "src/fem/bars.hpp"
#include "src/fem/mesh.hpp"
#include "src/solver/phase_masses.hpp"
#include "src/solver/state.hpp"

namespace whipple::solver {

/// Holds the data of a checkpoint.
struct Contents {
  const Particles* particles = nullptr;
  std::vector<fem::Mesh> meshes;  ///< each node on one rank only; corners numbered over all ranks
  std::vector<fem::Bars> bars;    ///< all on one rank
};

/// Holds the data of a snapshot: this rank's part, valid until the next step.
struct View {
  const Particles* particles = nullptr;
  std::span<const fem::Mesh> meshes;
  std::span<const fem::Bars> bars;
};

/// Holds maxima and sums over a part of the material for the history (SI units).
struct Figures {
  double speed = 0.0;
  double pressure = -std::numeric_limits<double>::infinity();
  double temperature = -std::numeric_limits<double>::infinity();
  double stored_cold_work = 0.0;  ///< J
  double elastic_energy = 0.0,
         stored_energy = 0.0;    ///< J (material::Constitutive::divide_energy); of bars too
  double chemical_energy = 0.0;  ///< of unburnt explosive, J
  double bars = 0.0, broken_bars = 0.0, bar_energy = 0.0;  ///< numbers of bars, and their energy, J
};

/// Holds the energy that material can release: internal energy above the zero of its equation of state, including that
/// of unburnt explosive, and four times the elastic energy of its pressure.
struct Releasable {
  double energy = 0.0;   ///< in total, J
  double largest = 0.0;  ///< maximum per mass, J/kg
};

/// Describes a particle or a node of elements.
struct Point {
  std::size_t body;
  const Vector3 &position, &velocity;  ///< m, m/s
  double sound_speed;                  ///< m/s; for nodes that of the reference state
  bool is_stressed;                    ///< pressure above a millionth of rho c^2; nodes have none
  double mass;                         ///< kg; of a node on several ranks the contribution of this one
};

/// Describes a particle, or one of the eight particles that an element may become, as sampled by gauges.
struct Part {
  std::uint64_t id;
  Vector3 position, velocity;    ///< m, m/s
  double mass, volume;           ///< kg, m^3
  const MaterialPoints& points;  ///< the state is at index `p`
  std::size_t p;
};
/// Selects elements by number, centre (m) and maximum distance of a corner from the centre (m).
using SelectElement = std::function<bool(std::uint64_t element, const Vector3& centre, double reach)>;

/// Interface of the carriers of the material of bodies: particles, hexahedra, trusses; each rank holds its part of
/// them. Stages loop over the carriers of a run, which are those that the case has.
class Carrier {
 public:
  explicit Carrier(State& state) : state_(state) {}
  Carrier(const Carrier&) = delete;
  Carrier& operator=(const Carrier&) = delete;
  virtual ~Carrier() = default;

  /// Returns whether the case has no such bodies; equal on all ranks.
  [[nodiscard]] virtual bool empty() const = 0;

  /// @name In the order of the step
  /// @{ Computes the forces on the carrier's nodes, including loads. Particles have stresses instead.
  virtual void compute_forces() {}
  /// Appends the nodes that move with the grid in this step to `State::transition`.
  virtual void collect() {}
  /// Combines the forces, masses and sound speeds of nodes that exist on several ranks. Collective.
  virtual void join_shared_nodes() {}
  /// Returns the stable time step (s) from the stiffness of this rank's elements; infinite without elements.
  [[nodiscard]] virtual double critical_time_step() const { return std::numeric_limits<double>::infinity(); }
  /// Moves nodes, freely or with the motion of the grid, and updates strain, work, heat and stress of their elements.
  /// @returns an error that ends the run, or nothing
  virtual std::string advance() { return {}; }
  /// Removes material outside of the domain and counts it as outflow. Collective.
  virtual void remove_outside() = 0;
  /// @}

  /// @name Sums over this rank's part
  /// @{
  virtual void add_totals(Totals& sum) = 0;
  virtual void add_phases(std::span<PhaseMasses> of_body) const = 0;
  virtual void add_figures(Figures& figures) const = 0;
  /// Returns the largest speed (m/s) of a particle or node relative to a velocity (m/s).
  [[nodiscard]] virtual double largest_speed(const Vector3& frame) = 0;
  /// Adds the energy that the material can release.
  virtual void add_releasable(Releasable& /*sum*/) const {}
  [[nodiscard]] virtual std::size_t particle_count() const { return 0; }
  [[nodiscard]] virtual std::size_t element_count() const { return 0; }
  /// Returns the largest id of an existing particle, or of one that an element may become.
  [[nodiscard]] virtual std::uint64_t largest_particle_id() const { return 0; }
  [[nodiscard]] virtual std::size_t bytes() const = 0;
  /// Returns the mass (kg) of the particles or nodes in a region.
  [[nodiscard]] virtual double mass_in(const cases::LoadedRegion& region) const = 0;
  /// Visits every particle or node.
  virtual void for_each_point(const std::function<void(const Point& point)>& visit) const = 0;
  /// Visits all particles, or the eight parts of the selected elements.
  virtual void for_each_part(const SelectElement& /*select*/,
                             const std::function<void(const Part& part)>& /*visit*/) const {}
  /// Describes this carrier's part of a body by its numbers over all ranks; empty if it has none. Collective.
  [[nodiscard]] virtual std::string count_text(std::size_t body) const = 0;
  /// @}

  /// @name Ranks and files
  /// @{ Reduces the data, which all ranks hold at the start, to this rank's part. Collective.
  virtual void keep_share() {}
  /// Gathers the data that this rank needs after each rank has read any part of a checkpoint. Collective.
  virtual void gather() {}
  /// Sends elements to the ranks that own the blocks of their centres. Collective.
  virtual void share_out() {}
  /// Returns whether its elements count as work in the distribution of the blocks.
  [[nodiscard]] virtual bool weighs() const { return false; }
  /// Appends the centres (m) and the work of the elements.
  virtual void add_work(std::vector<Vector3>& /*centres*/, std::vector<double>& /*work*/) const {}
  /// Adds the data of a checkpoint. Collective.
  virtual void save(Contents& contents) const = 0;
  virtual void show(View& view) const = 0;
  /// @}

 protected:
  State& state_;
};

/// Carriers of a run that have bodies, particles first.
using Carriers = std::vector<Carrier*>;

}  // namespace whipple::solver

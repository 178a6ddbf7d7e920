// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "src/core/parallel/mpi.hpp"
#include "src/grid/geometry.hpp"
#include "src/particles/particles.hpp"

/// Accounts of the conserved quantities: their sums and all contributions to their change.
namespace whipple::solver {

/// Holds sums over a set of particles and elements (SI units).
struct Totals {
  double mass = 0.0;
  Vector3 momentum = Vector3::Zero();
  double momentum_scale = 0.0;                 ///< sum of m |v|, the scale of momentum errors
  Vector3 angular_momentum = Vector3::Zero();  ///< about the origin, including affine fields
  double kinetic_energy = 0.0;                 ///< of the velocities of particles and nodes
  double affine_kinetic_energy = 0.0;          ///< of their affine fields: m I |C|^2 / 2
  double internal_energy = 0.0;
  double unresolved_energy = 0.0;  ///< kinetic energy of motion that the cells do not resolve
  double hourglass_energy = 0.0;   ///< stored in the hourglass modes of elements; not negative

  [[nodiscard]] double energy() const {
    return kinetic_energy + affine_kinetic_energy + unresolved_energy + internal_energy + hourglass_energy;
  }
  /// Returns the ratio of the unresolved energy to the kinetic energy of resolved motion; 0 where nothing
  /// moves.
  [[nodiscard]] double unresolved_share() const {
    const double resolved = kinetic_energy + affine_kinetic_energy;
    return resolved > 0.0 ? unresolved_energy / resolved : 0.0;
  }
  Totals& operator+=(const Totals& other) {
    mass += other.mass;
    momentum += other.momentum;
    momentum_scale += other.momentum_scale;
    angular_momentum += other.angular_momentum;
    kinetic_energy += other.kinetic_energy;
    affine_kinetic_energy += other.affine_kinetic_energy;
    internal_energy += other.internal_energy;
    unresolved_energy += other.unresolved_energy;
    hourglass_energy += other.hourglass_energy;
    return *this;
  }
};

/// Holds the mass, momentum and energy of a part of the material, such as a body, that has left the domain (SI units).
struct BodyOutflow {
  double mass = 0.0;
  Vector3 momentum = Vector3::Zero();
  double energy = 0.0;
  BodyOutflow& operator+=(const BodyOutflow& other) {
    mass += other.mass;
    momentum += other.momentum;
    energy += other.energy;
    return *this;
  }
};

/// Calls f(name, number) for every number of the sums; used by checkpoints and sums over ranks.
template <class T, class Function>
  requires std::same_as<std::remove_const_t<T>, Totals>
void for_each_number(T& totals, Function&& f) {
  f("mass", totals.mass);
  f("momentum_x", totals.momentum[0]);
  f("momentum_y", totals.momentum[1]);
  f("momentum_z", totals.momentum[2]);
  f("momentum_scale", totals.momentum_scale);
  f("angular_momentum_x", totals.angular_momentum[0]);
  f("angular_momentum_y", totals.angular_momentum[1]);
  f("angular_momentum_z", totals.angular_momentum[2]);
  f("kinetic_energy", totals.kinetic_energy);
  f("affine_kinetic_energy", totals.affine_kinetic_energy);
  f("internal_energy", totals.internal_energy);
  f("unresolved_energy", totals.unresolved_energy);
  f("hourglass_energy", totals.hourglass_energy);
}

/// Returns twice the axial vector of a velocity gradient (1/s): multiplied by mass and affine inertia it is the angular
/// momentum of an affine field.
inline Vector3 rotation_of(const Matrix3& gradient) {
  return {gradient(2, 1) - gradient(1, 2), gradient(0, 2) - gradient(2, 0), gradient(1, 0) - gradient(0, 1)};
}

/// Holds the inertia per mass (m^2) of affine fields (`transfer::affine_inertia`): one number, or, on a grid of two
/// levels, by the place of the particle.
class AffineInertia {
 public:
  AffineInertia(double everywhere)
      : of_fine_(everywhere) {}  // NOLINT(google-explicit-constructor): a number is one
  /// @param of_fine   in the finest cells
  /// @param geometry  of these; must outlive the object
  AffineInertia(double of_fine, const grid::Geometry& geometry)
      : of_fine_(of_fine), geometry_(geometry.levels.are_two() ? &geometry : nullptr) {}

  [[nodiscard]] double of_fine() const { return of_fine_; }
  /// Returns the ratio of the inertia at a position to that in the finest cells.
  [[nodiscard]] double relative(const Vector3& position) const {
    if (geometry_ == nullptr) return 1.0;
    const double edges = geometry_->cell_size_at(position) / geometry_->cell_size;
    return edges * edges;
  }
  [[nodiscard]] double at(const Vector3& position) const { return of_fine_ * relative(position); }

 private:
  double of_fine_;
  const grid::Geometry* geometry_ = nullptr;
};

/// Returns the totals of one particle.
Totals totals_of(const Particles& particles, std::size_t p, const AffineInertia& of_field);
/// Sums over all particles of this rank; bitwise independent of the number of threads.
Totals totals_of(const Particles& particles, const AffineInertia& of_field);
/// Sums over the particles, with the former sums for unchanged chunks.
/// @param of_chunk  sums of each chunk of particles, from the last call
/// @param stays     of each chunk: 1 if its particles have not changed since
Totals totals_of(const Particles& particles, const AffineInertia& of_field, std::vector<Totals>& of_chunk,
                 std::span<const std::uint8_t> stays);

/// Accumulates all contributions that enter and leave, so that at any time energy = initial - outflow + external work
/// and momentum = initial - outflow + impulse of walls and external forces.
struct Ledger {
  Totals initial;
  Totals outflow;
  BodyOutflow retired;  ///< part of the outflow: products of explosives removed below a pressure
  Vector3 wall_impulse = Vector3::Zero();  ///< by mirror planes and walls, and along y by hoop stresses, N s
  Vector3 external_impulse = Vector3::Zero();  ///< by external accelerations, N s
  // Units and meanings of the following sums: `accounts` (src/solver/accounts.hpp).
  double external_work = 0.0, damping_work = 0.0, work = 0.0, viscous_work = 0.0, plastic_work = 0.0,
         dissipation = 0.0, plastic_heat = 0.0, material_viscous_heat = 0.0;
  double transfer_heat = 0.0, unresolved_kept = 0.0, unresolved_returned = 0.0, conducted_heat = 0.0;
  double contact_heat = 0.0, friction_heat = 0.0, contact_impulse = 0.0, friction_impulse = 0.0;
  double converted_mass = 0.0, conversion_heat = 0.0, removed_mass = 0.0;
  double hourglass_work = 0.0, hourglass_overdrawn = 0.0;
  double below_cold_curve = 0.0, at_pressure_floor = 0.0, limited_volume_changes = 0.0;
  double limited_densities = 0.0, limited_compressions = 0.0, limited_void_steps = 0.0;
  double limited_bulking = 0.0, limited_domains = 0.0, limited_hourglass = 0.0, elements_beyond_range = 0.0;
  double held_pressures = 0.0, refused_divisions = 0.0, held_time_steps = 0.0, shocks_at_change = 0.0;

  /// Maximum over the ends of all steps so far, with affine, unresolved and hourglass energies, J.
  double largest_kinetic_energy = 0.0;
  double largest_heating = 0.0;   ///< of the change of internal energy, J
  double largest_momentum = 0.0;  ///< of the sum of m |v|, kg m/s

  /// Adds the contributions of a step (its `initial` and maxima are not used).
  void add(const Ledger& step);
  /// Updates the maxima.
  void observe(const Totals& now);
  /// Returns the error of the total energy relative to the energies exchanged in the run: maxima of kinetic energy and
  /// of the change of internal energy, and external work (docs/theory/mpm.md, section 4).
  [[nodiscard]] double energy_error(const Totals& now) const;
  /// Returns the error of the momentum relative to the maximum of the sum of m |v| and the external impulse.
  [[nodiscard]] double momentum_error(const Totals& now) const;
};

/// Replaces every number by its sum over all ranks. Collective.
template <class... Parts>
void sum_over_ranks(MPI_Comm communicator, Parts&... parts) {
  if (parallel::size(communicator) == 1) return;
  std::vector<double> numbers;
  (for_each_number(parts, [&](const std::string&, double& x) { numbers.push_back(x); }), ...);
  parallel::sum(communicator, numbers);
  auto next = numbers.begin();
  (for_each_number(parts, [&](const std::string&, double& x) { x = *next++; }), ...);
}

}  // namespace whipple::solver

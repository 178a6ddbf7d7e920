// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "src/fem/mesh.hpp"

/// The parts of an explicit finite element step, in the order in which a scheme calls them (docs/theory/fem.md, 1).
/// Stresses are those of the Gauss points; between `deform` and the next `internal_forces` the caller runs
/// `update_material` on them with the velocity gradients and with `points.length` as the lengths of the artificial
/// viscosity. Energy: kinetic + internal + hourglass energy is constant to round-off for any stresses. No function
/// allocates per element or throws.
namespace whipple::fem {

/// Controls the resistance of the four hourglass modes of a one-point element, which have no mean gradient (eq. 3.3 to
/// 3.9).
struct HourglassControl {
  enum class Kind : std::uint8_t {
    viscous,    ///< resists the rate; its work becomes heat immediately
    stiffness,  ///< resists the amplitude; its work is stored as hourglass energy
  };
  friend constexpr std::array<Word<Kind>, 2> words(Kind) {
    return {{{Kind::stiffness, "stiffness"}, {Kind::viscous, "viscous"}}};
  }
  Kind kind = Kind::stiffness;
  double coefficient = 0.05;  ///< fraction of the maximum stiffness or critical damping of the element
};

/// Holds the coefficients of the artificial viscosity q = rho l |D| (c2 l |D| + c1 c) that enter the time step.
struct ViscosityCoefficients {
  double linear = 0.25;  ///< the larger one of those for compression and expansion
  double quadratic = 1.0;
};

/// Returns the bound of the stable time step (s): the minimum of 2/omega (sqrt(1 + xi^2) - xi) over the elements, with
/// omega from the longitudinal sound speed and the element length, xi from the artificial viscosity (eq. 5.1 to 5.4).
/// Requires lengths (`make_mesh`, `deform`) and states. Infinite without elements.
double critical_time_step(const Mesh& mesh, const ViscosityCoefficients& viscosity);
/// Returns the critical time step of one element.
double critical_time_step(const Mesh& mesh, std::size_t element, const ViscosityCoefficients& viscosity);

/// Computes the nodal forces of stresses and hourglass control into `nodes.force` (eq. 2.6, 3.5, 4.2).
void internal_forces(Mesh& mesh);

/// Holds the velocities of a step, one per node; grid nodes of a coupled run may provide other values.
struct Motion {
  std::vector<Vector3> mean;  ///< m/s, mean of the velocities before and after the forces: work
  std::vector<Vector3> end;   ///< m/s, after the forces: displacement and strain of the step
};

/// Holds the balance of the boundary conditions in a step.
struct ConstraintBalance {
  Vector3 impulse = Vector3::Zero();  ///< N s, on the body
  double work = 0.0;                  ///< J, on the body
  ConstraintBalance& operator+=(const ConstraintBalance& other);
};

/// Updates v <- v + dt f/m (eq. 1.1), then the prescribed components; `motion` receives the mean of old and new
/// velocity, and the new one. Nodes of `elsewhere` (!= 0) and their entries of `motion` are skipped; the caller sets
/// them.
/// @param elsewhere  empty, or one entry per node
/// @param path       factor of the prescribed velocities in this step
ConstraintBalance advance_velocities(Nodes& nodes, double dt, Motion& motion,
                                     std::span<const std::uint8_t> elsewhere = {}, double path = 1.0);

inline ConstraintBalance advance_velocities(Mesh& mesh, double dt, Motion& motion,
                                            std::span<const std::uint8_t> elsewhere = {}, double path = 1.0) {
  return advance_velocities(mesh.nodes, dt, motion, elsewhere, path);
}

/// Advances one node by its acceleration (m/s^2), for a node whose force is summed over ranks.
ConstraintBalance advance_velocity(Nodes& nodes, std::size_t node, const Vector3& acceleration, double dt,
                                   Motion& motion, double path = 1.0);

/// Holds velocity gradients (1/s), one per Gauss point, component by component: L_ij in component[3 i + j].
struct VelocityGradients {
  std::array<std::vector<double>, 9> component;

  void resize(std::size_t n) {
    for (std::vector<double>& values : component) values.resize(n);
  }
  [[nodiscard]] std::size_t size() const { return component[0].size(); }
  [[nodiscard]] Matrix3 at(std::size_t point) const;
  /// Returns the gradients of the points from `first` on, in the form required by `update_material`.
  [[nodiscard]] std::array<const double*, 9> from(std::size_t first) const;
};

/// Holds the effects of the deformation of a step on the elements.
struct DeformationReport {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  double work = 0.0;                 ///< J, of the stresses, into internal energy
  double hourglass_work = 0.0;       ///< J, against the hourglass forces, into hourglass energy and heat
  double hourglass_overdrawn = 0.0;  ///< J, part of it returned beyond the stored energy, from heat
  double limited_hourglass = 0.0;    ///< elements whose forces were limited by the stored energy
  std::size_t inverted = 0;          ///< elements without positive volume (or Jacobian at a Gauss point)
  std::size_t first_inverted = none;
  DeformationReport& operator+=(const DeformationReport& other);
};

/// Defines the constitutive update, called with Gauss points [begin, end) whose gradients and energies are up to date.
/// Called from several threads on disjoint points of whole elements.
using BlockUpdate = std::function<void(std::size_t begin, std::size_t end)>;

/// Computes velocity gradients, work and hourglass forces of the step that moves the nodes from their present positions
/// to x + dt motion.end (eq. 2.5 to 2.8, 3.1 to 3.9, 4.1 to 4.4); `points.length` becomes that of the end of the step.
/// The volume that `update_material` computes from a gradient is exactly that of the element. With `update`, also
/// computes the new stresses and their forces at the end of the step, block by block while all data are in the cache:
/// the next `internal_forces` only sums them. Until then only `move_nodes` may change positions and stresses (calls of
/// `connect` are allowed: they cause forces to be recomputed).
/// @param velocity_gradient  as many as the mesh has Gauss points
DeformationReport deform(Mesh& mesh, const Motion& motion, double dt, const HourglassControl& hourglass,
                         VelocityGradients& velocity_gradient, const BlockUpdate& update = {});

/// Updates x <- x + dt motion.end (eq. 1.3).
void move_nodes(Nodes& nodes, const Motion& motion, double dt);
inline void move_nodes(Mesh& mesh, const Motion& motion, double dt) { move_nodes(mesh.nodes, motion, dt); }

/// Distributes heat given at the nodes (J) over their elements by mass (specific internal energy).
void add_heat(Mesh& mesh, std::span<const double> node_heat);
/// Adds the contributions of the elements of a block.
void add_heat(Mesh& mesh, std::span<const double> node_heat, std::size_t block);

}  // namespace whipple::fem

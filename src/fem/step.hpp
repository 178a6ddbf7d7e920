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

/// The parts of an explicit step of finite elements, in the order in which a scheme calls them
/// (docs/theory/fem.md, 1). Stresses are those of the Gauss points; between `deform` and the next
/// `internal_forces` the caller runs `update_material` on them with the velocity gradients and with
/// `points.length` as the lengths of the artificial viscosity. Energy: kinetic + internal + hourglass is
/// constant to round-off whatever the stresses are. No function allocates per element or throws.
namespace whipple::fem {

/// Resistance of the four modes of a one-point element that its mean gradient does not see (eq. 3.3 to 3.9).
struct HourglassControl {
  enum class Kind : std::uint8_t {
    viscous,    ///< resists the rate; what it takes becomes heat at once
    stiffness,  ///< resists the amplitude; its work is stored as hourglass energy
  };
  friend constexpr std::array<Word<Kind>, 2> words(Kind) {
    return {{{Kind::stiffness, "stiffness"}, {Kind::viscous, "viscous"}}};
  }
  Kind kind = Kind::stiffness;
  double coefficient = 0.05;  ///< fraction of the element's greatest stiffness, or of its critical damping
};

/// Coefficients of the artificial viscosity q = rho l |D| (c2 l |D| + c1 c) that enter the time step.
struct ViscosityCoefficients {
  double linear = 0.25;  ///< the larger one of compression and expansion
  double quadratic = 1.0;
};

/// Bound of the stable time step (s): the least 2/omega (sqrt(1 + xi^2) - xi) of the elements, with omega of
/// the longitudinal sound speed and the element's length, xi of the artificial viscosity (eq. 5.1 to 5.4).
/// Needs lengths (`make_mesh`, `deform`) and states. Infinite without elements.
double critical_time_step(const Mesh& mesh, const ViscosityCoefficients& viscosity);
/// Returns the critical time step of one element.
double critical_time_step(const Mesh& mesh, std::size_t element, const ViscosityCoefficients& viscosity);

/// Forces of stresses and hourglass control on the nodes, into `nodes.force` (eq. 2.6, 3.5, 4.2).
void internal_forces(Mesh& mesh);

/// Velocities of a step, one per node; grid nodes of a coupled run may give their own.
struct Motion {
  std::vector<Vector3> mean;  ///< m/s, of the velocities before and after the forces: the work
  std::vector<Vector3> end;   ///< m/s, after the forces: displacement and strain of the step
};

/// Balance of the boundary conditions in a step.
struct ConstraintBalance {
  Vector3 impulse = Vector3::Zero();  ///< N s, on the body
  double work = 0.0;                  ///< J, on the body
  ConstraintBalance& operator+=(const ConstraintBalance& other);
};

/// v <- v + dt f/m (eq. 1.1), then the prescribed components; `motion` gets the mean of old and new velocity,
/// and the new one. Nodes of `elsewhere` (!= 0) are left alone with their part of `motion`: the caller fills
/// it.
/// @param elsewhere  empty, or one entry per node
ConstraintBalance advance_velocities(Nodes& nodes, double dt, Motion& motion,
                                     std::span<const std::uint8_t> elsewhere = {});

inline ConstraintBalance advance_velocities(Mesh& mesh, double dt, Motion& motion,
                                            std::span<const std::uint8_t> elsewhere = {}) {
  return advance_velocities(mesh.nodes, dt, motion, elsewhere);
}

/// Advances one node by its acceleration (m/s^2), for a node whose force is shared among ranks.
ConstraintBalance advance_velocity(Nodes& nodes, std::size_t node, const Vector3& acceleration, double dt,
                                   Motion& motion);

/// Velocity gradients (1/s), one per Gauss point, component by component: L_ij in component[3 i + j].
struct VelocityGradients {
  std::array<std::vector<double>, 9> component;

  void resize(std::size_t n) {
    for (std::vector<double>& values : component) values.resize(n);
  }
  [[nodiscard]] std::size_t size() const { return component[0].size(); }
  [[nodiscard]] Matrix3 at(std::size_t point) const;
  /// Those of the points from `first` on, as `update_material` takes them.
  [[nodiscard]] std::array<const double*, 9> from(std::size_t first) const;
};

/// Effects of the deformation of a step on the elements.
struct DeformationReport {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  double work = 0.0;                 ///< J, of the stresses, into internal energy
  double hourglass_work = 0.0;       ///< J, against the hourglass forces, into hourglass energy and heat
  double hourglass_overdrawn = 0.0;  ///< J, of it that the forces gave back beyond what was stored, from heat
  double limited_hourglass = 0.0;    ///< elements whose forces were cut to what the stored energy allows
  std::size_t inverted = 0;          ///< elements without positive volume (or Jacobian at a Gauss point)
  std::size_t first_inverted = none;
  DeformationReport& operator+=(const DeformationReport& other);
};

/// Called with Gauss points [begin, end) whose gradients and energies stand: the constitutive update. Runs in
/// several threads on disjoint points, those of whole elements.
using BlockUpdate = std::function<void(std::size_t begin, std::size_t end)>;

/// Velocity gradients, work and hourglass forces of the step that takes the nodes from their present
/// positions to x + dt motion.end (eq. 2.5 to 2.8, 3.1 to 3.9, 4.1 to 4.4); `points.length` becomes that of
/// the end of the step. The volume that `update_material` makes of a gradient is exactly that of the element.
/// With `update`, block by block while all of it is in the cache, also the new stresses and their forces at
/// the end of the step: the next `internal_forces` only sums them. Until then nothing but `move_nodes` may
/// change positions and stresses (what calls `connect` may: it has forces computed again).
/// @param velocity_gradient  as many as the mesh has Gauss points
DeformationReport deform(Mesh& mesh, const Motion& motion, double dt, const HourglassControl& hourglass,
                         VelocityGradients& velocity_gradient, const BlockUpdate& update = {});

/// x <- x + dt motion.end (eq. 1.3)
void move_nodes(Nodes& nodes, const Motion& motion, double dt);
inline void move_nodes(Mesh& mesh, const Motion& motion, double dt) { move_nodes(mesh.nodes, motion, dt); }

/// Shares heat given at the nodes (J) among their elements by mass (specific internal energy).
void add_heat(Mesh& mesh, std::span<const double> node_heat);
/// The contributions of the elements of a block.
void add_heat(Mesh& mesh, std::span<const double> node_heat, std::size_t block);

}  // namespace whipple::fem

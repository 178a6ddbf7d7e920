// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "src/core/base/tensor.hpp"
#include "src/material/burn.hpp"
#include "src/material/heating_viscosity.hpp"
#include "src/material/kinematics.hpp"
#include "src/material/material.hpp"

/// The constitutive part of a time step, from the velocity gradient to the new stress (docs/theory/material.md). Both
/// functions process chunks of 64 points: kinematics and strength, one call of the equation of state, then failure.
/// They do not allocate or throw, and may run in several threads on disjoint points.
namespace whipple {

struct UpdateSettings {
  double time_step = 0.0;  ///< s
  double cell_size = 0.0;  ///< length of the artificial viscosity, m
  /// Lengths of the artificial viscosity of each point of the set, m, instead of `cell_size`.
  std::span<const double> lengths = {};
  double linear_viscosity = 0.25;    ///< c1 of q = rho l |D| (c2 l |D| + c1 c)
  double quadratic_viscosity = 1.0;  ///< c2
  double expansion_viscosity = 0.0;  ///< c1 of q = -rho l |D| c1 c in expansion
  HeatingViscosity heating = HeatingViscosity::not_distinguished;
  /// tr C of the affine field of each point of the list, 1/s, for `HeatingViscosity::of_affine_field`.
  std::span<const double> affine_divergence = {};
  double affine_gain = 1.0;         ///< a of eq. 6
  double affine_compression = 0.0;  ///< g of eq. 6, > 0 for `HeatingViscosity::of_affine_field`
  double initial_density = 1.0;     ///< initial density of the body, kg/m^3, to which g refers
  material::StressRotation rotation = material::StressRotation::hughes_winget;
  double time = 0.0;  ///< at the end of the step, s
  BurnSettings burn = {};
};

/// Velocity gradients of contiguous points by component: L_ij (1/s) of the k-th point is [3 i + j][k].
using GradientComponents = std::array<const double*, 9>;

/// Reports the events of an update. Indices are those of the points (not of the range or list).
struct MaterialReport {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  eos::RangeReport equation_of_state;  ///< `first` is the index of the point
  std::size_t undefined = 0;           ///< points with a nonpositive volume, or NaN in gradient or energy
  std::size_t first_undefined = none;  ///< index of the first one
  /// Number of steps with J outside [1/2, 2], which is limited (time step too large).
  std::size_t limited_volume_changes = 0;
  std::size_t limited_densities = 0;  ///< steps that would have expanded material below its minimum density
  std::size_t points = 0;             ///< points updated
  double mass = 0.0;                  ///< of the points updated, kg
  std::size_t squeezed = 0;           ///< points limited to the maximum density of the equation of state
  double squeezed_mass = 0.0;         ///< their mass, kg
  std::size_t first_squeezed = none;  ///< index of the first one
  /// Steps in which material next to a void changed by the maximum allowed.
  std::size_t limited_void_steps = 0;
  std::size_t limited_bulking = 0;  ///< steps of crushed brittle material at its maximum bulking
  double compression_rate = 0.0;    ///< maximum of -tr L over points under pressure, 1/s
  double plastic_work = 0.0;        ///< J
  /// Irreversible energy of the models, J, >= 0: plastic and viscous work, and elastic energy of the deviator lost with
  /// the strength; without artificial viscosity.
  double dissipation = 0.0;
  /// Heat of the models, J: of plastic flow without what it stores, of crushed pores and of elastic energy lost with the
  /// strength; of the viscosity of fluids and of relaxing stress.
  double plastic_heat = 0.0, viscous_heat = 0.0;
  std::array<std::size_t, failure::code_count> failed{};  ///< points that failed in this step, by code

  /// Returns whether the material of a body, not only single points of it, is denser than its equation of state allows,
  /// from the masses on all ranks. Below a thousandth of the mass, single points are compressed by nodes that hardly any
  /// other point reaches: at the edge of a contact, in rings that converge on the axis, grains of a spray.
  static constexpr bool is_too_dense(double squeezed_mass, double mass) {
    return squeezed_mass > 1e-3 * mass;
  }
  /// Returns whether no event ends a run: `undefined` and `equation_of_state.out_of_range` are 0, and the material is
  /// not too dense if these points are all points of the body.
  [[nodiscard]] bool valid() const {
    return undefined == 0 && equation_of_state.out_of_range == 0 && !is_too_dense(squeezed_mass, mass);
  }
  void merge(const MaterialReport& other);
};

/// Performs the constitutive update of the symplectic scheme. On entry `specific_internal_energy` has been advanced
/// over the whole step by the exact work identity of the grid; it is not changed. Volume, stresses, pressure,
/// viscosity, plastic strain, temperature, phase fractions, failure, void and sound speed are set to those at the end
/// of the step; the equation of state receives the energy half a step ahead (docs/theory/material.md, eq. 10), without
/// the elastic energy of the deviator.
/// @param velocity_gradient  L_ij = dv_i/dx_j (1/s) of the new grid velocity; entry k belongs to point begin + k
MaterialReport update_material(const Material& material, MaterialPoints& points, std::size_t begin,
                               std::size_t end, std::span<const Matrix3> velocity_gradient,
                               const UpdateSettings& settings);
/// Updates the points of a range with the gradients given by component.
MaterialReport update_material(const Material& material, MaterialPoints& points, std::size_t begin,
                               std::size_t end, const GradientComponents& velocity_gradient,
                               const UpdateSettings& settings);
/// Updates a list of points (sorted or not, without repetition); entry k of the gradients belongs to point
/// indices[k].
MaterialReport update_material(const Material& material, MaterialPoints& points,
                               std::span<const std::uint32_t> indices,
                               std::span<const Matrix3> velocity_gradient, const UpdateSettings& settings);

/// Performs the constitutive update of the schemes without a work identity (USF, USL, MUSL), which also integrates the
/// specific internal energy: deviatoric work with the mean of old and new stress, pressure work with the mean of old
/// and new pressure, implicitly (docs/theory/material.md, eq. 14).
MaterialReport update_material_and_energy(const Material& material, MaterialPoints& points, std::size_t begin,
                                          std::size_t end, std::span<const Matrix3> velocity_gradient,
                                          const UpdateSettings& settings);
MaterialReport update_material_and_energy(const Material& material, MaterialPoints& points,
                                          std::span<const std::uint32_t> indices,
                                          std::span<const Matrix3> velocity_gradient,
                                          const UpdateSettings& settings);

}  // namespace whipple

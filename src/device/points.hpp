// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "src/core/base/triple.hpp"
#include "src/material/kinematic_formulas.hpp"

/// Particles as a device keeps them: one array of numbers per component, all of one length.
namespace whipple::device {

/// Names the components of the state of a particle, in SI units. Vectors and tensors begin at their name.
enum Component : std::uint32_t {
  position = 0,  ///< x, y, z
  velocity = 3,
  affine = 6,     ///< C, column by column
  deviator = 15,  ///< xx, yy, zz, xy, yz, zx
  extent = 21,    ///< of the particle's domain, in the same order
  mass = 27,
  volume,
  void_volume,
  energy,  ///< specific internal energy
  pressure,
  artificial_viscosity,
  heating_viscosity,
  temperature,
  sound_speed,
  plastic_strain,
  melted,
  vaporised,
  failed,  ///< code, as a number
  maximum_pressure,
  maximum_temperature,
  melting_time,
  threshold_factor,
  unresolved,
  allowance,
  closing_rate,
  damage,
  fragment_size,
  cold_work,
  generation,  ///< divisions since the start
  state_components,
  // Results of a step, which end with it.
  gradient = state_components,  ///< L, row by row, 1/s
  work = gradient + 9,          ///< of the stress, J
  viscous_work,                 ///< of the artificial viscosity that became internal energy, J
  heat,                         ///< of the transfers: internal energy, J
  kept,                         ///< unresolved energy gained, J
  returned,                     ///< unresolved energy that became internal, J
  external_work,                ///< of loads, J
  squared_change,               ///< of the velocity, m^2/s^2
  plastic_work,                 ///< J
  dissipation,                  ///< J
  plastic_heat,                 ///< J
  compression,                  ///< rate under pressure, 1/s
  events,                       ///< bits of MaterialEvent, as a number
  all_components,
  section = work  ///< before the motion, in two dimensions: area in the plane, m^2
};

/// Gives access to the particles in the memory of a device.
struct Points {
  double* numbers = nullptr;        ///< component by component
  std::size_t stride = 0;           ///< from one component to the next
  std::uint32_t* body = nullptr;    ///< of the case
  std::uint32_t* origin = nullptr;  ///< place at the last exchange with the host
  std::size_t size = 0;

  [[nodiscard]] WHIPPLE_POINT double& at(std::uint32_t component, std::size_t p) const {
    return numbers[component * stride + p];
  }
  [[nodiscard]] WHIPPLE_POINT Triple<double> vector(std::uint32_t component, std::size_t p) const {
    return {at(component, p), at(component + 1, p), at(component + 2, p)};
  }
  WHIPPLE_POINT void set(std::uint32_t component, std::size_t p, const Triple<double>& v) const {
    at(component, p) = v.x, at(component + 1, p) = v.y, at(component + 2, p) = v.z;
  }
  /// Returns a matrix that is stored column by column.
  [[nodiscard]] WHIPPLE_POINT std::array<Triple<double>, 3> columns(std::uint32_t component,
                                                                    std::size_t p) const {
    return {vector(component, p), vector(component + 3, p), vector(component + 6, p)};
  }
  [[nodiscard]] WHIPPLE_POINT material::formulas::Symmetric<double> symmetric(std::uint32_t component,
                                                                              std::size_t p) const {
    return {at(component, p),     at(component + 1, p), at(component + 2, p),
            at(component + 3, p), at(component + 4, p), at(component + 5, p)};
  }
};

/// Returns the volume of a particle with its voids (m^3), in two dimensions its area in the plane (m^2).
template <bool planar>
WHIPPLE_POINT double size_in_section(const Points& points, std::size_t p) {
  if constexpr (planar) {
    return points.at(section, p);
  } else {
    return points.at(volume, p) + points.at(void_volume, p);
  }
}

/// Computes the areas of the particles in the plane. Kernels that visit particles often do not divide.
struct FindSections {
  Points points;
  bool has_rings;  ///< axisymmetry; otherwise a slice 1 m thick

  WHIPPLE_POINT void operator()(std::size_t p) const {
    const double depth = has_rings ? 2.0 * std::numbers::pi * points.at(position + 1, p) : 1.0;
    points.at(section, p) = (points.at(volume, p) + points.at(void_volume, p)) / depth;
  }
};

}  // namespace whipple::device

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "src/core/base/words.hpp"
#include "src/fem/mesh.hpp"
#include "src/fem/step.hpp"
#include "src/particles/arrangement.hpp"
#include "src/particles/particles.hpp"

/// Adaptive finite element material point method: strongly deformed elements are converted to particles
/// (docs/theory/afemp.md, section 3).
namespace whipple::afemp {

/// Holds thresholds for conversion: an element is converted as soon as one is exceeded; infinite or 0: disabled.
struct Thresholds {
  double plastic_strain = std::numeric_limits<double>::infinity();  ///< at any of its Gauss points
  double time_step_ratio = 0.0;  ///< of its stable time step to that of the grid, lower bound
  double jacobian = 0.0;         ///< minimum scaled Jacobian (docs/theory/fem.md), lower bound
  bool failed = false;           ///< a Gauss point has failed
};

/// Returns which elements exceed a threshold: one entry per element, nonzero if so.
/// @param grid_time_step s, stable on the grid; infinite if the grid is empty
std::vector<std::uint8_t> distorted_elements(const fem::Mesh& mesh, const Thresholds& thresholds,
                                             const fem::ViscosityCoefficients& viscosity,
                                             double grid_time_step);

/// Describes the range in which an element is a valid approximation; 0 or infinite: unlimited.
struct ElementRange {
  double jacobian = 0.0;  ///< minimum scaled Jacobian (docs/theory/fem.md)
  double time_step_ratio = 0.0;
  double hourglass_share = std::numeric_limits<double>::infinity();  ///< of its internal energy
  double speed = std::numeric_limits<double>::infinity();            ///< m/s, of its nodes
  double plastic_strain = std::numeric_limits<double>::infinity();   ///< maximum at its points
  bool failed = false;                                               ///< whether failed material is beyond it
};

/// Classifies how an element has left its range.
enum class RangeFault : std::uint8_t { none, jacobian, time_step, hourglass, speed, plastic_strain, failed };
constexpr std::array<Word<RangeFault>, 7> words(RangeFault) {
  return {{{RangeFault::none, "is in its valid range"},
           {RangeFault::jacobian, "is distorted: the Jacobian at a corner is below its fraction of the mean"},
           {RangeFault::time_step,
            "has become so thin that its stable time step is below its fraction of the grid's"},
           {RangeFault::hourglass, "has more hourglass energy than its fraction of the internal energy"},
           {RangeFault::speed, "has a node faster than its largest valid speed"},
           {RangeFault::plastic_strain, "has more plastic strain than its largest valid one"},
           {RangeFault::failed, "has failed"}}};
}
/// Returns whether a fault is one of the material, which many elements of a body that is perforated have.
constexpr bool is_of_material(RangeFault fault) {
  return fault == RangeFault::plastic_strain || fault == RangeFault::failed;
}

/// Returns for every element how it has left its range.
/// @param grid_time_step s, stable on the grid; infinite if the grid is empty
std::vector<RangeFault> range_faults(const fem::Mesh& mesh, const ElementRange& range,
                                     const fem::ViscosityCoefficients& viscosity, double grid_time_step);

/// Holds the balance of the conversions.
struct ConversionBalance {
  std::size_t elements = 0;
  double mass = 0.0;              ///< kg, of the converted elements
  double kinetic_heat = 0.0;      ///< J, kinetic energy not carried by particles, into internal energy
  double hourglass_energy = 0.0;  ///< J, released into internal energy
};

/// Removes the chosen elements from the mesh and appends eight particles for each, four for a quadrilateral: at the
/// natural coordinates (+-0.5)^3 or (+-0.5)^2, or offset from them in layers, with the state of the element (of the Gauss point in their octant), ids
/// from 8 times that of the element on, and velocities by (3.2) to (3.6). Mass, momentum and energy are conserved to
/// round-off, as is angular momentum unless the affine field is capped; the heat is not negative. Nodes that lost an
/// element are marked as on the surface; nodes without elements are removed.
/// @param affine_inertia of the affine field of the particles per mass, m^2 (`transfer::affine_inertia`); 0: none
ConversionBalance convert_elements(fem::Mesh& mesh, std::span<const std::uint8_t> chosen,
                                   double affine_inertia, Particles& particles,
                                   Arrangement arrangement = Arrangement::regular);

}  // namespace whipple::afemp

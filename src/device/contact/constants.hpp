// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "src/core/base/triple.hpp"
#include "src/device/lattice.hpp"

/// Contact of two velocity fields at a node (docs/theory/contact.md, sections 3 to 5), as on the host (src/contact). More
/// than two fields at a node, normals by logistic regression and cracks are not supported.
namespace whipple::device {

constexpr std::size_t most_contact_fields = 16;  ///< velocity fields of a case
/// Mass (kg) below which momentum / mass may overflow.
constexpr double no_mass_for_contact = 1e-300;

/// Selects the response of bodies at a node where their surfaces touch.
enum class ContactResponse : std::uint8_t {
  common_field,  ///< under compression the bodies have a common velocity along the normal
  impulses,      ///< each body keeps its velocity; impulses stop the approach
};
/// Selects the candidates for the normal between two bodies.
enum class ContactNormal : std::uint8_t {
  collinear,   ///< mean of the unit normals of both
  separating,  ///< normal of either body or their mean: the one with the largest gap
};

/// Holds what contact needs of the case and of the step.
struct ContactConstants {
  ContactResponse response = ContactResponse::common_field;
  ContactNormal normal = ContactNormal::separating;
  bool gap_test = true;  ///< contact only where surfaces touch, or would within the step
  double gap = 0.0;      ///< in cells: surfaces closer than this touch
  double dt = 0.0;       ///< s
  /// Coulomb coefficient of each velocity field; the smaller one of a pair applies.
  std::array<double, most_contact_fields> friction{};
  /// Minimum relaxation rate of each velocity field, 1/s; below it impulses stop the field. 0: no minimum.
  std::array<double, most_contact_fields> least_relaxation_rate{};
  /// Faces of the domain that reflect, bonded or not, one bit each: every kind but outflow.
  std::uint32_t reflecting_faces = 0;
};

/// Holds the numbers of the two nodes at a place that exactly two fields reach, the lower field first.
struct ContactPair {
  std::uint32_t first, second;
};
/// In the place of the second node, where more than two fields reach the place.
constexpr std::uint32_t crowded = static_cast<std::uint32_t>(-1);

/// Holds energy and momentum balance of contact at a node; the engine adds those of all pairs in a fixed order.
struct ContactBalance {
  double contact_heat = 0.0;      ///< dissipated by normal impulses, J
  double friction_heat = 0.0;     ///< dissipated by tangential impulses, J
  double impulse = 0.0;           ///< sum of the magnitudes of the normal impulses, N s
  double friction_impulse = 0.0;  ///< sum of the magnitudes of the tangential impulses, N s
  double crowded = 0.0;  ///< number of places that more than two fields reach: these are not computed

  WHIPPLE_POINT ContactBalance& operator+=(const ContactBalance& other) {
    contact_heat += other.contact_heat;
    friction_heat += other.friction_heat;
    impulse += other.impulse;
    friction_impulse += other.friction_impulse;
    crowded += other.crowded;
    return *this;
  }
};

}  // namespace whipple::device

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "src/case/load.hpp"
#include "src/case/section.hpp"
#include "src/core/base/tensor.hpp"

namespace whipple::cases {

/// Describes a force that is written over time with its moment: of walls and other bodies on a body, or of all material
/// on a face of the domain or a patch of it (docs/theory/mpm.md, equations 3.6a to 3.6c).
struct ForceGauge {
  std::string name;
  std::string body;                 ///< empty: on a face
  Face face = Face::none;           ///< none: on a body
  std::optional<LoadBox> box;       ///< none: the whole face
  Vector3 about = Vector3::Zero();  ///< point to which the moment refers, m

  static ParameterTable<ForceGauge> parameters();
  static std::span<const Section<ForceGauge>> sections();
  void check(const Case& setup, const Faults& faults) const;

  /// Returns the number of the body. Requires one.
  [[nodiscard]] std::size_t body_number(const Case& setup) const;

 private:
  void check_face(const Case& setup, const Faults& faults) const;
};

/// Adds faults for bodies that share their velocity field with others: what acts between these is not known. Requires
/// contact fields.
void check_bodies_of_force_gauges(const Case& setup, const Faults& faults);

}  // namespace whipple::cases

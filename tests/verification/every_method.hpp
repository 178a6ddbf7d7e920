// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {

/// Returns every combination of scheme, shape function and particle update that a case may have.
inline std::vector<Method> all_methods() {
  std::vector<Method> methods;
  for (const char* scheme : {"symplectic", "usf", "usl", "musl"}) {
    const bool exact = std::string(scheme) == "symplectic";
    for (const char* shape : {"linear", "gimp", "convected_gimp", "quadratic_bspline", "cubic_bspline"}) {
      for (const char* update : {"flip", "pic", "blend", "fmpm", "relaxed_affine", "apic"}) {
        const bool affine = std::string(update) == "relaxed_affine" || std::string(update) == "apic";
        if (affine && (!exact || !std::string(shape).ends_with("bspline"))) continue;
        if (exact && std::string(update) == "fmpm") continue;
        Method method;
        method.scheme = scheme;
        method.shape_function = shape;
        method.particle_update = update;
        methods.push_back(method);
      }
    }
  }
  return methods;
}

inline std::string name_of(const Method& m) {
  return m.scheme + " " + m.shape_function + " " + m.particle_update;
}

}  // namespace whipple::verification

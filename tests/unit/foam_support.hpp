// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/strength/foam.hpp"

namespace whipple::material_test {

/// Returns a point, with its trial equivalent stress q (Pa) and pressure p (Pa), to the yield surface of a foam.
/// @param point  q, p, distension, strain, modulus (Pa), stiffness (Pa); increment and work (J/m^3) are returned
template <class Point>
void crush_point(const strength::Foam& foam, Point& point) {
  const double trial = point.q, before = point.p;
  foam.crush({.bulk_modulus = {&point.stiffness, 1},
              .modulus = {&point.modulus, 1},
              .trial = {&trial, 1},
              .pressure = {&before, 1},
              .equivalent = {&point.q, 1},
              .distension = {&point.distension, 1},
              .plastic_strain = {&point.strain, 1},
              .plastic_increment = {&point.increment, 1},
              .dissipation = {&point.work, 1}});
}

}  // namespace whipple::material_test

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "eos/model_equation_of_state.hpp"
#include "eos/models/polynomial.hpp"
#include "src/material/material_file.hpp"
#include "src/material/strength/holmquist_johnson_cook.hpp"
#include "src/material/strength/johnson_holmquist_2.hpp"
#include "src/material/strength/riedel_hiermaier_thoma.hpp"
#include "tests/folders.hpp"
#include "tests/unit/material_support.hpp"

/// Materials and bodies of the tests of concrete and ceramics.
namespace whipple::brittle_test {

using namespace material_test;
using strength::BrittleModel;
using strength::JohnsonHolmquist2;
using strength::RiedelHiermaierThoma;
using Hjc = strength::HolmquistJohnsonCook;

inline constexpr double dt = 1e-8;
inline const UpdateSettings settings{
    .time_step = dt, .cell_size = 1e-3, .linear_viscosity = 0.0, .quadratic_viscosity = 0.0};

inline Material library(const std::string& name) {
  return read_material(whipple::tests::source_folder() + "/eos/materials/" + name + ".toml");
}

/// Returns the ceramic of the single-element tests of Johnson and Holmquist (1994).
inline JohnsonHolmquist2 alumina() {
  JohnsonHolmquist2 c;
  c.shear_modulus = 90.16e9;
  c.hugoniot_elastic_limit = 2.79e9;
  c.pressure_at_elastic_limit = 1.46e9;
  c.tensile_strength = 0.2e9;
  c.intact_coefficient = 0.93;
  c.intact_exponent = 0.6;
  c.fractured_coefficient = 0.31;
  c.fractured_exponent = 0.6;
  c.damage_coefficient = 0.005;
  c.damage_exponent = 1.0;
  return c;
}
inline constexpr double K1 = 130.95e9;

template <class Law>
Material ceramic(const Law& law) {
  eos::PolynomialConstants constants;
  constants.reference_density = 3700;
  constants.C1 = K1;
  constants.heat_capacity = 880;
  return make_material("ceramic", std::make_shared<eos::ModelEquationOfState<eos::Polynomial>>(constants),
                       std::make_shared<BrittleModel<Law>>(law));
}
inline Hjc concrete_law() {
  return dynamic_cast<const BrittleModel<Hjc>&>(*library("concrete_48mpa_hjc").strength).law();
}

/// A homogeneous body that is strained in steps.
struct Body {
  const Material& material;
  MaterialPoints points = points_of(material, 1);
  Matrix3 place = Matrix3::Identity(), before = Matrix3::Zero();

  MaterialReport strain_to(const Matrix3& next) {
    const Matrix3 gradient = gradient_between(place, next, dt);
    const MaterialReport report = step_with_work(material, points, gradient, settings, before);
    before = gradient;
    place = next;
    return report;
  }
  /// Strains along a straight path to a configuration; one step of rest at the end, so that the energy refers to the
  /// same time as the stress.
  void strain_to(const Matrix3& next, int steps) {
    const Matrix3 from = place;
    for (int i = 1; i <= steps; ++i) strain_to((from + (next - from) * i / steps).eval());
    strain_to(next);
    strain_to(next);
  }
  [[nodiscard]] double p() const { return points.pressure[0]; }
  [[nodiscard]] double q() const { return equivalent_stress(points.deviatoric_stress[0]); }
  [[nodiscard]] double damage() const { return points.history.scalar("damage")[0]; }
  [[nodiscard]] double energy() const { return points.specific_internal_energy[0] * points.mass[0]; }
};

inline Matrix3 diagonal(double x, double y, double z) { return Vector3(x, y, z).asDiagonal(); }

inline RiedelHiermaierThoma rht() {
  return dynamic_cast<const strength::RiedelHiermaierThomaModel&>(*library("concrete_35mpa_rht").strength)
      .law();
}

/// Expects that random paths about a small compression never give work back, and that they flow.
inline void expect_dissipation(const Material& material, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  int flowed = 0;
  for (int path = 0; path < 20; ++path) {
    Body body{material};
    for (int leg = 0; leg < 4; ++leg) {
      const Matrix3 next = diagonal(0.998, 0.998, 0.998) + 0.004 * random_matrix(generator, 1.0);
      const Matrix3 from = body.place;
      for (int i = 1; i <= 200; ++i) {
        const double before = body.points.plastic_strain[0];
        const MaterialReport report = body.strain_to((from + (next - from) * i / 200).eval());
        EXPECT_GE(report.plastic_work, 0.0);
        EXPECT_GE(body.points.plastic_strain[0], before);
        flowed += report.plastic_work > 0.0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(flowed, 2000);
}

}  // namespace whipple::brittle_test

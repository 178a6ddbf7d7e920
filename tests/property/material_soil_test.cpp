// SPDX-License-Identifier: BSD-3-Clause
// Soil: cones against the pyramid of Mohr and Coulomb, stresses on the surface, apex, dissipation, friction by the rate.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "src/core/base/error.hpp"
#include "src/material/failure/tensile_pressure.hpp"
#include "src/material/strength/drucker_prager.hpp"
#include "src/material/strength/granular_flow.hpp"
#include "tests/unit/brittle_support.hpp"

namespace whipple {
namespace soil_test {

using namespace brittle_test;
using strength::DruckerPrager;
using strength::GranularFlow;
using strength::MatchedStates;

constexpr double degree = std::numbers::pi / 180.0, bulk = 50e6;

DruckerPrager clay(MatchedStates match) {
  DruckerPrager law;
  law.shear_modulus = 30e6;
  law.friction_angle = 20 * degree;
  law.cohesion = 10e3;
  law.match = match;
  return law;
}

template <class Law>
Material soil(const Law& law, std::vector<std::shared_ptr<const failure::Criterion>> failure = {}) {
  eos::PolynomialConstants constants;
  constants.reference_density = 2000;
  constants.C1 = bulk;
  constants.heat_capacity = 1000;
  return make_material("soil", std::make_shared<eos::ModelEquationOfState<eos::Polynomial>>(constants),
                       std::make_shared<BrittleModel<Law>>(law), std::move(failure));
}

/// Returns q, and p, of the principal stresses a > b > c in compression.
std::pair<double, double> invariants(double a, double b, double c) {
  return {std::sqrt(0.5 * ((a - b) * (a - b) + (b - c) * (b - c) + (c - a) * (c - a))), (a + b + c) / 3.0};
}

TEST(DruckerPrager, ConesTouchThePyramidOfMohrAndCoulomb) {
  const double sine = std::sin(20 * degree), cosine = std::cos(20 * degree), c = 10e3;
  for (const double least : {0.0, 5e3, 1e5}) {
    const double most = (least * (1 + sine) + 2 * c * cosine) / (1 - sine);  // a - c = 2 c cos + (a + c) sin
    const auto expect_touch = [&](MatchedStates match, double middle) {
      const auto [q, p] = invariants(most, middle, least);
      const DruckerPrager::Cone cone = clay(match).cone();
      EXPECT_NEAR(q, cone.cohesion + cone.slope * p, 1e-9 * q) << static_cast<int>(match);
    };
    expect_touch(MatchedStates::compression, least);
    expect_touch(MatchedStates::extension, most);
    expect_touch(MatchedStates::plane_strain, 0.5 * (most + least));
  }
  // Associated flow without strain along z: the deviator there is -M/3 of q, where the flow has no component along z.
  DruckerPrager law = clay(MatchedStates::plane_strain_associated);
  const DruckerPrager::Cone cone = law.cone();
  const double p = 1e5, q = cone.cohesion + cone.slope * p;
  const double along_z = 2.0 / 9.0 * cone.slope * q;  // deviator, compression positive: 3 s_z/(2 q) = M/3
  const double half = std::sqrt(q * q / 3.0 - 0.75 * along_z * along_z), mean = p - 0.5 * along_z;
  const double a = mean + half, b = mean - half;
  EXPECT_NEAR(invariants(a, p + along_z, b).first, q, 1e-9 * q);
  EXPECT_NEAR(a - b, 2 * c * cosine + (a + b) * sine, 1e-9 * a);
  // Published factors of 19.8 degrees: Bui et al. (2008) and the cone without dilation.
  law.friction_angle = 19.8 * degree;
  EXPECT_NEAR(law.cone().slope / std::numbers::sqrt3, 0.33245, 1e-5);
  law.match = MatchedStates::plane_strain;
  EXPECT_NEAR(law.cone().slope / std::numbers::sqrt3, 0.33874, 1e-5);
}

TEST(DruckerPrager, ShearedSoilStaysOnTheConeAndKeepsItsVolume) {
  const DruckerPrager law = clay(MatchedStates::plane_strain);
  const Material material = soil(law);
  Body body{material};
  for (const double ratio : {0.9999, 0.999, 0.998}) {
    Matrix3 f = diagonal(ratio, ratio, ratio);
    body.strain_to(f, 100);
    f(0, 1) = 0.05 * (1 - ratio) / 0.001;
    body.strain_to(f, 4000);
    const double p = body.p();
    EXPECT_NEAR(body.q(), law.cone().cohesion + law.cone().slope * p, 1e-9 * body.q());
    EXPECT_NEAR(p, bulk * (std::pow(ratio, -3) - 1), 1e-3 * p);  // no dilation: the volume is the elastic one
    EXPECT_EQ(body.damage(), 0.0);
  }
}

TEST(DruckerPrager, GapsOpenAtTheApexOrTheTensileStrength) {
  DruckerPrager law = clay(MatchedStates::compression);
  const double apex = law.cone().cohesion / law.cone().slope;
  EXPECT_NEAR(apex, 10e3 / std::tan(20 * degree), 1e-6);
  for (const double strength : {0.1 * apex, 10 * apex}) {
    law.tensile_strength = strength;
    const Material material = soil(law);
    Body body{material};
    Matrix3 f = diagonal(1.01, 1.01, 1.01);
    f(0, 1) = 0.01;
    body.strain_to(f, 1000);
    const double least = -std::min(strength, apex);
    EXPECT_NEAR(body.p(), least, 1e-9 * bulk);
    EXPECT_LE(body.q(), law.cone().cohesion + law.cone().slope * least + 1e-9 * bulk);
    EXPECT_GT(body.points.void_volume[0], 0.02 * body.points.volume[0]);
    f = diagonal(0.999, 0.999, 0.999);
    body.strain_to(f, 1000);
    EXPECT_EQ(body.points.void_volume[0], 0.0);  // the gap is closed before the pressure rises
    EXPECT_NEAR(body.p(), bulk * (std::pow(0.999, -3) - 1), 2e-3 * body.p());
  }
}

TEST(DruckerPrager, StrengthEndsAtTheGreatest) {
  DruckerPrager law = clay(MatchedStates::plane_strain);
  law.maximum_strength = 50e3;
  law.prepare();
  EXPECT_EQ(law.surface({.pressure = 1e6, .rate = 0}).strength(0.0), 50e3);
  EXPECT_LT(law.surface({.pressure = 1e3, .rate = 0}).strength(0.0), 50e3);
}

TEST(DruckerPrager, ACriterionOfTensionSeesNoMoreThanTheGapsLeave) {
  const DruckerPrager law = clay(MatchedStates::plane_strain);
  const double apex = law.cone().cohesion / law.cone().slope;
  for (const auto& [strength, fails] : {std::pair{0.9 * apex, true}, std::pair{1.1 * apex, false}}) {
    const Material material = soil(law, {std::make_shared<failure::CriterionModel<failure::TensilePressure>>(
                                            failure::TensilePressure{{}, strength})});
    Body body{material};
    body.strain_to(diagonal(1.01, 1.01, 1.01), 3);  // far beyond both in one step
    EXPECT_EQ(body.points.failed[0] != failure::intact, fails);
  }
}

TEST(DruckerPrager, NeverGivesWorkBack) { expect_dissipation(soil(clay(MatchedStates::plane_strain)), 11); }

GranularFlow beads() {  // Jop, Forterre and Pouliquen (2006)
  GranularFlow law;
  law.shear_modulus = 30e6;
  law.static_friction = 0.382;
  law.limiting_friction = 0.643;
  law.reference_number = 0.279;
  law.grain_size = 0.53e-3;
  law.grain_density = 2450;
  return law;
}

TEST(GranularFlow, NeverGivesWorkBack) { expect_dissipation(soil(beads()), 11); }

TEST(GranularFlow, ShearStressIsTheFrictionAtTheInertialNumber) {
  const GranularFlow law = beads();
  const Material material = soil(law);
  Body body{material};
  Matrix3 f = diagonal(0.999, 0.999, 0.999);
  body.strain_to(f, 100);
  for (const double steps : {200.0, 2000.0, 20000.0}) {
    const Matrix3 from = body.place;
    f(0, 1) += 0.2;
    for (int i = 1; i <= static_cast<int>(steps); ++i) body.strain_to((from + (f - from) * i / steps).eval());
    const double rate = 0.2 / steps / 0.999 / dt, p = body.p();
    const double number = rate * law.grain_size * std::sqrt(law.grain_density / p);
    const double shear = body.q() / std::numbers::sqrt3;
    EXPECT_GT(number, 0.0);
    EXPECT_NEAR(shear / p, law.friction(number), 2e-3) << "I = " << number;
  }
  EXPECT_NEAR(law.friction(law.reference_number), 0.5 * (0.382 + 0.643), 1e-15);
  EXPECT_EQ(law.friction(0.0), 0.382);
}

TEST(GranularFlow, FrictionThatFallsWithTheRateIsRefused) {
  GranularFlow law = beads();
  law.limiting_friction = 0.3;
  try {
    (void)soil(law);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("limiting_friction"));
  }
}

TEST(GranularFlow, GrainsNotDenserThanTheSoilAreRefused) {
  GranularFlow law = beads();
  law.grain_density = 2001;
  EXPECT_NO_THROW((void)soil(law));
  law.grain_density = 2000;  // that of the soil: no room for pores
  try {
    (void)soil(law);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("'grain_density' 2000 kg/m^3 must be above"));
  }
}

}  // namespace soil_test
}  // namespace whipple

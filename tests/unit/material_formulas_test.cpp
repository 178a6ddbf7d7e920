// SPDX-License-Identifier: BSD-3-Clause
// Formulas of one material point: kinematics, elastic trial, artificial viscosity.
#include <gtest/gtest.h>

#include <cmath>

#include "src/material/kinematic_formulas.hpp"
#include "src/material/viscosity_formulas.hpp"
#include "src/material/void_formulas.hpp"

namespace whipple::material::formulas {
namespace {

constexpr Matrix<double> stretch_and_turn = {30.0, 80.0, -20.0, -50.0, -10.0,
                                             40.0, 25.0, -60.0, 15.0};  // 1/s
constexpr double dt = 1e-3;

/// The strain of the polar decomposition is 2 (V - I)(V + I)^-1 = ln V to third order; a rotation has none.
TEST(MaterialFormulas, RotationsAreOrthogonalAndStrainNothing) {
  const Motion<double> polar = motion_of<StressRotation::polar>(stretch_and_turn, dt),
                       midpoint = motion_of<StressRotation::hughes_winget>(stretch_and_turn, dt);
  for (const Motion<double>& motion : {polar, midpoint}) {
    const Matrix<double>& r = motion.rotation;
    const Matrix<double> one =
        multiply(r, Matrix<double>{r.xx, r.yx, r.zx, r.xy, r.yy, r.zy, r.xz, r.yz, r.zz});
    EXPECT_NEAR(one.xx, 1.0, 1e-15);
    EXPECT_NEAR(one.xy, 0.0, 1e-15);
    EXPECT_NEAR(one.yz, 0.0, 1e-15);
    EXPECT_NEAR(determinant(r), 1.0, 1e-15);
  }
  const double volume_ratio = determinant(identity_plus(dt, stretch_and_turn));
  const Symmetric<double>& e = polar.strain;
  EXPECT_NEAR(e.xx + e.yy + e.zz, std::log(volume_ratio), 1e-5);
  const double angle = 0.3;  // of a rotation about z: I + dt L = R
  const Matrix<double> turning = {(std::cos(angle) - 1.0) / dt,
                                  -std::sin(angle) / dt,
                                  0.0,
                                  std::sin(angle) / dt,
                                  (std::cos(angle) - 1.0) / dt,
                                  0.0,
                                  0.0,
                                  0.0,
                                  0.0};
  const Motion<double> rigid = motion_of<StressRotation::polar>(turning, dt);
  EXPECT_NEAR(rigid.rotation.yx, std::sin(angle), 1e-14);
  EXPECT_NEAR(rigid.strain.xx, 0.0, 1e-14);
  EXPECT_NEAR(rigid.strain.xy, 0.0, 1e-14);
  // The trial rotates the stress, which keeps its equivalent.
  const Symmetric<double> stress = {3e8, -1e8, -2e8, 5e7, -4e7, 1e8};
  const Trial<double> trial = elastic_trial(stress, rigid, 40e9);
  const double norm = 9e16 + 1e16 + 4e16 + 2.0 * (25e14 + 16e14 + 1e16);
  EXPECT_NEAR(trial.equivalent, std::sqrt(1.5 * norm), 1e-6 * trial.equivalent);
  EXPECT_NEAR(trial.deviator.xx + trial.deviator.yy, 2e8, 1e-6 * 2e8);
  EXPECT_GT(std::abs(trial.deviator.xx - stress.xx), 1e7);
}

/// The trial adds 2 G dev e: sqrt(3) G gamma of a shear, 3 G e of an extension at constant volume.
TEST(MaterialFormulas, TrialFollowsHooke) {
  constexpr Matrix<double> none = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  const Motion<double> extension = {{2e-3, 0.5e-3, 0.5e-3, 0.0, 0.0, 0.0}, none};  // of which 1e-3 is volume
  EXPECT_DOUBLE_EQ(elastic_trial<double>({}, extension, 26e9).equivalent, 3.0 * 26e9 * 1e-3);
  const Motion<double> shear = {{0.0, 0.0, 0.0, 0.5e-3, 0.0, 0.0}, none};  // gamma = 1e-3
  EXPECT_DOUBLE_EQ(elastic_trial<double>({}, shear, 26e9).equivalent, std::sqrt(3.0) * 26e9 * 1e-3);
}

TEST(MaterialFormulas, ViscosityIsQuadraticAndLinearAndHeatsByTheAffineField) {
  UpdateSettings settings;
  settings.quadratic_viscosity = 1.5;
  settings.linear_viscosity = 0.25;
  settings.expansion_viscosity = 0.5;
  settings.affine_gain = 2.0;
  EXPECT_DOUBLE_EQ(artificial_viscosity(settings, 2000.0, 100.0, 4000.0), 2000.0 * 100.0 * (150.0 + 1000.0));
  EXPECT_DOUBLE_EQ(expansion_viscosity(settings, 2000.0, 100.0, 4000.0, 1e12), 2000.0 * 100.0 * 0.5 * 4000.0);
  EXPECT_EQ(expansion_viscosity(settings, 2000.0, 100.0, 4000.0, 5.0), 5.0);   // never below zero pressure
  EXPECT_EQ(expansion_viscosity(settings, 2000.0, 100.0, 4000.0, -5.0), 0.0);  // none in tension
  const double per_range = 1.0 / 0.2;  // compression from which all of the viscosity heats
  EXPECT_DOUBLE_EQ(heating_closing_speed(settings, 100.0, 20.0, 0.0, per_range), 40.0);
  EXPECT_DOUBLE_EQ(heating_closing_speed(settings, 100.0, 20.0, 0.1, per_range), 70.0);
  EXPECT_DOUBLE_EQ(heating_closing_speed(settings, 100.0, 20.0, 0.3, per_range), 100.0);
  EXPECT_DOUBLE_EQ(heating_closing_speed(settings, 100.0, 60.0, 0.0, per_range), 100.0);  // the field follows
}

/// A point in tension opens a void until its pressure is the least one, at most by a tenth of its volume in a step; in
/// compression the void closes first. Half of the opening leaves half of the excess in the material.
TEST(MaterialFormulas, TensionOpensVoidsAndPressureClosesThem) {
  constexpr double modulus = 100e9, least = -1e9, volume = 2e-9;
  const auto opens = share_volume<double>({-3e9, volume, 0.0}, modulus, 1.0, least);
  EXPECT_EQ(opens.point.pressure, least);
  EXPECT_DOUBLE_EQ(opens.point.volume, volume * (1.0 - 0.02));          // (p - least)/modulus
  EXPECT_NEAR(opens.point.void_volume, volume * 0.02, 4e-16 * volume);  // a difference of volumes
  EXPECT_FALSE(opens.limited);
  EXPECT_TRUE(share_volume<double>({-30e9, volume, 0.0}, modulus, 1.0, least).limited);
  const auto closes = share_volume<double>({3e9, volume, 0.01 * volume}, modulus, 1.0, least);
  EXPECT_DOUBLE_EQ(closes.point.pressure, 2e9);
  EXPECT_DOUBLE_EQ(closes.point.volume, 1.01 * volume);
  EXPECT_EQ(closes.point.void_volume, 0.0);
  const auto cracked = share_volume<double>({-2e9, volume, 0.0}, modulus, 0.5, 0.0);
  EXPECT_NEAR(cracked.point.void_volume, 0.5 * 0.02 * volume, 4e-16 * volume);
  EXPECT_NEAR(cracked.point.pressure, -1e9, 1.0);
  // The same in registers, lane by lane.
  const auto four = share_volume<whipple::Lanes>(
      {whipple::Lanes{-3e9, 3e9, -2e9, 1e9}, broadcast(volume), whipple::Lanes{0.0, 0.01 * volume, 0.0, 0.0}},
      broadcast(modulus), whipple::Lanes{1.0, 1.0, 0.5, 0.0}, whipple::Lanes{least, least, 0.0, 0.0});
  EXPECT_EQ(four.point.volume[0], opens.point.volume);
  EXPECT_EQ(four.point.pressure[1], closes.point.pressure);
  EXPECT_EQ(four.point.void_volume[2], cracked.point.void_volume);
  EXPECT_EQ(four.point.volume[3], volume);
}

}  // namespace
}  // namespace whipple::material::formulas

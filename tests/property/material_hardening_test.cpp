// SPDX-License-Identifier: BSD-3-Clause
// Elastic material, kinematic hardening and viscous fluid: closed solutions of homogeneous motions.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "src/material/strength/elastic.hpp"
#include "src/material/strength/power_law.hpp"
#include "src/material/strength/viscous_fluid.hpp"
#include "src/material/strength/voce.hpp"
#include "tests/unit/material_support.hpp"

namespace whipple {
namespace hardening_test {

using namespace material_test;

constexpr double dt = 1e-8;
const UpdateSettings settings{
    .time_step = dt, .cell_size = 1e-3, .linear_viscosity = 0.0, .quadratic_viscosity = 0.0};

template <class Model, class Constants>
Material of(const Constants& constants) {
  return make_material("test", std::make_shared<LinearInEnergy>(), std::make_shared<Model>(constants));
}

/// Stretches isochorically along x by a logarithmic strain in steps.
/// @returns the stress difference to the lateral one
double stretch(const Material& material, MaterialPoints& points, double strain, int steps) {
  const double step = strain / steps;
  Matrix3 gradient = Matrix3::Zero();
  gradient(0, 0) = std::expm1(step) / dt;
  gradient(1, 1) = gradient(2, 2) = std::expm1(-0.5 * step) / dt;
  for (int n = 0; n < steps; ++n) {
    points.specific_internal_energy[0] = 0.0;  // cold
    update_material(material, points, 0, 1, std::span(&gradient, 1), settings);
  }
  return points.deviatoric_stress[0].xx - points.deviatoric_stress[0].yy;
}

TEST(Elastic, StressFollowsHookeToAnyStrainAndReturns) {
  strength::Elastic constants;
  constants.youngs_modulus = 210e9;
  constants.poisson_ratio = 0.3;
  const Material material = of<strength::ElasticModel>(constants);
  MaterialPoints points = points_of(material, 1);
  const double shear = 210e9 / 2.6;
  EXPECT_NEAR(stretch(material, points, 0.3, 300), 3.0 * shear * 0.3, 1e-3 * shear);
  EXPECT_NEAR(stretch(material, points, -0.3, 300), 0.0, 1e-6 * shear);
  EXPECT_EQ(points.plastic_strain[0], 0.0);
}

// A point with the factor k flows at k (A + B ep): the increment of the plastic strain is then (3 G strain - k A)/(3 G + k B), and
// the elastic stress below k A is that of strong material.
TEST(StrengthFactor, ScalesTheFlowStressAndLeavesTheStiffness) {
  strength::VonMises constants;
  constants.shear_modulus = 40e9;
  constants.yield_stress = 200e6;
  constants.hardening_modulus = 3e9;
  const Material material = of<strength::VonMisesModel>(constants);
  for (const double factor : {1.0, 0.9, 0.5}) {
    MaterialPoints points = points_of(material, 1);
    points.strength_factor = {factor};
    EXPECT_NEAR(stretch(material, points, 1e-4 * factor, 1), 3 * 40e9 * 1e-4 * factor, 1.0);
    EXPECT_EQ(points.plastic_strain[0], 0.0);
    const double stress = stretch(material, points, 0.05, 500), ep = points.plastic_strain[0];
    EXPECT_NEAR(stress, factor * (200e6 + 3e9 * ep), 1e-6 * stress);
    EXPECT_NEAR(ep, (3 * 40e9 * (0.05 + 1e-4 * factor) - factor * 200e6) / (3 * 40e9 + factor * 3e9), 1e-7);
  }
}

TEST(StrengthFactor, IsOfMaterialThatFlows) {
  strength::VonMises metal;
  metal.shear_modulus = 40e9;
  metal.yield_stress = 200e6;
  strength::Elastic elastic;
  elastic.shear_modulus = 40e9;
  EXPECT_TRUE(of<strength::VonMisesModel>(metal).returns_radially());
  EXPECT_FALSE(of<strength::ElasticModel>(elastic).returns_radially());
}

/// Tests the yield stress on loading and reverse loading, after plastic strain ep: von Mises with A, B, H.
TEST(KinematicHardening, BauschingerEffectIsTwiceTheInitialYieldStress) {
  strength::VonMises constants;
  constants.shear_modulus = 40e9;
  constants.yield_stress = 200e6;
  constants.kinematic_modulus = 2e9;
  const Material material = of<strength::VonMisesModel>(constants);
  MaterialPoints points = points_of(material, 1);
  ASSERT_EQ(points.history.symmetric("back_stress").size(), 1U);
  const double forward = stretch(material, points, 0.05, 500);
  const double ep = points.plastic_strain[0];
  EXPECT_NEAR(ep, (3 * 40e9 * 0.05 - 200e6) / (3 * 40e9 + 2e9), 1e-7);
  EXPECT_NEAR(forward, 200e6 + 2e9 * ep, 1e2);
  // Reverse loading: elastic over 2 A, whatever the hardening
  const double before = points.plastic_strain[0];
  double reverse = forward;
  int steps = 0;
  while (points.plastic_strain[0] == before) {
    reverse = points.deviatoric_stress[0].xx - points.deviatoric_stress[0].yy;
    stretch(material, points, -1e-6, 1);
    ASSERT_LT(++steps, 10000);
  }
  EXPECT_NEAR(reverse, forward - 2 * 200e6, 0.2e6);
  // Isotropic hardening of the same slope yields at the opposite stress instead.
  constants.hardening_modulus = constants.kinematic_modulus;
  constants.kinematic_modulus = 0.0;
  const Material isotropic = of<strength::VonMisesModel>(constants);
  MaterialPoints other = points_of(isotropic, 1);
  const double same = stretch(isotropic, other, 0.05, 500);
  EXPECT_NEAR(same, forward, 1e2);
  const double hardened = other.plastic_strain[0];
  while (other.plastic_strain[0] == hardened) {
    reverse = other.deviatoric_stress[0].xx - other.deviatoric_stress[0].yy;
    stretch(isotropic, other, -1e-6, 1);
  }
  EXPECT_NEAR(reverse, -same, 0.2e6);
}

TEST(KinematicHardening, StressAndBackStressTurnWithTheMatter) {
  strength::VonMises constants = taylor_copper();
  constants.kinematic_modulus = 1e9;
  const Material material = of<strength::VonMisesModel>(constants);
  MaterialPoints points = points_of(material, 1);
  stretch(material, points, 0.02, 100);
  const Matrix3 stress = points.deviatoric_stress[0].matrix(),
                back = points.history.symmetric("back_stress")[0].matrix();
  ASSERT_GT(back.norm(), 1e7);
  EXPECT_NEAR(back.trace(), 0.0, 1e-6);
  const Vector3 axis = Vector3(1, -2, 0.5).normalized();
  const Matrix3 turn = Eigen::AngleAxisd(0.05, axis).toRotationMatrix();
  const Matrix3 gradient = (turn - Matrix3::Identity()) / dt;
  for (int n = 0; n < 40; ++n) update_material(material, points, 0, 1, std::span(&gradient, 1), settings);
  const Matrix3 whole = Eigen::AngleAxisd(2.0, axis).toRotationMatrix();
  EXPECT_LT((points.history.symmetric("back_stress")[0].matrix() - whole * back * whole.transpose()).norm(),
            1e-10 * back.norm());
  EXPECT_LT((points.deviatoric_stress[0].matrix() - whole * stress * whole.transpose()).norm(),
            1e-10 * stress.norm());
}

TEST(KinematicHardening, YieldConditionHoldsBesideTheBackStressForEveryHardeningLaw) {
  strength::PowerLaw power;
  power.shear_modulus = 27e9;
  power.yield_stress = 50e6;
  power.hardening_coefficient = 300e6;
  power.hardening_exponent = 0.3;
  power.kinematic_modulus = 500e6;
  strength::Voce voce;
  voce.shear_modulus = 27e9;
  voce.yield_stress = 50e6;
  voce.first_saturation = 100e6;
  voce.first_rate = 20.0;
  voce.kinematic_modulus = 300e6;
  const std::array materials = {of<strength::PowerLawModel>(power), of<strength::VoceModel>(voce)};
  std::mt19937_64 generator(5);
  for (int k = 0; k < 2; ++k) {
    MaterialPoints points = points_of(materials[static_cast<std::size_t>(k)], 1);
    for (int n = 0; n < 500; ++n) {
      const Matrix3 gradient = random_matrix(generator, 2e-3 / dt);
      const double before = points.plastic_strain[0];
      points.specific_internal_energy[0] = 0.0;
      points.volume[0] = 1e-9;
      update_material(materials[static_cast<std::size_t>(k)], points, 0, 1, std::span(&gradient, 1),
                      settings);
      if (points.plastic_strain[0] == before) continue;
      const double y =
          k == 0 ? power.flow_stress(points.plastic_strain[0]) : voce.flow_stress(points.plastic_strain[0]);
      SymmetricTensor shifted = SymmetricTensor::from(points.deviatoric_stress[0].matrix() -
                                                      points.history.symmetric("back_stress")[0].matrix());
      ASSERT_NEAR(equivalent_stress(shifted), y, 1e-6 * y) << n;
    }
    EXPECT_GT(points.plastic_strain[0], 0.1);
  }
}

TEST(KinematicHardening, MeltingTakesTheBackStressAlong) {
  LinearInEnergy eos;
  eos.melting_starts = 400e3;
  eos.melting_ends = 600e3;
  strength::VonMises constants = taylor_copper();
  constants.kinematic_modulus = 1e9;
  const Material material = with(constants, {}, eos);
  MaterialPoints points = points_of(material, 1);
  stretch(material, points, 0.02, 100);
  const double back = equivalent_stress(points.history.symmetric("back_stress")[0]);
  const Matrix3 rest = Matrix3::Zero();
  for (const auto& [energy, solid] : {std::pair{500e3, 0.5}, {700e3, 0.0}}) {
    points.specific_internal_energy[0] = energy;
    points.pressure[0] = 0.0;
    update_material(material, points, 0, 1, std::span(&rest, 1), settings);
    EXPECT_NEAR(equivalent_stress(points.history.symmetric("back_stress")[0]), solid * back, 0.01 * back);
  }
}

TEST(ViscousFluid, PlaneCouetteFlowHasTheExactStressAndHeat) {
  // tau = eta rate, e = eta rate^2 t / rho: Batchelor (1967).
  const double viscosity = 2.0, rate = 1e4;
  const Material material = of<strength::ViscousFluidModel>(strength::ViscousFluid{viscosity});
  Matrix3 gradient = Matrix3::Zero();
  gradient(0, 1) = rate;
  MaterialPoints points = points_of(material, 1), twin = points;
  constexpr int steps = 1000;
  for (int n = 0; n < steps; ++n) {
    step_with_work(material, points, gradient, settings);
    update_material_and_energy(material, twin, 0, 1, std::span(&gradient, 1), settings);
    ASSERT_NEAR(points.deviatoric_stress[0].xy, viscosity * rate, 1e-9 * viscosity * rate);
    ASSERT_NEAR(points.deviatoric_stress[0].xx, 0.0, 1e-9);
  }
  const double heat = viscosity * rate * rate * steps * dt / 8930.0;
  EXPECT_NEAR(points.specific_internal_energy[0], heat, 2e-3 * heat);  // the first step had no stress yet
  EXPECT_NEAR(twin.specific_internal_energy[0], heat, 2e-3 * heat);
  EXPECT_EQ(points.plastic_strain[0], 0.0);
  EXPECT_NEAR(points.sound_speed[0], 3940.0, 10.0);
  const Matrix3 rest = Matrix3::Zero();
  step_with_work(material, points, rest, settings);
  EXPECT_EQ(points.deviatoric_stress[0].squared_norm(), 0.0);  // no memory
}

TEST(ViscousFluid, PureExpansionHasNoViscousStress) {
  const Material material = of<strength::ViscousFluidModel>(strength::ViscousFluid{5.0});
  MaterialPoints points = points_of(material, 1);
  const Matrix3 gradient = 1e3 * Matrix3::Identity();
  step_with_work(material, points, gradient, settings);
  EXPECT_NEAR(std::sqrt(points.deviatoric_stress[0].squared_norm()), 0.0, 1e-9);
}

}  // namespace hardening_test
}  // namespace whipple

// SPDX-License-Identifier: BSD-3-Clause
// Failure models with memory or with principal values: published formulas and loci, energy of the release.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "src/material/failure/grady_kipp.hpp"
#include "src/material/failure/gurson.hpp"
#include "src/material/failure/johnson_cook_damage.hpp"
#include "src/material/failure/principal_strain.hpp"
#include "src/material/failure/principal_stress.hpp"
#include "src/material/principal.hpp"
#include "src/material/strength/elastic.hpp"
#include "tests/unit/material_support.hpp"

namespace whipple {
namespace {

using namespace material_test;

constexpr double dt = 1e-8;
const UpdateSettings settings{
    .time_step = dt, .cell_size = 1e-3, .linear_viscosity = 0.0, .quadratic_viscosity = 0.0};

template <class Law>
std::shared_ptr<const failure::Criterion> criterion(const Law& law) {
  return std::make_shared<failure::CriterionModel<Law>>(law);
}

strength::VonMises strong() {
  strength::VonMises constants = taylor_copper();
  constants.yield_stress = 1e12;
  return constants;
}

Matrix3 uniaxial(double rate, const Matrix3& frame = Matrix3::Identity()) {
  Matrix3 gradient = Matrix3::Zero();
  gradient(0, 0) = rate;
  return frame * gradient * frame.transpose();
}

Matrix3 frame(double angle, const Vector3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

double greatest_stress(const MaterialPoints& points) {
  return material::greatest_principal_value(points.deviatoric_stress[0]) - points.pressure[0];
}

TEST(PrincipalStress, FailsAtTheStrengthInEveryDirection) {
  const Material material = with(strong(), {criterion(failure::PrincipalStress{{}, 0.8e9})});
  for (const double scatter : {1.0, 0.5}) {
    const Matrix3 turn = frame(0.7 + scatter, {1, 2, 3});
    MaterialPoints points = points_of(material, 1);
    points.failure_threshold_factor.assign(points.mass.size(), scatter);
    double highest = 0.0;
    while (points.failed[0] == failure::intact) {
      highest = std::max(highest, greatest_stress(points));
      step_with_work(material, points, uniaxial(1e-5 / dt, turn), settings);
      ASSERT_LT(points.volume[0], 1.1e-9);
    }
    EXPECT_EQ(points.failed[0], failure::principal_stress);
    EXPECT_NEAR(highest, scatter * 0.8e9, 3e6);  // one step is 2 MPa
    EXPECT_EQ(points.deviatoric_stress[0].squared_norm(), 0.0);
    EXPECT_GE(points.pressure[0], 0.0);
  }
  // Compression in all directions with enough shear to tear: the pressure prevents failure.
  MaterialPoints points = points_of(material, 1);
  Matrix3 gradient = -0.02 / dt * Matrix3::Identity();
  gradient(0, 1) = 0.02 / dt;  // s_xy = 0.87 GPa against p = 8 GPa
  step_with_work(material, points, gradient, settings);
  EXPECT_EQ(points.failed[0], failure::intact);
}

TEST(PrincipalStrain, FailsAtTheLogarithmicStrainWhileTheMatterTurns) {
  const Material material = with(taylor_copper(), {criterion(failure::PrincipalStrain{{}, 0.3})});
  MaterialPoints points = points_of(material, 1);
  ASSERT_EQ(points.history.symmetric("strain").size(), 1U);
  double stretch = 1.0, angle = 0.0;
  Matrix3 before = Matrix3::Identity();
  while (points.failed[0] == failure::intact) {
    stretch *= 1.0005;
    angle += 0.002;
    const Matrix3 now =
        frame(angle, {0.2, 0.1, 1.0}) *
        Matrix3(Vector3(stretch, 1 / std::sqrt(stretch), 1 / std::sqrt(stretch)).asDiagonal());
    const Matrix3 gradient = gradient_between(before, now, dt);
    before = now;
    points.specific_internal_energy[0] = 0.0;
    update_material(material, points, 0, 1, std::span(&gradient, 1), settings);
    ASSERT_LT(stretch, 2.0);
  }
  EXPECT_EQ(points.failed[0], failure::principal_strain);
  EXPECT_NEAR(std::log(stretch), 0.3, 0.002);
}

failure::JohnsonCookDamage ofhc_damage() {  // Johnson and Cook (1985), OFHC copper
  failure::JohnsonCookDamage law;
  law.d1 = 0.54;
  law.d2 = 4.89;
  law.d3 = -3.03;
  law.d4 = 0.014;
  law.d5 = 1.12;
  law.reference_temperature = 294.0;
  law.melting_temperature = 1356.0;
  return law;
}

TEST(JohnsonCookDamage, GivesThePublishedFailureStrains) {
  const failure::JohnsonCookDamage copper = ofhc_damage();
  // 0.54 + 4.89 exp(-3.03 t): torsion 5.43, uniaxial tension 0.54 + 4.89 * 0.364219 = 2.32103
  EXPECT_NEAR(copper.failure_strain(0.0, 1.0, 294.0), 5.43, 1e-9);
  EXPECT_NEAR(copper.failure_strain(1.0 / 3.0, 1.0, 294.0), 2.32103, 1e-5);
  // rate 1e4: * (1 + 0.014 * 9.210340) = 1.1289448; 825 K: T* = 0.5, * 1.56
  EXPECT_NEAR(copper.failure_strain(1.0 / 3.0, 1e4, 825.0), 2.32103 * 1.1289448 * 1.56, 1e-4);
  EXPECT_EQ(copper.failure_strain(7.0, 1.0, 294.0), copper.failure_strain(1.5, 1.0, 294.0));
  failure::JohnsonCookDamage bounded = copper;
  bounded.least_failure_strain = 0.9;
  EXPECT_EQ(bounded.failure_strain(7.0, 1.0, 294.0), 0.9);  // 0.54 + 4.89 exp(-4.545) = 0.592
  EXPECT_EQ(copper.failure_strain(0.0, 1e-9, 100.0), copper.failure_strain(0.0, 1.0, 294.0));
  EXPECT_EQ(copper.failure_strain(0.0, 1.0, eos::State::unknown), copper.failure_strain(0.0, 1.0, 294.0));
  EXPECT_TRUE(std::isfinite(copper.failure_strain(-1e9, 1.0, 294.0)));
  failure::JohnsonCookDamage steel =
      copper;  // 4340: 0.05 + 3.44 exp(-2.12/3) = 0.05 + 3.44 * 0.4932858 = 1.746903
  steel.d1 = 0.05;
  steel.d2 = 3.44;
  steel.d3 = -2.12;
  EXPECT_NEAR(steel.failure_strain(1.0 / 3.0, 1.0, 294.0), 1.746903, 2e-6);
  failure::JohnsonCookDamage iron =
      copper;  // Armco: -2.20 + 5.43 exp(-0.47/3) = -2.20 + 5.43 * 0.8549890 = 2.442590
  iron.d1 = -2.20;
  iron.d2 = 5.43;
  iron.d3 = -0.47;
  EXPECT_NEAR(iron.failure_strain(1.0 / 3.0, 1.0, 294.0), 2.442590, 2e-6);
}

TEST(JohnsonCookDamage, ShearFailsWhereTheDamageOfItsStrainsIsOne) {
  failure::JohnsonCookDamage law = ofhc_damage();
  law.d1 = 0.1;
  law.d2 = 0.9;
  law.d4 = 0.0;
  law.d5 = 0.0;
  LinearInEnergy eos;
  eos.gamma = 0.0;  // no pressure from heat: triaxiality 0
  for (const double scatter : {1.0, 0.6}) {
    const Material material = with(taylor_copper(), {criterion(law)}, eos);
    MaterialPoints points = points_of(material, 1);
    points.failure_threshold_factor.assign(points.mass.size(), scatter);
    Matrix3 gradient = Matrix3::Zero();
    gradient(0, 1) = 2e-3 / dt;
    double damage = 0.0;
    while (points.failed[0] == failure::intact) {
      ASSERT_GE(points.history.scalar("damage")[0], damage);
      damage = points.history.scalar("damage")[0];
      step_with_work(material, points, gradient, settings);
      ASSERT_LT(points.plastic_strain[0], 2.0);
    }
    EXPECT_EQ(points.failed[0], failure::fractured);
    EXPECT_EQ(points.history.scalar("damage")[0], 1.0);
    EXPECT_NEAR(points.plastic_strain[0], scatter * 1.0, 0.002);
  }
}

failure::GradyKipp basalt_flaws() {  // Benz and Asphaug, Icarus 107 (1994) 98
  failure::GradyKipp law;
  law.flaw_density = 5e34;
  law.weibull_modulus = 8.5;
  return law;
}

TEST(GradyKipp, StrengthFollowsThePublishedPowerOfTheStrainRate) {
  // sigma_M = M (m+3) (m+4)^(-(m+4)/(m+3)) alpha^(-1/(m+3)) rate^(3/(m+3)): Grady and Kipp (1980), Melosh et
  // al. (1992); M the modulus of uniaxial strain.
  const failure::GradyKipp law = basalt_flaws();
  const Material material = with(strong(), {criterion(law)});
  const LinearInEnergy eos;
  const double modulus = eos.rho0 * eos.c0 * eos.c0 + 4.0 / 3.0 * strong().shear_modulus;
  const double m = law.weibull_modulus, speed = 0.4 * std::sqrt(modulus / eos.rho0);
  const double alpha =
      8.0 * std::numbers::pi * std::pow(speed, 3) * law.flaw_density / ((m + 1.0) * (m + 2.0) * (m + 3.0));
  for (const double rate : {1e3, 1e4, 1e5}) {
    MaterialPoints points = points_of(material, 1);
    points.mass[0] *= 1e9;  // so large that flaws are active at any strain
    initialise(material, points, 0, 1);
    const double expected = modulus * (m + 3.0) * std::pow(m + 4.0, -(m + 4.0) / (m + 3.0)) *
                            std::pow(alpha, -1.0 / (m + 3.0)) * std::pow(rate, 3.0 / (m + 3.0));
    UpdateSettings small = settings;
    small.time_step = expected / modulus / rate / 2000.0;
    double peak = 0.0, last_energy = 0.0;
    while (points.failed[0] == failure::intact) {
      step_with_work(material, points, uniaxial(rate), small);
      peak = std::max(peak, greatest_stress(points));
      ASSERT_LT(points.volume[0], 1.1);
      last_energy = points.specific_internal_energy[0];
    }
    EXPECT_EQ(points.failed[0], failure::fragmented);
    EXPECT_NEAR(peak, expected, 0.01 * expected) << rate;
    // All the work becomes heat; less than twice the elastic energy at the peak.
    EXPECT_GT(last_energy, 0.0);
    EXPECT_LT(last_energy, 2.0 * peak * peak / (2.0 * modulus * eos.rho0));
  }
}

TEST(GradyKipp, NoFlawGrowsBelowTheStrainAtWhichThePointHoldsOne) {
  const failure::GradyKipp law = basalt_flaws();
  const Material material = with(strong(), {criterion(law)});
  const double threshold = std::pow(law.flaw_density * 1e-9, -1.0 / law.weibull_modulus);
  for (const double scatter : {1.0, 1.4}) {
    MaterialPoints points = points_of(material, 1);
    points.failure_threshold_factor.assign(points.mass.size(), scatter);
    double strain = 0.0;
    while (points.history.scalar("damage")[0] == 0.0) {
      step_with_work(material, points, uniaxial(1e-6 / dt), settings);
      strain += 1e-6;
      ASSERT_LT(strain, 0.1);
    }
    EXPECT_NEAR(strain, scatter * threshold, 2e-3 * threshold + 2e-6);
  }
}

/// Returns half damaged material that carries tension without further damage (its flaws are too strong).
MaterialPoints half_damaged(const Material& material) {
  MaterialPoints points = points_of(material, 1);
  points.history.scalar("damage")[0] = 0.5;
  points.failure_threshold_factor.assign(points.mass.size(), 1e6);
  return points;
}

TEST(SofteningMatter, BearsHalfTheTensionAndAllThePressureAndClosesItsCracksWithoutLoss) {
  const Material material = with(strong(), {criterion(basalt_flaws())});
  const LinearInEnergy eos;
  const double bulk = eos.rho0 * eos.c0 * eos.c0, shear = strong().shear_modulus, strain = 1e-3;
  MaterialPoints points = half_damaged(material);
  constexpr int steps = 200;
  double total = 1e-9;
  Matrix3 before = Matrix3::Zero();
  const auto go = [&](double step) {
    const Matrix3 gradient = uniaxial(std::expm1(step) / dt);
    for (int n = 0; n < steps; ++n) {
      step_with_work(material, points, gradient, settings, before);
      before = gradient;
      total *= volume_ratio(gradient, dt);
      ASSERT_NEAR(points.volume[0] + points.void_volume[0], total, 1e-12 * total);
    }
  };
  go(strain / steps);
  EXPECT_NEAR(points.pressure[0], -0.5 * bulk * strain, 2e-3 * bulk * strain);
  EXPECT_NEAR(points.deviatoric_stress[0].xx, 0.5 * 4.0 / 3.0 * shear * strain, 2e-3 * shear * strain);
  EXPECT_NEAR(points.void_volume[0], 0.5 * strain * 1e-9, 2e-3 * strain * 1e-9);
  const double stored = 0.25 * (bulk + 4.0 / 3.0 * shear) * strain * strain / eos.rho0;
  EXPECT_NEAR(points.specific_internal_energy[0], stored, 0.02 * stored);
  go(-strain / steps);
  EXPECT_NEAR(points.specific_internal_energy[0], 0.0, 0.01 * stored);
  EXPECT_NEAR(points.pressure[0], 0.0, 0.01 * bulk * strain);
  go(-strain / steps);  // compressed: cracks closed, full bulk stiffness
  EXPECT_EQ(points.void_volume[0], 0.0);
  EXPECT_NEAR(points.pressure[0], bulk * strain, 0.01 * bulk * strain);
  EXPECT_EQ(points.history.scalar("damage")[0], 0.5);
}

TEST(SofteningMatter, SchemeWithoutWorkIdentityBooksTheSameEnergy) {
  const Material material = with(strong(), {criterion(basalt_flaws())});
  MaterialPoints points = half_damaged(material), twin = half_damaged(material);
  const Matrix3 gradient = uniaxial(5e-6 / dt);
  for (int n = 0; n < 200; ++n) {
    step_with_work(material, points, gradient, settings);
    update_material_and_energy(material, twin, 0, 1, std::span(&gradient, 1), settings);
  }
  EXPECT_NEAR(twin.specific_internal_energy[0], points.specific_internal_energy[0],
              0.02 * points.specific_internal_energy[0]);
}

failure::Gurson voids(double porosity) {
  failure::Gurson law;
  law.q1 = 1.0;
  law.initial_porosity = porosity;
  law.failure_porosity = 0.5;
  return law;
}

TEST(Gurson, SphericalTensionYieldsAtTheExactPressureOfTheHollowSphere) {
  // p = 2/3 Y ln(1/f): Gurson (1977); exact for a sphere of perfectly plastic material with a hole in its centre. Where
  // part of the material has melted, Y is multiplied by the solid fraction.
  strength::VonMises constants = taylor_copper();
  constants.hardening_modulus = 0.0;
  for (const double melted : {0.0, 0.4}) {
    LinearInEnergy eos;
    eos.gamma = 0.0;
    if (melted > 0.0) {
      eos.melting_starts = -melted * 1e12;  // equal melted fraction at every energy of the test
      eos.melting_ends = (1.0 - melted) * 1e12;
    }
    const double y = (1.0 - melted) * constants.yield_stress;
    for (const double porosity : {1e-3, 1e-2, 0.1}) {
      const Material material = with(constants, {criterion(voids(porosity))}, eos);
      MaterialPoints points = points_of(material, 1);
      EXPECT_NEAR(points.void_volume[0], 1e-9 * porosity / (1 - porosity), 1e-20);
      double total = points.volume[0] + points.void_volume[0];
      const double strain = 2e-6;
      const Matrix3 gradient = strain / dt * Matrix3::Identity();
      double f = porosity;
      int checked = 0;
      for (int n = 0; n < 4000 && points.failed[0] == failure::intact; ++n) {
        f = points.void_volume[0] / (points.volume[0] + points.void_volume[0]);  // at the start of the step
        step_with_work(material, points, gradient, settings);
        total *= volume_ratio(gradient, dt);
        ASSERT_NEAR(points.volume[0] + points.void_volume[0], total, 1e-12 * total);
        if (!(points.plastic_strain[0] > 0.0)) continue;
        const double now = points.void_volume[0] / total;
        const double acting = (1 - now) * points.pressure[0];  // on material and voids together
        ASSERT_NEAR(acting, -2.0 / 3.0 * y * std::log(1 / f), 2e-3 * y) << porosity << " " << n;
        ++checked;
      }
      EXPECT_GT(checked, 1000);
      EXPECT_GT(f, 1.02 * porosity);
      EXPECT_EQ(points.deviatoric_stress[0].squared_norm(), 0.0);
    }
  }
}

TEST(Gurson, ReturnEndsOnTheSurfaceAlongItsNormalFromAnyTrialState) {
  failure::Gurson law;
  law.failure_porosity = 0.25;
  law.critical_porosity = 0.15;
  law.initial_porosity = 0.01;
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double bulk = 139e9, shear = 43e9;
  int yielding = 0;
  for (int i = 0; i < 5000; ++i) {
    const double y = 50e6 + 900e6 * unit(generator), f = 0.24 * std::pow(unit(generator), 3) + 1e-5;
    const double q = std::pow(10.0, 6.0 + 4.0 * unit(generator));
    const double p = (unit(generator) - 0.5) * std::pow(10.0, 7.0 + 4.0 * unit(generator));
    const auto r = law.return_to_surface(q, p, bulk, shear, y, f);
    if (law.yield(q, std::clamp(p, -50 * y, 50 * y), y, f) <= 0.0) {
      ASSERT_EQ(r.pressure, p);
      ASSERT_EQ(r.equivalent, q);
      continue;
    }
    ++yielding;
    ASSERT_NEAR(law.yield(r.equivalent, r.pressure, y, f), 0.0, 1e-8) << i;
    ASSERT_NEAR(r.equivalent, q - 3 * shear * r.equivalent_strain, 1e-8 * q);
    ASSERT_NEAR(r.pressure, p + bulk * r.volumetric_strain, 1e-8 * std::abs(p));
    // normal: d eps_v / d eps_q = -(dg/dP)/(dg/dQ), by differences of g
    const double h = 1e-4 * y;
    const double by_q =
        law.yield(r.equivalent + h, r.pressure, y, f) - law.yield(r.equivalent - h, r.pressure, y, f);
    const double by_p =
        law.yield(r.equivalent, r.pressure + h, y, f) - law.yield(r.equivalent, r.pressure - h, y, f);
    const double size = std::hypot(by_q, by_p) * std::hypot(r.equivalent_strain, r.volumetric_strain);
    ASSERT_NEAR(r.volumetric_strain * by_q, -r.equivalent_strain * by_p, 1e-4 * size) << i;
  }
  EXPECT_GT(yielding, 2000);
}

TEST(Gurson, WithoutVoidsIsTheStrengthModelAndWithThemTheWorkIsThatOfTheMatrix) {
  Matrix3 gradient = uniaxial(1e-4 / dt);
  gradient(1, 1) = gradient(2, 2) = -0.45e-4 / dt;
  const auto pull = [&](const Material& material, int steps) {
    MaterialPoints points = points_of(material, 1);
    for (int n = 0; n < steps; ++n) step_with_work(material, points, gradient, settings);
    return points;
  };
  const MaterialPoints dense = pull(with(taylor_copper(), {criterion(voids(0.0))}), 300);
  const MaterialPoints plain = pull(with(taylor_copper()), 300);
  EXPECT_EQ(dense.deviatoric_stress[0].xx, plain.deviatoric_stress[0].xx);
  EXPECT_EQ(dense.pressure[0], plain.pressure[0]);
  EXPECT_EQ(dense.void_volume[0], 0.0);

  const Material material = with(taylor_copper(), {criterion(voids(0.02))});
  const MaterialPoints porous = pull(material, 300);
  EXPECT_GT(porous.void_volume[0] / (porous.volume[0] + porous.void_volume[0]), 0.021);
  EXPECT_LT(equivalent_stress(porous.deviatoric_stress[0]), equivalent_stress(plain.deviatoric_stress[0]));
  // e = Y dep of the matrix, plus the stored elastic energy
  const double ep = porous.plastic_strain[0], volume = 1.0 / 8930.0;
  const double work = (157e6 * ep + 0.5 * 425e6 * ep * ep) * volume;
  const LinearInEnergy eos;
  const double stored =
      porous.deviatoric_stress[0].squared_norm() / (4 * taylor_copper().shear_modulus) * volume +
      0.5 * std::pow(porous.pressure[0], 2) / (eos.rho0 * eos.c0 * eos.c0) * volume;
  EXPECT_NEAR(porous.specific_internal_energy[0], work + stored, 0.02 * (work + stored));
}

TEST(Gurson, VoidsNucleateCoalesceAndPartTheMatterAndCloseUnderPressure) {
  failure::Gurson law;
  law.initial_porosity = 0.0;
  law.nucleated_porosity = 0.04;
  law.nucleation_strain = 0.1;
  law.nucleation_scatter = 0.03;
  law.critical_porosity = 0.05;
  law.failure_porosity = 0.2;
  EXPECT_NEAR(law.effective(0.2), 1.0 / 1.5, 1e-12);
  EXPECT_EQ(law.effective(0.05), 0.05);
  const Material material = with(taylor_copper(), {criterion(law)});
  MaterialPoints points = points_of(material, 1);
  Matrix3 gradient = uniaxial(1e-4 / dt);
  gradient(1, 1) = gradient(2, 2) = -0.4e-4 / dt;
  double at_nucleation = 0.0;
  while (points.failed[0] == failure::intact) {
    step_with_work(material, points, gradient, settings);
    if (points.plastic_strain[0] < 0.02) {
      ASSERT_LT(points.void_volume[0], 5e-4 * points.volume[0]);
    }
    if (points.plastic_strain[0] < 0.2) at_nucleation = points.void_volume[0] / points.volume[0];
    ASSERT_LT(points.plastic_strain[0], 3.0);
  }
  EXPECT_GT(at_nucleation, 0.035);  // all nucleated by then
  EXPECT_EQ(points.failed[0], failure::void_growth);
  EXPECT_EQ(points.history.scalar("damage")[0], 1.0);
  EXPECT_GE(points.pressure[0], 0.0);
  EXPECT_EQ(points.deviatoric_stress[0].squared_norm(), 0.0);
  EXPECT_GT(points.void_volume[0] / (points.void_volume[0] + points.volume[0]), 0.19);

  const Material porous = with(taylor_copper(), {criterion(voids(0.05))});
  MaterialPoints crushed = points_of(porous, 1);
  for (int n = 0; n < 300; ++n) {
    const Matrix3 squeeze = -1e-4 / dt * Matrix3::Identity();
    step_with_work(porous, crushed, squeeze, settings);
    ASSERT_GE(crushed.void_volume[0], 0.0);
  }
  EXPECT_LT(crushed.void_volume[0], 1e-4 * crushed.volume[0]);
  EXPECT_GT(crushed.pressure[0], 1e9);
}

TEST(FailureModels, PartsThatDoNotGoTogetherAreRefused) {
  const auto message = [](auto&& make) -> std::string {
    try {
      make();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  using ::testing::AllOf;
  using ::testing::HasSubstr;
  EXPECT_THAT(
      message([] { with(strong(), {criterion(basalt_flaws()), criterion(ofhc_damage())}); }),
      AllOf(HasSubstr("grady_kipp"), HasSubstr("johnson_cook_damage"), HasSubstr("both keep the damage")));
  EXPECT_THAT(message([] {
                make_material("fluid", std::make_shared<LinearInEnergy>(), nullptr, {criterion(voids(0.01))});
              }),
              AllOf(HasSubstr("gurson"), HasSubstr("none")));
  strength::VonMises kinematic = strong();
  kinematic.kinematic_modulus = 1e9;
  EXPECT_THAT(message([&] { with(kinematic, {criterion(voids(0.01))}); }), HasSubstr("kinematic_modulus"));
  failure::JohnsonCookDamage hot = ofhc_damage();
  hot.melting_temperature = 200.0;
  EXPECT_THAT(message([&] { criterion(hot); }), HasSubstr("melting_temperature"));
  failure::Gurson open = voids(0.6);
  EXPECT_THAT(message([&] { criterion(open); }), HasSubstr("initial_porosity"));
  open = voids(0.1);
  open.q1 = 3.0;
  EXPECT_THAT(message([&] { criterion(open); }), HasSubstr("no strength left"));
}

}  // namespace
}  // namespace whipple

// SPDX-License-Identifier: BSD-3-Clause
// Soil that dilates: constants, returns, the volume that flow adds and its end, gaps, dissipation, closed cycles
// (docs/theory/soil.md, section 3).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "src/material/strength/drucker_prager.hpp"
#include "src/material/strength/mohr_coulomb.hpp"
#include "tests/unit/brittle_support.hpp"

namespace whipple {
namespace dilation_test {

using namespace brittle_test;
using strength::DruckerPrager;
using strength::DruckerPragerModel;
using strength::MatchedStates;
using strength::MohrCoulomb;
using strength::MohrCoulombModel;

constexpr double degree = std::numbers::pi / 180.0, bulk = 50e6, shear = 30e6, density = 2000.0;
constexpr double heat_capacity = 1000.0;

template <class Law>
Law sand(double friction, double dilation, double cohesion) {
  Law law;
  law.shear_modulus = shear;
  law.friction_angle = friction * degree;
  law.dilation_angle = dilation * degree;
  law.cohesion = cohesion;
  return law;
}

std::shared_ptr<const strength::Strength> model(const DruckerPrager& law) {
  return std::make_shared<const DruckerPragerModel>(law);
}
std::shared_ptr<const strength::Strength> model(const MohrCoulomb& law) {
  return std::make_shared<const MohrCoulombModel>(law);
}

template <class Law>
Material soil(const Law& law) {
  eos::PolynomialConstants constants;
  constants.reference_density = density;
  constants.C1 = bulk;
  constants.heat_capacity = heat_capacity;
  return make_material("soil", std::make_shared<eos::ModelEquationOfState<eos::Polynomial>>(constants),
                       model(law));
}

double plastic_volume_ratio(const Body& body) { return body.points.history.scalar("distension")[0]; }

/// Returns the elastic energy of a body (J): of the deviator, and of p = K mu at the density without the plastic volume.
double elastic_energy(const Body& body) {
  const double mass = body.points.mass[0], volume = body.points.volume[0];
  const double mu = mass / volume * plastic_volume_ratio(body) / density - 1.0;
  return body.points.deviatoric_stress[0].squared_norm() / (4.0 * shear) * volume +
         mass * bulk / density * (std::log1p(mu) - mu / (1.0 + mu));
}

template <class Law>
class Dilation : public testing::Test {};
using Laws = testing::Types<DruckerPrager, MohrCoulomb>;
TYPED_TEST_SUITE(Dilation, Laws);

TYPED_TEST(Dilation, AnAngleAboveThatOfFrictionIsRefused) {
  EXPECT_NO_THROW((void)soil(sand<TypeParam>(30, 30, 0)));
  try {
    (void)soil(sand<TypeParam>(30, 31, 0));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "'dilation_angle' 31 deg must not be above 'friction_angle' 30 deg: flow would give work back");
  }
}

TYPED_TEST(Dilation, AnEquationOfStateWithPhasesIsRefused) {
  try {
    (void)make_material("wrong", std::make_shared<LinearInEnergy>(), model(sand<TypeParam>(30, 10, 0)));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("changes the volume: it takes an equation of state without phases"));
  }
}

TYPED_TEST(Dilation, WithoutAnAngleTheVolumeIsTheElasticOne) {
  const Material material = soil(sand<TypeParam>(30, 0, 1e3));
  EXPECT_EQ(points_of(material, 1).history.find("distension"), nullptr);
}

/// Returns the cone of each match at an angle, for dilation as for friction.
TEST(DruckerPragerDilation, AtTheAngleOfFrictionFlowIsNormalToTheCone) {
  for (const MatchedStates match :
       {MatchedStates::compression, MatchedStates::extension, MatchedStates::plane_strain_associated}) {
    auto law = sand<DruckerPrager>(31, 31, 2e3);
    law.match = match;
    EXPECT_NEAR(law.dilation_slope(), law.cone().slope, 1e-14) << static_cast<int>(match);
  }
  // In plane strain without flow across: sin(psi) is the rate of volume over that of shear.
  const auto law = sand<DruckerPrager>(40, 17, 0);
  const double slope = law.dilation_slope(), across = -2.0 / 9.0 * slope;  // s_z/q
  const double half = std::sqrt((1.0 - 2.25 * across * across) / 3.0);     // (s_1 - s_3)/2 q
  EXPECT_NEAR(1.5 * across + slope / 3.0, 0.0, 1e-15);                     // rate of flow along z
  EXPECT_NEAR(slope / (2.0 * 1.5 * half), std::sin(17 * degree), 1e-14);
}

TEST(DruckerPragerDilation, RandomReturnsEndOnTheSurfaceWithTheVolumeOfTheirFlow) {
  auto law = sand<DruckerPrager>(35, 20, 5e3);
  law.maximum_strength = 400e3;
  law.prepare();
  const double slope = law.cone().slope, cohesion = law.cone().cohesion;
  const double end = (law.maximum_strength - cohesion) / slope;
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::array<int, 4> of_kind{};  // elastic, cone, corner, bounded
  for (int n = 0; n < 4000; ++n) {
    const double before = 0.06 * unit(generator), p = -cohesion / slope + 400e3 * unit(generator);
    const double q =
        2.0 * (cohesion + slope * p) * unit(generator) + (n % 2 == 0 ? 1e6 : 0.0) * unit(generator);
    const double growth = law.growth(
        {.pressure = p, .trial = q, .stiffness = bulk, .modulus = shear, .distension = std::exp(before)});
    const double after = p + bulk * growth, y = std::min(cohesion + slope * after, law.maximum_strength);
    const double x = (q - y) / (3.0 * shear), share = std::max(0.0, 1.0 - before / 0.05);
    ASSERT_GE(growth, 0.0);
    if (!(q > std::min(cohesion + slope * p, law.maximum_strength))) {
      EXPECT_EQ(growth, 0.0);
      ++of_kind[0];
      continue;
    }
    ASSERT_GE(x, 0.0) << n;
    const double flow = law.dilation_slope() * share * x;
    EXPECT_LE(growth, flow * (1.0 + 1e-9)) << n;
    EXPECT_GE(y * x - after * growth, 0.0) << "dissipation of " << n;
    if (growth > 0.0 && std::abs(growth - flow) < 1e-9 * flow) {
      ++of_kind[1];
    } else if (std::abs(after - end) < 1e-6 * end || p >= end) {
      ++of_kind[2];
    } else {
      EXPECT_NEAR(before + growth, std::max(before, 0.05), 1e-12) << n;
      ++of_kind[3];
    }
  }
  std::printf("elastic %d, cone %d, corner or Y_max %d, bounded %d\n", of_kind[0], of_kind[1], of_kind[2],
              of_kind[3]);
  for (const int count : of_kind) EXPECT_GT(count, 20);
}

// The two stages of a step, the volume at the modulus and then the deviator at the new pressure, are one return.
TEST(MohrCoulombDilation, TheStagesOfAStepAreOneReturn) {
  const MohrCoulombModel law(sand<MohrCoulomb>(33, 12, 5e3));
  const strength::Pyramid pyramid{std::sin(33 * degree), std::sin(12 * degree),
                                  2.0 * 5e3 * std::cos(33 * degree)};
  std::mt19937_64 generator(8);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int flowed = 0;
  for (int n = 0; n < 500; ++n) {
    const double p = 1e5 * (1.0 + unit(generator)), zero = 0.0, one = 1.0, modulus = shear, stiffness = bulk;
    const Matrix3 m = random_matrix(generator, 3e5);
    SymmetricTensor s = SymmetricTensor::from(0.5 * (m + m.transpose()));
    const double mean = (s.xx + s.yy + s.zz) / 3.0;
    s.xx -= mean, s.yy -= mean, s.zz -= mean;
    const Vector3 values = Eigen::SelfAdjointEigenSolver<Matrix3>(s.matrix()).eigenvalues();
    const strength::PrincipalStress once =
        strength::return_to(pyramid, bulk, shear, {values[2] - p, values[1] - p, values[0] - p});
    double q = equivalent_stress(s), share = 0, growth = 0, equivalent = q, increment = 0, strain = 0,
           least = 0;
    law.dilate({.stiffness = {&stiffness, 1},
                .pressure = {&p, 1},
                .void_volume = {&zero, 1},
                .modulus = {&modulus, 1},
                .solid_fraction = {&one, 1},
                .trial = {&q, 1},
                .distension = {&one, 1},
                .deviator = {&s, 1},
                .dilation = {&share, 1},
                .growth = {&growth, 1}});
    EXPECT_EQ(share, 1.0);
    const double after = p + bulk * growth;
    if (growth == 0.05) continue;  // the bound cut it
    double work = 0;
    strength::BrittleState state{};
    state.bulk_modulus = bulk;
    state.pressure = {&after, 1};
    state.modulus = {&modulus, 1};
    state.solid_fraction = {&one, 1};
    state.trial = {&q, 1};
    state.equivalent = {&equivalent, 1};
    state.plastic_increment = {&increment, 1};
    state.plastic_strain = {&strain, 1};
    state.least_pressure = {&least, 1};
    state.deviator = {&s, 1};
    state.work = {&work, 1};
    state.dilation = {&share, 1};
    law.relax(state);
    const Vector3 now = Eigen::SelfAdjointEigenSolver<Matrix3>(s.matrix()).eigenvalues();
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(now[2 - i] - after, once[static_cast<std::size_t>(i)], 1e-9 * (3e5 + p)) << n;
    }
    EXPECT_GE(work - after * growth, 0.0);
    flowed += growth > 0.0 ? 1 : 0;
  }
  EXPECT_GT(flowed, 300);
}

TEST(DruckerPragerDilation, ShearedSoilStaysOnTheConeAndDilatesToItsBound) {
  auto law = sand<DruckerPrager>(30, 12, 10e3);
  law.prepare();
  const Material material = soil(law);
  Body body{material};
  Matrix3 f = diagonal(0.999, 0.999, 0.999);
  body.strain_to(f, 100);
  for (int leg = 1; leg <= 6; ++leg) {
    f(0, 1) = (leg % 2 == 0 ? 0.1 : -0.1) * leg;
    body.strain_to(f, 4000);
    const double ratio = plastic_volume_ratio(body), p = body.p();
    EXPECT_NEAR(body.q(), law.cone().cohesion + law.cone().slope * p, 1e-9 * body.q());
    // p = K (rho J_p/rho_0 - 1)/J_p at the volume that the body is held to
    EXPECT_NEAR(p, bulk * (ratio * std::pow(0.999, -3) - 1.0) / ratio, 1e-9 * bulk);
    const double expected =
        0.05 * (1.0 - std::exp(-law.prepared_dilation * body.points.plastic_strain[0] / 0.05));
    EXPECT_NEAR(std::log(ratio), expected, 2e-3 * expected);
  }
  EXPECT_GT(std::log(plastic_volume_ratio(body)), 0.0499);
  EXPECT_LE(std::log(plastic_volume_ratio(body)), 0.05 * (1.0 + 1e-12));
}

// On a face the flow has the volume sin(psi) of its greatest shear.
TEST(MohrCoulombDilation, TheVolumeOfPlaneFlowIsTheSineOfTheAngleTimesItsShear) {
  for (const double psi : {3.0, 15.0, 33.0}) {
    auto law = sand<MohrCoulomb>(33, psi, 5e3);
    law.maximum_dilation = 0.5;
    const Material material = soil(law);
    Body body{material};
    body.strain_to(diagonal(0.998, 0.998, 0.998), 100);
    double volume = 0.0, sheared = 0.0;
    const Vector3 from = body.place.diagonal();
    for (int i = 1; i <= 2000; ++i) {
      const Vector3 next = from + Vector3(0.02, 0.0, -0.02) * (i / 2000.0);
      const SymmetricTensor s = body.points.deviatoric_stress[0];
      const double ratio = plastic_volume_ratio(body), share = 1.0 - std::log(ratio) / 0.5;
      const double strained = std::log(next[0] / body.place(0, 0)) - std::log(next[2] / body.place(2, 2));
      body.strain_to(diagonal(next[0], next[1], next[2]));
      const SymmetricTensor& t = body.points.deviatoric_stress[0];
      sheared += strained - ((t.xx - s.xx) - (t.zz - s.zz)) / (2.0 * shear);
      volume += std::log(plastic_volume_ratio(body) / ratio) / share;
      EXPECT_GT(t.xx, t.yy);
      EXPECT_GT(t.yy, t.zz);  // a face
    }
    EXPECT_NEAR(volume, std::sin(psi * degree) * sheared, 2e-3 * volume) << psi;
  }
}

// What separates is a gap: soil that flies, sheared, does not grow, and meets again at the volume that it left.
TYPED_TEST(Dilation, SeparationOpensTheGapAndNotThePlasticVolume) {
  for (const double cohesion : {0.0, 5e3}) {
    const Material material = soil(sand<TypeParam>(33, 20, cohesion));
    Body body{material};
    Matrix3 f = diagonal(1.0005, 1.0005, 1.0005);  // beyond the apex of both
    body.strain_to(f, 200);
    const double apart = plastic_volume_ratio(body);
    EXPECT_EQ(apart, 1.0);
    for (int cycle = 0; cycle < 5; ++cycle) {
      f = diagonal(1.03, 1.02, 1.05);
      f(0, 1) = 0.2 * (cycle % 2 == 0 ? 1 : -1);
      body.strain_to(f, 500);
      EXPECT_EQ(plastic_volume_ratio(body), apart);
      EXPECT_GT(body.points.void_volume[0], 0.09 * body.points.volume[0]);
      EXPECT_NEAR(body.p(), cohesion == 0.0 ? 0.0 : -cohesion / std::tan(33 * degree), 0.2 * cohesion + 1e-6);
    }
    // Closed along its own shear: on the last part, together, it may flow.
    f *= std::cbrt(0.9995 / f.determinant());
    body.strain_to(f, 2000);
    EXPECT_EQ(body.points.void_volume[0], 0.0);
    EXPECT_NEAR(body.p(), bulk * (plastic_volume_ratio(body) / 0.9995 - 1.0) / plastic_volume_ratio(body),
                1e-3 * bulk * 5e-4);
  }
}

TYPED_TEST(Dilation, NeverGivesWorkBack) {
  for (const auto& [friction, dilation, cohesion] :
       {std::array{33.0, 5.0, 5e3}, std::array{33.0, 20.0, 0.0}, std::array{20.0, 20.0, 10e3}}) {
    expect_dissipation(soil(sand<TypeParam>(friction, dilation, cohesion)), 11);
  }
}

/// Strains a body along straight lines to each place.
/// @returns its dissipation, J
double dissipation_along(Body& body, std::initializer_list<Matrix3> places, int steps) {
  double work = 0.0;
  for (const Matrix3& next : places) {
    const Matrix3 from = body.place;
    for (int i = 1; i <= steps; ++i) {
      work += body.strain_to((from + (next - from) * i / steps).eval()).plastic_work;
    }
  }
  work += body.strain_to(Matrix3(body.place)).plastic_work;
  return work;
}

// Normal flow on a cone without cohesion, at its apex p = q = 0, dissipates nothing at all.
TEST(DruckerPragerDilation, AssociatedFlowWithoutCohesionOnlyStoresItsWork) {
  auto law = sand<DruckerPrager>(30, 30, 0);
  law.match = MatchedStates::compression;
  law.maximum_dilation = 0.5;  // the angle stays
  const Material material = soil(law);
  Body body{material};
  Matrix3 f = diagonal(0.999, 0.999, 0.999), sheared = f;
  sheared(0, 1) = 0.01;
  body.strain_to(f, 1000);
  const double work = dissipation_along(body, {sheared}, 4000);
  const double grown = std::log(plastic_volume_ratio(body)), p = body.p();
  EXPECT_GT(grown, 1e-3);
  // What the angle has fallen by until then leaves a part of it.
  EXPECT_GE(work, 0.0);
  EXPECT_LT(work, 1.5 * grown / 0.5 * p * grown * body.points.volume[0]);
}

// Energy of a closed path: dissipation and what is stored in deviator and compression; the dissipation is heat.
TYPED_TEST(Dilation, EnergyOfAClosedPathIsItsDissipationAndWhatIsStored) {
  // At constant total volume: the hypoelastic deviator keeps its energy to the order of the change of volume only.
  const Matrix3 home = diagonal(0.999, 0.999, 0.999);
  Matrix3 sheared = home, other = home;
  sheared(0, 1) = 0.05;
  other(2, 1) = -0.04;
  double coarse = 0.0;
  for (const int steps : {2000, 20000}) {
    const Material material = soil(sand<TypeParam>(33, 15, 5e3));
    Body body{material};
    body.strain_to(home, steps);
    const double start = body.energy() - elastic_energy(body), warm = body.points.temperature[0];
    const double work = dissipation_along(body, {sheared, other, home}, steps);
    EXPECT_GT(plastic_volume_ratio(body), 1.0005);
    EXPECT_GT(work, 1.0 * body.points.volume[0]);
    const double error = std::abs(body.energy() - elastic_energy(body) - start - work) / work;
    const double heat = (body.points.temperature[0] - warm) * heat_capacity * body.points.mass[0];
    std::printf("%d steps: dissipation %.6e J, error %.2e, heat %.2e\n", steps, work, error,
                heat / work - 1.0);
    EXPECT_NEAR(heat, work, 2e-3 * work);
    EXPECT_LT(error, steps > 10000 ? 2.5e-5 : 2.5e-4);
    if (coarse > 0.0) {
      EXPECT_LT(error, 0.12 * coarse);  // first order
    }
    coarse = error;
  }
}

// Within the cone a closed path is elastic and returns all.
TYPED_TEST(Dilation, AClosedElasticPathReturnsAllEnergy) {
  const Material material = soil(sand<TypeParam>(33, 15, 50e3));
  Body body{material};
  const Matrix3 home = diagonal(0.999, 0.999, 0.999);
  body.strain_to(home, 4000);
  const double start = body.energy();
  Matrix3 sheared = diagonal(0.9992, 0.9988, 0.999);
  sheared(0, 1) = 0.0005;
  const double work = dissipation_along(body, {sheared, home}, 4000);
  EXPECT_EQ(work, 0.0);
  EXPECT_NEAR(body.energy(), start, 1e-6 * start);
}

}  // namespace dilation_test
}  // namespace whipple

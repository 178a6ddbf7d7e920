// SPDX-License-Identifier: BSD-3-Clause
// The pyramid of Mohr and Coulomb: its return against a minimisation in the energy norm, the flow without dilation,
// the law in the update of a material.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "src/material/strength/mohr_coulomb.hpp"
#include "tests/unit/brittle_support.hpp"

namespace whipple {
namespace mohr_coulomb_test {

using namespace brittle_test;
using strength::MohrCoulomb;
using strength::PrincipalStress;
using strength::Pyramid;

constexpr double degree = std::numbers::pi / 180.0, bulk = 50e6, shear = 30e6;

Pyramid pyramid(double friction, double dilation, double cohesion) {
  return {std::sin(friction * degree), std::sin(dilation * degree),
          2.0 * cohesion * std::cos(friction * degree)};
}

PrincipalStress descending(PrincipalStress s) {
  std::ranges::sort(s, std::greater());
  return s;
}

PrincipalStress random_trial(std::mt19937_64& generator, double mean, double spread) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double m = mean * uniform(generator);
  return descending(
      {m + spread * uniform(generator), m + spread * uniform(generator), m + spread * uniform(generator)});
}

/// Returns the closest point of the pyramid in the energy norm by Dykstra's projections onto the six half-spaces, each
/// along the elastic response to its normal (R. L. Dykstra, J. Am. Stat. Assoc. 78 (1983) 837).
Vector3 closest(const Pyramid& of, Vector3 x) {
  Matrix3 stiffness = (bulk - 2.0 / 3.0 * shear) * Matrix3::Ones() + 2.0 * shear * Matrix3::Identity();
  std::array<double, 6> multipliers{};
  for (int sweep = 0; sweep < 100000; ++sweep) {
    double change = 0.0;
    std::size_t face = 0;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (i == j) continue;
        Vector3 normal = Vector3::Zero();
        normal[i] = 1.0 + of.sine;
        normal[j] = -1.0 + of.sine;
        const Vector3 response = stiffness * normal;
        const double now =
            std::max(0.0, multipliers[face] + (normal.dot(x) - of.intercept) / normal.dot(response));
        const double step = now - multipliers[face];
        x -= step * response;
        multipliers[face] = now;
        change = std::max(change, std::abs(step) * response.norm());
        ++face;
      }
    }
    if (change < 1e-11 * std::max(x.norm(), of.intercept)) break;
  }
  return x;
}

TEST(MohrCoulomb, AssociatedReturnIsTheClosestPointInTheEnergyNorm) {
  std::mt19937_64 generator(5);
  std::array<int, 4> of_kind{};  // elastic, face, edge, apex
  for (int trial = 0; trial < 400; ++trial) {
    const double friction = 10.0 + 30.0 * (trial % 7) / 6.0, cohesion = 10e3 * (1 + trial % 3);
    const Pyramid of = pyramid(friction, friction, cohesion);
    const PrincipalStress t = random_trial(generator, 3e5, trial % 2 == 0 ? 1e5 : 4e5);
    const PrincipalStress s = strength::return_to(of, bulk, shear, t);
    const Vector3 exact = closest(of, {t[0], t[1], t[2]});
    const double scale = Vector3(t[0], t[1], t[2]).norm() + of.intercept;
    for (int i = 0; i < 3; ++i) {
      ASSERT_NEAR(s[static_cast<std::size_t>(i)], exact[i], 1e-6 * scale) << trial << ", component " << i;
    }
    const double near = 1e-9 * scale;
    const int kind = s == t ? 0 : s[0] - s[2] < near ? 3 : std::min(s[0] - s[1], s[1] - s[2]) < near ? 2 : 1;
    ++of_kind[static_cast<std::size_t>(kind)];
  }
  std::printf("elastic %d, face %d, edge %d, apex %d\n", of_kind[0], of_kind[1], of_kind[2], of_kind[3]);
  for (const int count : of_kind) EXPECT_GT(count, 15);
}

// Without dilation: the mean stress stays, the state is on the pyramid in the same order, and the flow of a face has no
// component along the middle stress.
TEST(MohrCoulomb, ReturnWithoutDilationKeepsTheMeanAndGivesNoWorkBack) {
  std::mt19937_64 generator(6);
  int faces = 0, edges = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Pyramid of = pyramid(5.0 + 40.0 * (trial % 11) / 10.0, 0.0, 1e4 * (trial % 4));
    PrincipalStress t = random_trial(generator, 0.0, 2e5);
    const double apex = of.intercept / (2.0 * of.sine), mean = (t[0] + t[1] + t[2]) / 3.0;
    const double lower = apex - mean - 1e5 * (trial % 5);  // at the apex, and below it
    for (double& s : t) s += lower;
    const PrincipalStress s = strength::return_to(of, bulk, shear, t);
    const double near = 1e-9 * (2e5 + std::abs(lower));
    EXPECT_LE(of.excess(s[0], s[2]), near);
    EXPECT_NEAR((s[0] + s[1] + s[2]) / 3.0, mean + lower, near);
    EXPECT_GE(s[0], s[1] - near);
    EXPECT_GE(s[1], s[2] - near);
    double work = 0.0;
    for (std::size_t i = 0; i < 3; ++i) work += s[i] * (t[i] - s[i]);
    EXPECT_GE(work, -near * 2e5);
    if (s == t) continue;
    const bool on_face = s[0] - s[1] > near && s[1] - s[2] > near;
    (on_face ? faces : edges) += 1;
    if (on_face) {
      EXPECT_EQ(s[1], t[1]);
    }
  }
  EXPECT_GT(faces, 300);
  EXPECT_GT(edges, 300);
}

// Trial stresses on the border between a face and an edge: round-off there must not send them to the apex.
TEST(MohrCoulomb, TheBorderOfAnEdgeIsNotTheApex) {
  std::mt19937_64 generator(5);
  for (int trial = 0; trial < 20000; ++trial) {
    const bool associated = trial % 2 == 0;
    const Pyramid of = pyramid(33, associated ? 33.0 : 0.0, 1e3 * (trial % 3));
    std::uniform_real_distribution<double> uniform(0.1, 1.0);
    // From a state on an edge along the response to the flow of its face
    const double s3 = -8e5 * uniform(generator), x = 1e-3 * uniform(generator);
    const double s1 = (of.intercept + s3 * (1.0 - of.sine)) / (1.0 + of.sine);
    const bool at_greater = trial % 4 < 2;
    const Vector3 flow(1.0 + of.dilation, 0.0, -1.0 + of.dilation);
    const Vector3 response = 2.0 * shear * flow + Vector3::Constant((bulk - 2.0 / 3.0 * shear) * flow.sum());
    const Vector3 edge(s1, at_greater ? s1 : s3, s3);
    const Vector3 t = edge + x * response;
    const PrincipalStress s = strength::return_to(of, bulk, shear, descending({t[0], t[1], t[2]}));
    EXPECT_LT((Vector3(s[0], s[1], s[2]) - edge).norm(), 1e-9 * t.norm()) << trial;
  }
}

MohrCoulomb sand() {
  MohrCoulomb law;
  law.shear_modulus = shear;
  law.friction_angle = 33 * degree;
  law.cohesion = 5e3;
  return law;
}

Material soil(const MohrCoulomb& law) {
  eos::PolynomialConstants constants;
  constants.reference_density = 2000;
  constants.C1 = bulk;
  constants.heat_capacity = 1000;
  return make_material("soil", std::make_shared<eos::ModelEquationOfState<eos::Polynomial>>(constants),
                       std::make_shared<strength::MohrCoulombModel>(law));
}

PrincipalStress principal(const Body& body) {
  const Vector3 s =
      Eigen::SelfAdjointEigenSolver<Matrix3>(body.points.deviatoric_stress[0].matrix()).eigenvalues();
  return {s[2] - body.p(), s[1] - body.p(), s[0] - body.p()};
}

TEST(MohrCoulomb, TriaxialAndPlaneStrainStrengthIsThatOfTheConstants) {
  const MohrCoulomb law = sand();
  const Pyramid of = pyramid(33, 0, 5e3);
  for (const Vector3& strain :
       {Vector3(-2, 1, 1), Vector3(2, -1, -1), Vector3(-1, 1, 0), Vector3(-3, 1, 2)}) {
    const Material material = soil(law);
    Body body{material};
    body.strain_to(diagonal(0.999, 0.999, 0.999), 100);
    const Vector3 end = Vector3::Constant(0.999) + 0.01 * strain;
    body.strain_to(diagonal(end[0], end[1], end[2]), 4000);
    const PrincipalStress s = principal(body);
    EXPECT_NEAR(of.excess(s[0], s[2]), 0.0, 1e-9 * bulk) << strain.transpose();
    EXPECT_GT(body.points.plastic_strain[0], 0.005);
    // No dilation: the volume is the elastic one.
    EXPECT_NEAR(body.p(), bulk * (1.0 / end.prod() - 1.0), 2e-3 * body.p()) << strain.transpose();
  }
}

TEST(MohrCoulomb, NeverGivesWorkBack) {
  const Material material = soil(sand());
  expect_dissipation(material, 12);
}

// The energy after a closed path is the dissipation on it: the elastic energy of the turned deviator is returned.
TEST(MohrCoulomb, EnergyOfAClosedPathIsItsDissipation) {
  const Material material = soil(sand());
  Body body{material};
  body.strain_to(diagonal(0.999, 0.999, 0.999), 4000);
  const double start = body.energy(), volume = body.points.volume[0];
  double work = 0.0;
  const auto go = [&](const Matrix3& next) {
    const Matrix3 from = body.place;
    for (int i = 1; i <= 20000; ++i)
      work += body.strain_to((from + (next - from) * i / 20000).eval()).plastic_work;
  };
  // At constant volume: the hypoelastic deviator keeps its energy to the order of the change of volume only.
  Matrix3 sheared = diagonal(0.9995, 0.9985, std::pow(0.999, 3) / (0.9995 * 0.9985));
  sheared(0, 1) = 0.003;
  go(sheared);
  go(diagonal(0.999, 0.999, 0.999));
  const PrincipalStress s = principal(body);
  const double p = body.p();
  double elastic = 0.0;
  for (const double of : s) elastic += (of + p) * (of + p);
  elastic *= body.points.volume[0] / (4.0 * shear);
  EXPECT_GT(work, 1.0 * volume);
  EXPECT_NEAR(body.energy() - start, work + elastic, 1e-4 * work);
}

TEST(MohrCoulomb, GapsOpenAtTheApex) {
  const Material material = soil(sand());
  Body body{material};
  Matrix3 f = diagonal(1.01, 1.01, 1.01);
  f(0, 1) = 0.01;
  body.strain_to(f, 1000);
  EXPECT_NEAR(body.p(), sand().least_pressure(), 1e-9 * bulk);
  EXPECT_LT(body.q(), 1e-9 * bulk);
  EXPECT_GT(body.points.void_volume[0], 0.02 * body.points.volume[0]);
}

}  // namespace mohr_coulomb_test
}  // namespace whipple

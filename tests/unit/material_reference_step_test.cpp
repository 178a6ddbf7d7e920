// SPDX-License-Identifier: BSD-3-Clause
// The update against a plain scalar transcription of its equations (docs/theory/material.md) for
// p = A(rho) + B(rho) e with linear hardening, where the implicit energy step can be solved exactly. Written
// with arrays and index loops, and sharing no code with the update.
#include <gtest/gtest.h>

#include "src/material/failure/tensile_pressure.hpp"
#include "tests/unit/material_support.hpp"

namespace whipple {
namespace {

using namespace material_test;

struct ScalarPoint {
  double m, v, e, p, q, c, ep, s[3][3];
};

ScalarPoint scalar_point(const MaterialPoints& points, std::size_t i) {
  ScalarPoint point{points.mass[i],
                    points.volume[i],
                    points.specific_internal_energy[i],
                    points.pressure[i],
                    points.artificial_viscosity[i],
                    points.sound_speed[i],
                    points.plastic_strain[i],
                    {}};
  const Matrix3 s = points.deviatoric_stress[i].matrix();
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) point.s[a][b] = s(a, b);
  }
  return point;
}

using Array = double[3][3];

double determinant(const Array& a) {
  return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
         a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
         a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}
void invert(const Array& a, Array& b) {
  const double d = determinant(a);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int r = (j + 1) % 3, t = (j + 2) % 3, k = (i + 1) % 3, l = (i + 2) % 3;
      b[i][j] = (a[r][k] * a[t][l] - a[r][l] * a[t][k]) / d;
    }
  }
}
void multiply(const Array& a, const Array& b, Array& c) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
  }
}

/// Kinematics and stress; returns the volume ratio and the deviatoric work per volume with the mean stress.
double advance_stress(ScalarPoint& p, const strength::VonMises& k, const Matrix3& gradient, double dt,
                      double& work) {
  Array f, h, inverse, g, l, strain, minus, plus, r, t, s;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      g[i][j] = gradient(i, j);
      f[i][j] = (i == j) + dt * g[i][j];
      h[i][j] = (i == j) + 0.5 * dt * g[i][j];
    }
  }
  invert(h, inverse);
  multiply(g, inverse, l);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      strain[i][j] = 0.5 * dt * (l[i][j] + l[j][i]);
      const double spin = 0.25 * dt * (l[i][j] - l[j][i]);
      minus[i][j] = (i == j) - spin;
      plus[i][j] = (i == j) + spin;
    }
  }
  invert(minus, t);
  multiply(t, plus, r);
  multiply(r, p.s, t);
  const double mean = (strain[0][0] + strain[1][1] + strain[2][2]) / 3.0;
  double square = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      s[i][j] = t[i][0] * r[j][0] + t[i][1] * r[j][1] + t[i][2] * r[j][2] +
                2.0 * k.shear_modulus * (strain[i][j] - (i == j ? mean : 0.0));
      square += s[i][j] * s[i][j];
    }
  }
  const double trial = std::sqrt(1.5 * square), yield = k.yield_stress + k.hardening_modulus * p.ep;
  double factor = 1.0;
  if (trial > yield) {
    const double increment = (trial - yield) / (3.0 * k.shear_modulus + k.hardening_modulus);
    p.ep += increment;
    factor = (yield + k.hardening_modulus * increment) / trial;
  }
  work = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      work += 0.5 * (p.s[i][j] + factor * s[i][j]) * strain[i][j];
      p.s[i][j] = factor * s[i][j];
    }
  }
  return determinant(f);
}

double viscosity(const ScalarPoint& p, double divergence, const UpdateSettings& settings) {
  if (divergence >= 0.0) return 0.0;
  const double closing = -divergence * settings.cell_size;
  return p.m / p.v * closing * (settings.quadratic_viscosity * closing + settings.linear_viscosity * p.c);
}

/// Pressure of the symplectic scheme: energy half a step ahead, less the elastic energy.
void symplectic(ScalarPoint& p, const LinearInEnergy& eos, const strength::VonMises& k, const Matrix3& g,
                const UpdateSettings& settings) {
  const double dt = settings.time_step, divergence = g.trace();
  double work = 0.0, square = 0.0;
  p.v *= advance_stress(p, k, g, dt, work);
  p.q = viscosity(p, divergence, settings);
  double power = -(p.p + p.q) * divergence;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      power += p.s[i][j] * g(i, j);
      square += p.s[i][j] * p.s[i][j];
    }
  }
  const double energy = p.e + 0.5 * dt * power * p.v / p.m - square / (4.0 * k.shear_modulus) * p.v / p.m;
  p.p = eos.pressure(p.m / p.v, energy);
  p.c = std::sqrt(eos.sound_squared(p.m / p.v, energy) + 4.0 / 3.0 * k.shear_modulus * p.v / p.m);
}

/// Energy and pressure of the integrating schemes: e linear in p, solved exactly.
void integrated(ScalarPoint& p, const LinearInEnergy& eos, const strength::VonMises& k, const Matrix3& g,
                const UpdateSettings& settings) {
  const double old_volume = p.v, old_pressure = p.p;
  double work = 0.0, a = 0.0, b = 0.0, da = 0.0;
  p.v *= advance_stress(p, k, g, settings.time_step, work);
  const double change = p.v - old_volume;
  p.q = viscosity(p, g.trace(), settings);
  eos.coefficients(p.m / p.v, a, b, da);
  p.e = (p.e + (work * 0.5 * (p.v + old_volume) - change * (0.5 * (old_pressure + a) + p.q)) / p.m) /
        (1.0 + 0.5 * change * b / p.m);
  p.p = a + b * p.e;
}

void expect_same(const MaterialPoints& points, std::size_t i, const ScalarPoint& p, double energy_scale) {
  ASSERT_NEAR(points.volume[i], p.v, 1e-13 * p.v);
  ASSERT_NEAR(points.specific_internal_energy[i], p.e, 1e-11 * energy_scale);
  ASSERT_NEAR(points.pressure[i], p.p, 1e-11 * 1.4e11);
  ASSERT_NEAR(points.artificial_viscosity[i], p.q, 1e-12 * p.q);
  ASSERT_NEAR(points.plastic_strain[i], p.ep, 1e-12 * (p.ep + 1e-3));
  const Matrix3 s = points.deviatoric_stress[i].matrix();
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) ASSERT_NEAR(s(a, b), p.s[a][b], 1e-10 * 157e6) << a << b;
  }
}

template <class Update, class Scalar>
void compare(Update update, Scalar scalar) {
  const strength::VonMises constants = taylor_copper();
  const LinearInEnergy eos;
  const Material material = with(constants);
  constexpr std::size_t n = 300;
  MaterialPoints points = points_of(material, n);
  std::mt19937_64 generator(11);
  const UpdateSettings settings{.time_step = 1e-8, .cell_size = 1e-3};
  for (int step = 0; step < 30; ++step) {
    std::vector<Matrix3> gradients;
    std::vector<ScalarPoint> expected;
    for (std::size_t i = 0; i < n; ++i) {
      gradients.push_back(
          random_matrix(generator, i % 2 == 0 ? 5e5 : 1e4));  // strains of 0.5 % and 1e-4 a step
      expected.push_back(scalar_point(points, i));
      scalar(expected[i], eos, constants, gradients[i], settings);
    }
    ASSERT_TRUE(update(material, points, 0, n, gradients, settings).valid());
    for (std::size_t i = 0; i < n; ++i) expect_same(points, i, expected[i], 1e5);
  }
  EXPECT_GT(*std::ranges::max_element(points.plastic_strain), 0.05);
  EXPECT_EQ(points.plastic_strain[1], 0.0);
}

TEST(ReferenceStep, SymplecticUpdateIsTheScalarOne) {
  compare([](auto&&... a) { return update_material(a...); }, symplectic);
}

TEST(ReferenceStep, EnergyIntegratingUpdateSolvesTheImplicitWorkExactly) {
  compare([](auto&&... a) { return update_material_and_energy(a...); }, integrated);
}

TEST(ReferenceStep, CutOffPressureOfAFailingPointTakesItsWorkBack) {
  // e + dV (p_eos - 0) / 2m after the step in which the point fails: the tension that does not act did no
  // work.
  const strength::VonMises constants = taylor_copper();
  const LinearInEnergy eos;
  const Material material =
      with(constants, {std::make_shared<failure::CriterionModel<failure::TensilePressure>>(
                          failure::TensilePressure{{}, 1e9})});
  MaterialPoints points = points_of(material, 1);
  ScalarPoint expected = scalar_point(points, 0);
  const UpdateSettings settings{.time_step = 1e-8, .cell_size = 1e-3};
  const Matrix3 gradient = 0.005 / settings.time_step * Matrix3::Identity();
  const double old_volume = expected.v;
  integrated(expected, eos, constants, gradient, settings);
  ASSERT_LT(expected.p, -1e9);
  update_material_and_energy(material, points, 0, 1, std::span(&gradient, 1), settings);
  EXPECT_EQ(points.failed[0], failure::tensile);
  EXPECT_NEAR(points.specific_internal_energy[0],
              expected.e + 0.5 * (expected.v - old_volume) * expected.p / expected.m,
              1e-9 * std::abs(expected.e));
}

}  // namespace
}  // namespace whipple

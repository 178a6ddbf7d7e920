// SPDX-License-Identifier: BSD-3-Clause
// Frequencies of finite-element bodies against exact solutions of elastodynamics, with the order of
// convergence.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <numbers>

#include "tests/unit/fem_support.hpp"

namespace whipple::fem_test {
namespace {

using std::numbers::pi;

/// Half a period of the mode whose velocity the body is started with from its undeformed state: the time at
/// which the displacement along the mode returns to zero.
double half_period(Body& body, const std::function<Vector3(const Vector3&)>& mode, double speed,
                   double courant, double expected) {
  const std::vector<Vector3> start = body.mesh.nodes.position;
  body.set_velocity([&](const Vector3& x) { return Vector3(speed * mode(x)); });
  const auto coordinate = [&] {
    double sum = 0.0;
    for (std::size_t a = 0; a < start.size(); ++a) {
      sum += body.mesh.nodes.mass[a] * (body.mesh.nodes.position[a] - start[a]).dot(mode(start[a]));
    }
    return sum;
  };
  const double dt = courant * body.critical_time_step();
  for (double before = 0.0; body.time < 2.0 * expected; before = coordinate()) {
    body.step(dt);
    const double now = coordinate();
    if (body.time > 0.5 * expected && now <= 0.0) return body.time - dt * now / (now - before);
  }
  return body.time;
}

struct Row {
  std::size_t elements;
  double error;
};

/// Least order between successive rows.
double order(const std::vector<Row>& rows) {
  double least = 1e9;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    least = std::min(least, std::log(std::abs(rows[i - 1].error / rows[i].error)) /
                                std::log(static_cast<double>(rows[i].elements) /
                                         static_cast<double>(rows[i - 1].elements)));
  }
  return least;
}

void print(const char* problem, Quadrature quadrature, const std::vector<Row>& rows) {
  std::printf("%s, %s: relative error of the frequency", problem, name(quadrature));
  for (const Row& row : rows) std::printf(" %+.2e (n = %zu)", row.error, row.elements);
  std::printf(", order %.2f\n", order(rows));
}

/// Column in uniaxial strain, free ends: first frequency c/(2 L), mode cos(pi x/L), on a distorted mesh.
double column_error(Quadrature quadrature, std::size_t n) {
  constexpr double length = 10e-3;
  const double size = length / static_cast<double>(n);
  fem::Hexahedra mesh = fem::make_box(Vector3::Zero(), Vector3(length, 2.0 * size, 2.0 * size), {n, 2, 2});
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> uniform(-0.2 * size, 0.2 * size);
  for (Vector3& x : mesh.nodes) {  // the outer faces stay plane
    const double shift = uniform(generator);
    if (x[0] > 0.1 * size && x[0] < length - 0.1 * size) x[0] += shift;
  }
  const Solid solid;
  Body body(solid.material(), mesh, quadrature);
  for (auto& bits : body.mesh.nodes.constrained) bits = fem::constraint::y | fem::constraint::z;
  const double exact = length / solid.longitudinal_speed();  // half a period
  const double measured = half_period(
      body, [&](const Vector3& x) { return Vector3(std::cos(pi * x[0] / length), 0.0, 0.0); }, 1e-3, 0.9,
      exact);
  return exact / measured - 1.0;
}

TEST(Vibration, ColumnConvergesWithSecondOrder) {
  for (const Quadrature quadrature : both) {
    std::vector<Row> rows;
    for (const std::size_t n : {8, 16, 32, 64}) rows.push_back({n, column_error(quadrature, n)});
    print("column", quadrature, rows);
    EXPECT_GT(order(rows), 1.8) << name(quadrature);
    EXPECT_LT(std::abs(rows.back().error), 5e-4) << name(quadrature);
  }
}

/// Bending of a plate in plane strain between rollers: the lowest antisymmetric Lamb wave (A0) as a standing
/// wave (Lamb, Proc. R. Soc. A 93 (1917) 114): exact elastodynamics, not a beam theory.
struct LambWave {
  double half_thickness, wave_number;
  Solid solid;
  double omega = 0.0, alpha = 0.0, beta = 0.0;

  LambWave(double h, double k, const Solid& s) : half_thickness(h), wave_number(k), solid(s) {
    double low = 1e-3 * k * transverse(), high = 0.9999 * k * transverse();
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      ((dispersion(middle) > 0.0) == (dispersion(low) > 0.0) ? low : high) = middle;
    }
    dispersion(omega = 0.5 * (low + high));
  }
  [[nodiscard]] double transverse() const { return std::sqrt(solid.shear_modulus / solid.density); }
  double dispersion(double w) {
    const double k = wave_number, h = half_thickness, cl = solid.longitudinal_speed(), ct = transverse();
    alpha = std::sqrt(k * k - w * w / (cl * cl));
    beta = std::sqrt(k * k - w * w / (ct * ct));
    const double sum = k * k + beta * beta;
    return sum * sum * std::tanh(alpha * h) - 4.0 * k * k * alpha * beta * std::tanh(beta * h);
  }
  /// Displacement of the mode at (x, y), y from the middle plane.
  [[nodiscard]] Vector3 mode(double x, double y) const {
    const double k = wave_number, h = half_thickness;
    const double b = 2.0 * k * alpha * std::cosh(alpha * h) / ((beta * beta + k * k) * std::cosh(beta * h));
    return {(-k * std::sinh(alpha * y) + beta * b * std::sinh(beta * y)) * std::sin(k * x) / k,
            (alpha * std::cosh(alpha * y) - k * b * std::cosh(beta * y)) * std::cos(k * x) / k, 0.0};
  }
};

double bending_error(Quadrature quadrature, std::size_t n) {
  constexpr double thickness = 1e-3, length = 4e-3;
  const double size = thickness / static_cast<double>(n);
  Body body(
      Solid{}.material(),
      fem::make_box(Vector3(0, -0.5 * thickness, 0), Vector3(length, 0.5 * thickness, size), {4 * n, n, 1}),
      quadrature);
  for (auto& bits : body.mesh.nodes.constrained) bits = fem::constraint::z;
  for (const double end : {0.0, length}) {
    constrain(body.mesh.nodes, nodes_on_plane(body.mesh, 0, end, 1e-3 * size), fem::constraint::x);
  }
  const LambWave wave(0.5 * thickness, pi / length, Solid{});
  const double exact = pi / wave.omega;
  const double measured =
      half_period(body, [&](const Vector3& x) { return wave.mode(x[0], x[1]); }, 1e-3, 0.9, exact);
  return exact / measured - 1.0;
}

TEST(Vibration, BendingConvergesToTheLambWaveWithSecondOrder) {
  const LambWave wave(0.5e-3, pi / 4e-3, Solid{});
  // Thin plates: the limit of Kirchhoff's theory, omega = k^2 h sqrt(E/(3 rho (1 - nu^2)))
  const Solid solid;
  const double modulus = 4.0 * solid.shear_modulus * (solid.bulk_modulus + solid.shear_modulus / 3.0) /
                         (solid.bulk_modulus + 4.0 / 3.0 * solid.shear_modulus);  // E/(1 - nu^2)
  const LambWave thin(0.5e-3, pi / 400e-3, solid);
  EXPECT_NEAR(thin.omega /
                  (thin.wave_number * thin.wave_number * 0.5e-3 * std::sqrt(modulus / (3.0 * solid.density))),
              1.0, 1e-4);
  for (const Quadrature quadrature : both) {
    std::vector<Row> rows;
    for (const std::size_t n : {2, 4, 8}) rows.push_back({n, bending_error(quadrature, n)});
    print("plate in bending", quadrature, rows);
    EXPECT_GT(order(rows), 1.8) << name(quadrature);
    EXPECT_LT(std::abs(rows.back().error), 1e-2) << name(quadrature);
  }
}

/// First frequency of Timoshenko's cantilever: the root of Huang's frequency equation (J. Appl. Mech. 28
/// (1961) 579) in b^2 = rho A L^4 omega^2/(E I), with r^2 = I/(A L^2), s^2 = E I/(k G A L^2), k of Cowper (J.
/// Appl. Mech. 33 (1966) 335) for a rectangle.
double timoshenko(const Solid& solid, double length, double height) {
  const double young = solid.young(), poisson = 0.5 * young / solid.shear_modulus - 1.0;
  const double shear = 10.0 * (1.0 + poisson) / (12.0 + 11.0 * poisson);
  const double r2 = height * height / (12.0 * length * length),
               s2 = r2 * young / (shear * solid.shear_modulus);
  const auto equation = [&](double b) {
    const double root = std::sqrt((r2 - s2) * (r2 - s2) + 4.0 / (b * b));
    const double alpha = std::sqrt(0.5 * (root - r2 - s2)), beta = std::sqrt(0.5 * (root + r2 + s2));
    return 2.0 + (b * b * (r2 - s2) * (r2 - s2) + 2.0) * std::cosh(b * alpha) * std::cos(b * beta) -
           b * (r2 + s2) / std::sqrt(1.0 - b * b * r2 * s2) * std::sinh(b * alpha) * std::sin(b * beta);
  };
  double low = 2.0, high = 3.6;  // Euler-Bernoulli: 1.875^2 = 3.516
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    ((equation(middle) > 0.0) == (equation(low) > 0.0) ? low : high) = middle;
  }
  return low / (length * length) * std::sqrt(young * height * height / 12.0 / solid.density);
}

/// Cantilever of square section, ten times as long as high, against Timoshenko's beam.
TEST(Vibration, CantileverFollowsTimoshenko) {
  constexpr double length = 10e-3, height = 1e-3, kl = 1.875104;
  const Solid solid;
  EXPECT_NEAR(timoshenko(solid, 1e3 * length, height) * 1e6 * length * length /
                  std::sqrt(solid.young() * height * height / 12.0 / solid.density),
              kl * kl, 1e-4);  // slender: Euler-Bernoulli
  const double exact = timoshenko(solid, length, height);
  const double b = kl / length, ratio = (std::cosh(kl) + std::cos(kl)) / (std::sinh(kl) + std::sin(kl));
  const auto deflection = [&](double x) {
    return std::cosh(b * x) - std::cos(b * x) - ratio * (std::sinh(b * x) - std::sin(b * x));
  };
  const auto slope = [&](double x) {
    return b * (std::sinh(b * x) + std::sin(b * x) - ratio * (std::cosh(b * x) - std::cos(b * x)));
  };
  for (const Quadrature quadrature : both) {
    Body body(solid.material(),
              fem::make_box(Vector3(0, -0.5 * height, 0), Vector3(length, 0.5 * height, height), {40, 4, 2}),
              quadrature);
    constrain(body.mesh.nodes, nodes_on_plane(body.mesh, 0, 0.0, 1e-6), fem::constraint::all);
    const double measured = half_period(
        body, [&](const Vector3& x) { return Vector3(-slope(x[0]) * x[1], deflection(x[0]), 0.0); }, 1e-3,
        0.9, pi / exact);
    const double error = pi / exact / measured - 1.0;
    std::printf("cantilever, %s, 4 elements through the height: frequency %+.2f %%\n", name(quadrature),
                100.0 * error);
    EXPECT_LT(std::abs(error), 0.02) << name(quadrature);
  }
}

}  // namespace
}  // namespace whipple::fem_test

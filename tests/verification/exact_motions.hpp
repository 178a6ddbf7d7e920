// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "tests/verification/solver_problems.hpp"

/// Motions along the axes, x_a = X_a + u_a(X_a, t), whose deformation gradients are diagonal: a vibrating bar, a
/// manufactured solution in two dimensions, a simple wave. docs/theory/mpm.md, section 7.5.
namespace whipple::verification {

/// Murnaghan's isentrope with a Grueneisen parameter next to zero: the pressure is a function of J alone.
struct Barotropic {
  static constexpr double density = 1000.0, modulus = 1e9, slope = 4.0, shear = 0.5e9;
  static double pressure(double j) { return modulus / slope * (std::pow(j, -slope) - 1); }
  static double pressure_derivative(double j) { return -modulus * std::pow(j, -slope - 1); }
  static double bulk_speed() { return std::sqrt(modulus / density); }
  static double longitudinal_speed() { return std::sqrt((modulus + 4.0 / 3.0 * shear) / density); }
};

inline std::string barotropic_material(bool solid) {
  const std::string strength =
      "[strength]\nmodel = \"von_mises\"\nsource = \"verification\"\nshear_modulus = \"0.5 GPa\"\n"
      "yield_stress = \"1e6 GPa\"\n";
  return write_material(
      solid ? "barotropic_solid" : "barotropic_fluid",
      "name = \"barotropic\"\nsource = \"verification\"\n[eos]\nmodel = \"murnaghan\"\n"
      "source = \"verification\"\nreference_density = \"1000 kg/m^3\"\nbulk_modulus = \"1 "
      "GPa\"\nbulk_modulus_slope = 4\ngruneisen = 1e-9\nheat_capacity = \"1000 J/(kg K)\"\n" +
          (solid ? strength : std::string()));
}

/// A motion along the axes in a box of length 1 m along x (and, in two dimensions, y).
class ExactMotion {
 public:
  virtual ~ExactMotion() = default;
  [[nodiscard]] virtual std::string name() const = 0;
  [[nodiscard]] virtual int dimensions() const { return 1; }
  [[nodiscard]] virtual bool solid() const { return true; }
  [[nodiscard]] virtual double end() const = 0;             ///< s
  [[nodiscard]] virtual double velocity_scale() const = 0;  ///< m/s, errors are relative to it
  [[nodiscard]] virtual double frequency() const = 0;       ///< 1/s, displacements count as velocities by it
  [[nodiscard]] virtual double largest_speed() const = 0;   ///< m/s, of waves and matter together
  [[nodiscard]] virtual Vector3 position(const Vector3& X, double t) const = 0;
  [[nodiscard]] virtual Vector3 velocity(const Vector3& X, double t) const = 0;
  [[nodiscard]] virtual Vector3 stretch(const Vector3& X, double t) const = 0;  ///< diagonal of F
  /// External acceleration that the motion needs, if any.
  [[nodiscard]] virtual std::function<Vector3(const Vector3& X, double t)> acceleration() const { return {}; }
};

/// First longitudinal mode of a bar of uniaxial strain between two mirror planes, of vanishing amplitude.
class VibratingBar : public ExactMotion {
 public:
  [[nodiscard]] std::string name() const override { return "vibrating bar"; }
  [[nodiscard]] double end() const override { return 2.25 * pi / omega; }
  [[nodiscard]] double velocity_scale() const override { return amplitude * omega; }
  [[nodiscard]] double frequency() const override { return omega; }
  [[nodiscard]] double largest_speed() const override { return Barotropic::longitudinal_speed(); }
  [[nodiscard]] Vector3 position(const Vector3& X, double t) const override {
    return X + Vector3(amplitude * std::sin(pi * X[0]) * std::sin(omega * t), 0, 0);
  }
  [[nodiscard]] Vector3 velocity(const Vector3& X, double t) const override {
    return {amplitude * omega * std::sin(pi * X[0]) * std::cos(omega * t), 0, 0};
  }
  [[nodiscard]] Vector3 stretch(const Vector3& X, double t) const override {
    return {1 + amplitude * pi * std::cos(pi * X[0]) * std::sin(omega * t), 1, 1};
  }

 private:
  static constexpr double pi = std::numbers::pi, amplitude = 1e-7;  // m
  double omega = pi * Barotropic::longitudinal_speed();
};

/// Manufactured solution after Wallstedt & Guilkey, J. Comput. Phys. 227 (2008) 9628: standing waves of
/// finite amplitude along x and y that interact through the volume, in an elastic solid (logarithmic
/// strains), upheld by an external acceleration; particles cross cells.
class ManufacturedWaves : public ExactMotion {
 public:
  [[nodiscard]] std::string name() const override { return "manufactured waves"; }
  [[nodiscard]] int dimensions() const override { return 2; }
  [[nodiscard]] double end() const override { return 1.25 * pi / omega; }
  [[nodiscard]] double velocity_scale() const override { return amplitude * omega; }
  [[nodiscard]] double frequency() const override { return omega; }
  [[nodiscard]] double largest_speed() const override {
    return 1.35 * Barotropic::longitudinal_speed() + velocity_scale();
  }
  [[nodiscard]] Vector3 position(const Vector3& X, double t) const override {
    return X + amplitude * Vector3(std::sin(pi * X[0]) * std::sin(omega * t),
                                   std::sin(pi * X[1]) * std::sin(omega * t + phase), 0);
  }
  [[nodiscard]] Vector3 velocity(const Vector3& X, double t) const override {
    return amplitude * omega *
           Vector3(std::sin(pi * X[0]) * std::cos(omega * t),
                   std::sin(pi * X[1]) * std::cos(omega * t + phase), 0);
  }
  [[nodiscard]] Vector3 stretch(const Vector3& X, double t) const override {
    return Vector3::Ones() + amplitude * pi *
                                 Vector3(std::cos(pi * X[0]) * std::sin(omega * t),
                                         std::cos(pi * X[1]) * std::sin(omega * t + phase), 0);
  }
  /// b = d2u/dt2 - (1/rho0) dP/dX with the first Piola-Kirchhoff stress P_xx = sigma_xx F_yy,
  /// sigma_xx = -p(J) + 2 G (ln F_xx - ln J / 3).
  [[nodiscard]] std::function<Vector3(const Vector3& X, double t)> acceleration() const override {
    return [this](const Vector3& X, double t) {
      const Vector3 f = stretch(X, t);
      const double j = f.prod();
      Vector3 b = Vector3::Zero();
      for (int a = 0; a < 2; ++a) {
        const double arg = omega * t + (a == 1 ? phase : 0.0);
        const double second = -amplitude * pi * pi * std::sin(pi * X[a]) * std::sin(arg);  // dF/dX
        const double other = j / f[a];
        const double dp =
            other * second *
            (-Barotropic::pressure_derivative(j) * other + 2 * Barotropic::shear * (2.0 / 3.0) / f[a]);
        b[a] = -omega * omega * amplitude * std::sin(pi * X[a]) * std::sin(arg) - dp / Barotropic::density;
      }
      return b;
    };
  }

 private:
  static constexpr double pi = std::numbers::pi, amplitude = 0.03, phase = 0.7;  // m, rad
  double omega = pi * Barotropic::longitudinal_speed();
};

/// A simple wave of finite amplitude running to the right in a fluid at rest, before it breaks. Along
/// characteristics u is constant; for this isentrope u = 2 (c - c0) / (slope - 1) (Riemann), and in material
/// coordinates the wave moves with rho c / rho0.
class SimpleWave : public ExactMotion {
 public:
  SimpleWave() = default;
  [[nodiscard]] std::string name() const override { return "simple wave"; }
  [[nodiscard]] bool solid() const override { return false; }
  [[nodiscard]] double end() const override { return 0.3 / Barotropic::bulk_speed(); }
  [[nodiscard]] double velocity_scale() const override { return peak; }
  [[nodiscard]] double frequency() const override {
    return std::numbers::pi * Barotropic::bulk_speed() / width;
  }
  [[nodiscard]] double largest_speed() const override { return sound(peak) + peak; }
  [[nodiscard]] Vector3 position(const Vector3& X, double t) const override {
    // From material at rest on the right: x = X - integral of (F - 1) over [X, 1], by Simpson's rule.
    const auto [known, is_new] = positions_.try_emplace({X[0], t}, 0.0);
    if (is_new) {
      constexpr int intervals = 200;
      const double h = (1 - X[0]) / intervals;
      double sum = 0;
      for (int i = 0; i <= intervals; ++i) {
        const double weight = i == 0 || i == intervals ? 1 : i % 2 == 1 ? 4 : 2;
        sum += weight * (stretch({X[0] + i * h, 0, 0}, t)[0] - 1);
      }
      known->second = X[0] - sum * h / 3;
    }
    return {known->second, X[1], X[2]};
  }
  [[nodiscard]] Vector3 velocity(const Vector3& X, double t) const override {
    return {particle_velocity(X[0], t), 0, 0};
  }
  [[nodiscard]] Vector3 stretch(const Vector3& X, double t) const override {
    return {1 / compression(particle_velocity(X[0], t)), 1, 1};
  }

 private:
  static constexpr double width = 0.5, begin = 0.1;
  double peak = 0.08 * Barotropic::bulk_speed();
  mutable std::map<std::pair<double, double>, double> positions_;  // by material coordinate and time

  static double sound(double u) { return Barotropic::bulk_speed() + 0.5 * (Barotropic::slope - 1) * u; }
  static double compression(double u) {
    return std::pow(sound(u) / Barotropic::bulk_speed(), 2 / (Barotropic::slope - 1));
  }
  /// Smooth pulse in the material coordinate at t = 0.
  [[nodiscard]] double pulse(double X) const {
    const double s = (X - begin) / width;
    if (s <= 0 || s >= 1) return 0;
    return peak * std::pow(std::sin(std::numbers::pi * s), 4);
  }
  /// u = pulse(X - C(u) t), by bisection: the right side falls with u before breaking.
  [[nodiscard]] double particle_velocity(double X, double t) const {
    double lower = 0, upper = peak;
    for (int i = 0; i < 45; ++i) {
      const double u = 0.5 * (lower + upper);
      const double next = pulse(X - compression(u) * sound(u) * t);
      (next > u ? lower : upper) = u;
    }
    return 0.5 * (lower + upper);
  }
};

}  // namespace whipple::verification

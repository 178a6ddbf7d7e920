// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "src/transfer/shape_function.hpp"
#include "tests/verification/solver_problems.hpp"

/// Problems with exact solutions whose errors tell orders of convergence: a vibrating bar, a manufactured
/// solution in two dimensions, a simple wave. All motions are along the axes, x_a = X_a + u_a(X_a, t), so
/// their deformation gradients are diagonal. docs/theory/mpm.md, section 7.5.
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

/// A grid of n cells with one body that fills it, and how the body is discretised.
inline cases::Case motion_case(const ExactMotion& motion, const Method& method, int n,
                               const std::string& discretization = {}) {
  const double dx = 1.0 / n;
  char text[2048];
  const bool plane = motion.dimensions() == 2;
  std::snprintf(text, sizeof text, R"(
[output]
maximum_energy_error = 1e9
[domain]
lower = [0, 0, 0]
upper = [1, %.17g, %.17g]
cell_size = %.17g
boundary = { x_lower = "symmetry", x_upper = "symmetry", y_lower = "symmetry", y_upper = "symmetry", z_lower = "symmetry", z_upper = "symmetry" }
[[body]]
name = "body"
material = "%s"
shape = { box = { lower = [0, 0, 0], upper = [1, %.17g, %.17g] } }
%s)",
                plane ? 1.0 : dx, dx, dx, barotropic_material(motion.solid()).c_str(), plane ? 1.0 : dx, dx,
                discretization.c_str());
  Method chosen = method;
  chosen.courant = chosen.first_step = 1.0;  // the time step is set by who advances
  chosen.linear_viscosity = chosen.quadratic_viscosity = 0;
  return cases::read_case_text(chosen.time_toml(motion.end()) + chosen.toml() + text, "motion.toml");
}

/// Steps of a run on n cells.
inline long motion_steps(const ExactMotion& motion, int n) {
  return static_cast<long>(std::ceil(motion.end() * motion.largest_speed() * n / 0.4));
}

/// Relative error (rms over the mass) of velocity and displacement of a motion on a grid of n cells.
inline double motion_error(const ExactMotion& motion, const Method& method, int n) {
  const double dx = 1.0 / n;
  const cases::Case setup = motion_case(motion, method, n);
  const long steps = motion_steps(motion, n);
  const double dt = motion.end() / static_cast<double>(steps);
  // Velocities belong half a step before the positions (leapfrog); with stresses updated first, stresses a
  // whole step.
  const double stress_time = method.scheme == "usf" ? -dt : 0.0;
  Particles particles = cases::seed(setup).particles;
  std::vector<Vector3> start(particles.size());
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vector3 X = start[particles.id[p]] = particles.position[p];
    const Vector3 f = motion.stretch(X, stress_time);
    const double j = f.prod();
    const Vector3 s = 2 * Barotropic::shear * (f.array().log() - std::log(j) / 3);
    particles.volume[p] *= j;
    particles.pressure[p] = Barotropic::pressure(j);
    if (motion.solid()) particles.deviatoric_stress[p] = {s[0], s[1], s[2], 0, 0, 0};
    const Vector3 half = std::sqrt(particles.extent[p].xx) * motion.stretch(X, 0);
    particles.extent[p] = {half[0] * half[0], half[1] * half[1], half[2] * half[2], 0, 0, 0};
    particles.position[p] = motion.position(X, 0);
    particles.velocity[p] = motion.velocity(X, -0.5 * dt);
    const Vector3 rate =
        (motion.stretch(X, 0) - motion.stretch(X, -dt)).cwiseQuotient(dt * motion.stretch(X, -0.5 * dt));
    const bool affine = method.particle_update == "relaxed_affine" || method.particle_update == "apic";
    particles.affine_velocity[p] = affine ? Matrix3(rate.asDiagonal()) : Matrix3::Zero();
  }
  solver::RunState state;
  state.ledger.initial = solver::totals_of(
      particles, transfer::affine_inertia(setup.transfer.shape_function, dx));
  solver::Simulation simulation(setup, std::move(particles), state, parallel::world());
  if (const auto acceleration = motion.acceleration()) {
    simulation.add_load({.name = "manufactured",
                         .add = [&start, acceleration](const solver::LoadedPoints& points, double t,
                                                       std::span<Vector3> sum) {
                           for (std::size_t p = 0; p < sum.size(); ++p) sum[p] += acceleration(start[points.id[p]], t);
                         }});
  }
  for (long i = 1; i <= steps; ++i) simulation.advance(static_cast<double>(i) * dt);

  const Particles& q = simulation.particles();
  double sum = 0;
  for (std::size_t p = 0; p < q.size(); ++p) {
    const Vector3& X = start[q.id[p]];
    const Vector3 v = q.velocity[p] - motion.velocity(X, motion.end() - 0.5 * dt);
    const Vector3 u = motion.frequency() * (q.position[p] - motion.position(X, motion.end()));
    sum += (v.squaredNorm() + u.squaredNorm()) / static_cast<double>(q.size());
  }
  return std::sqrt(sum) / motion.velocity_scale();
}

/// Order between two resolutions, one twice as fine as the other.
inline double order_of(double coarse, double fine) { return std::log2(coarse / fine); }

}  // namespace whipple::verification

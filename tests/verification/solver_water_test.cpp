// SPDX-License-Identifier: BSD-3-Clause
// Water with a free surface under gravity (docs/theory/soil.md, section 5): a standing wave of small amplitude against
// the linear theory, omega^2 = g k tanh(k h).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/verification/contact_problems.hpp"

namespace whipple::verification {
namespace {

constexpr double gravity = 9.81, width = 1.0, depth = 0.5;  // m/s^2, m, m
const double wave_number = std::numbers::pi / width;
const double frequency = std::sqrt(gravity * wave_number * std::tanh(wave_number * depth));  // rad/s

/// Returns water with a sound speed of 30 m/s, fourteen times that of the longest waves.
std::string slow_water() {
  return write_material("slow_water", R"toml(
name = "water, weakly compressible"
source = "test"
[eos]
model = "mie_gruneisen"
source = "linear: c0 = 30 m/s"
reference_density = "1000 kg/m^3"
hugoniot_intercept = "30 m/s"
hugoniot_slope = 0.001
gruneisen = 0.001
heat_capacity = "4157 J/(kg K)"
[strength]
model = "none"
)toml");
}

struct Wave {
  double period;  // over the exact one
  double left;    // amplitude after a period over the initial one
};

/// Measures the first mode of a tank of 1 x 0.5 m, which starts flat with the velocities of the exact wave.
Wave standing_wave(int cells) {
  const double size = width / cells, period = 2.0 * std::numbers::pi / frequency, end = 1.3 * period;
  Method method{.linear_viscosity = 0.0, .quadratic_viscosity = 0.0};
  const cases::Case setup = cases::read_case_text(
      method.time_toml(end) + method.toml() + "[output]\nmaximum_energy_error = 10.0\n[domain]\n" +
          "dimension = \"plane_strain\"\nlower = [0, 0]\nupper = [1, 0.7]\ncell_size = " + number(size) +
          "\nboundary = { x_lower = \"symmetry\", x_upper = \"symmetry\", y_lower = \"symmetry\" }\n" +
          "[gravity]\nacceleration = [0, -9.81, 0]\n" +
          BodyOptions{"water", slow_water(), box({0, 0, -1}, {width, depth, 1}), Vector3::Zero(),
                      "initial = { lithostatic = { surface = 0.5, k0 = 1 } }\n"}
              .toml(),
      "wave.toml");
  const solver::Simulation at_rest(setup, parallel::world());
  Particles particles = at_rest.particles();
  solver::RunState state = at_rest.state();
  const double k = wave_number, amplitude = 0.01 * depth * frequency / std::sinh(k * depth);  // m/s
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double x = k * particles.position[p][0], y = k * particles.position[p][1];
    particles.velocity[p] = amplitude * Vector3(-std::sin(x) * std::cosh(y), std::cos(x) * std::sinh(y), 0.0);
    particles.affine_velocity[p] << -std::cos(x) * std::cosh(y), -std::sin(x) * std::sinh(y), 0.0,
        -std::sin(x) * std::sinh(y), std::cos(x) * std::cosh(y), 0.0, 0.0, 0.0, 0.0;
    particles.affine_velocity[p] *= k * amplitude;
    state.ledger.initial.kinetic_energy += 0.5 * particles.mass[p] * particles.velocity[p].squaredNorm();
  }
  solver::Simulation simulation(setup, particles, state, parallel::world(), {}, {});
  const double initial = simulation.totals().momentum[0];
  double before = initial, time = 0.0, first = 0.0, last = 0.0, largest = 0.0;
  run_to(simulation, end, [&](const solver::Simulation& s) {
    const double now = s.totals().momentum[0], t = s.state().time;
    if ((now > 0.0) != (before > 0.0)) {
      last = time + (t - time) * before / (before - now);  // of the zero
      if (first == 0.0) first = last;
    }
    if (t > 0.75 * period) largest = std::max(largest, now / initial);
    before = now;
    time = t;
  });
  const Wave wave{(last - first) / period, largest};
  std::printf("standing wave, %d cells: period %.5f of the exact, amplitude %.4f after it\n", cells,
              wave.period, wave.left);
  return wave;
}

// The period converges with first order, likely because the free surface is spread over a cell. The compressibility of
// this water changes it by less than (omega/(k c))^2 = 0.3 %.
TEST(Water, AStandingWaveHasThePeriodOfTheLinearTheoryAndLosesLittle) {
  double last = 0.0;
  for (const int cells : {10, 20, 40}) {
    const Wave wave = standing_wave(cells);
    const double error = std::abs(wave.period - 1.0);
    if (cells > 10) {
      EXPECT_LT(error, 0.65 * last) << cells;
      EXPECT_NEAR(wave.left, 1.0, 0.02) << cells;
    }
    last = error;
  }
  EXPECT_LT(last, 0.012);
}

}  // namespace
}  // namespace whipple::verification

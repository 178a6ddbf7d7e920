// SPDX-License-Identifier: BSD-3-Clause
// Water in tension (docs/theory/soil.md, section 7): a pulse of pressure of the peak P and the length w meets a free
// surface. Acoustics, depth d below the surface:
//   half a sine: without tensile strength all water down to w/2 opens in the moment in which the crest is reflected. It
//   keeps the velocity 2 P/(rho c) cos(pi d/w), and so the impulse of the pulse, and its gap grows with the rate
//   2 pi P/(rho c w) sin(pi d/w);
//   a pulse that falls linearly behind its front: with a strength S layers of the thickness w S/(2 P) part, the first
//   one with the velocity (2 P - S)/(rho c).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "tests/verification/contact_problems.hpp"

namespace whipple::verification {
namespace cavitation_test {

constexpr double peak = 1e6, speed = 1500.0, density = 1000.0;         // Pa, m/s, kg/m^3
constexpr double length = 0.5, pulse = 0.3, arrival = length / speed;  // m, s

std::string water(double strength) {
  const int percent = static_cast<int>(std::lround(100.0 * strength / peak));
  return write_material("water_with_strength_" + std::to_string(percent), R"toml(
name = "water"
source = "test"
[eos]
model = "mie_gruneisen"
source = "linear: c0 = 1500 m/s"
reference_density = "1000 kg/m^3"
hugoniot_intercept = "1500 m/s"
hugoniot_slope = 0.001
gruneisen = 0.001
heat_capacity = "4157 J/(kg K)"
[strength]
model = "none"
[[failure]]
model = "tensile_pressure"
source = "test"
spall_strength = ")toml" + number(strength) + " Pa\"\n");
}

/// A load over time: half a sine, or a front behind which the pressure falls linearly to zero.
std::string half_sine() {
  std::string times = "times = [0", factors = "factors = [0";
  constexpr int parts = 64;
  for (int i = 1; i <= parts; ++i) {
    times += ", " + number(i * pulse / speed / parts);
    factors += ", " + number(i < parts ? std::sin(i * std::numbers::pi / parts) : 0.0);
  }
  return times + "]\n" + factors + "]\n";
}
std::string front() { return "times = [0, " + number(pulse / speed) + "]\nfactors = [1, 0]\n"; }

/// A column of water of 0.5 m, one cell wide; the load acts on its left face.
cases::Case column(int cells, double strength, const std::string& load, double end) {
  const double size = length / cells;
  return cases::read_case_text(
      Method{}.time_toml(end) + Method{}.toml() +
          "[output]\nmaximum_energy_error = 10.0\n[domain]\ndimension = \"plane_strain\"\nlower = [0, "
          "0]\nupper = " +
          vector3({1.2 * length, size, 0.0}) + "\ncell_size = " + number(size) +
          "\nboundary = { x_lower = \"separating\", y_lower = \"symmetry\", y_upper = \"symmetry\" }\n"
          "[[load]]\nface = \"x_lower\"\npressure = " +
          number(peak) + "\n" + load +
          BodyOptions{"water", water(strength), box({0, 0, -1}, {length, size, 1})}.toml(),
      "column.toml");
}

/// Holds what the column has become, with the depths at the start.
struct Column {
  double area = 0.0, momentum = 0.0, impulse = 0.0, energy = 0.0;
  std::vector<double> depth = {}, mass = {}, velocity = {}, gap = {};  // gap over volume
};

Column run_column(int cells, double strength, const std::string& load, double end) {
  solver::Simulation simulation(column(cells, strength, load, end), parallel::world());
  std::vector<double> depth(simulation.particle_count());
  for (std::size_t p = 0; p < depth.size(); ++p) {
    const Particles& q = simulation.particles();
    depth.at(q.id[p]) = length - q.position[p][0];
  }
  EnergyWatch watch;
  run_to(simulation, end, std::ref(watch));
  const Particles& q = simulation.particles();
  Column result{.area = length / cells,
                .momentum = simulation.totals().momentum[0],
                .impulse = simulation.state().ledger.external_impulse[0],
                .energy = watch.worst};
  for (std::size_t p = 0; p < q.size(); ++p) {
    result.depth.push_back(depth.at(q.id[p]));
    result.mass.push_back(q.mass[p]);
    result.velocity.push_back(q.velocity[p][0]);
    result.gap.push_back(q.void_volume[p] / q.volume[p]);
  }
  return result;
}

TEST(Cavitation, APulseThatMeetsAFreeSurfaceOpensTheWaterWithItsExactVelocities) {
  using std::numbers::pi;
  const double since = 0.4 * pulse / speed;  // s since the water has opened
  double last = 0.0, last_gap = 0.0;
  for (const int cells : {50, 100, 200}) {
    const Column column = run_column(cells, 1.0, half_sine(), arrival + 0.5 * pulse / speed + since);
    double error = 0.0, scale = 0.0, of_gap = 0.0, opened = 0.0;
    const double fastest = 2.0 * peak / (density * speed);
    for (std::size_t p = 0; p < column.depth.size(); ++p) {
      const double phase = pi * column.depth[p] / pulse;
      const double exact = phase < 0.5 * pi ? fastest * std::cos(phase) : 0.0;
      error += column.mass[p] * std::abs(column.velocity[p] - exact);
      scale += column.mass[p] * exact;
      if (phase > 0.375 * pi) continue;  // the gap ends with a jump, spread by the end of the pulse
      const double gap = since * fastest * pi / pulse * std::sin(phase);
      of_gap += column.mass[p] * std::abs(column.gap[p] - gap);
      opened += column.mass[p] * gap;
    }
    error /= scale;
    of_gap /= opened;
    std::printf(
        "cavitation, %d cells: errors of velocity %.4f, gap %.4f, momentum %.6f of the impulse, energy "
        "%.1e\n",
        cells, error, of_gap, column.momentum / (2.0 / pi * peak * pulse / speed * column.area),
        column.energy);
    EXPECT_LT(column.energy, 1e-12) << cells;
    EXPECT_NEAR(column.momentum, column.impulse, 1e-9 * column.impulse) << cells;
    if (last > 0.0) {
      EXPECT_LT(error, 0.6 * last) << cells;
      EXPECT_LT(of_gap, 0.6 * last_gap) << cells;
    }
    last = error;
    last_gap = of_gap;
  }
  EXPECT_LT(last, 0.05);
}

TEST(Cavitation, WaterWithAStrengthPartsInLayersOfTheExactVelocity) {
  const double strength = 0.4 * peak, layer = 0.5 * pulse * strength / peak;
  const double exact = (2.0 * peak - strength) / (density * speed);
  double last = 0.0;
  for (const int cells : {50, 100, 200}) {
    const Column column = run_column(cells, strength, front(), arrival + 0.6 * pulse / speed);
    double momentum = 0.0, mass = 0.0, first = 1.0;
    for (std::size_t p = 0; p < column.depth.size(); ++p) {
      if (column.gap[p] > 0.0) first = std::min(first, column.depth[p]);
      if (column.depth[p] > 0.8 * layer) continue;
      momentum += column.mass[p] * column.velocity[p];
      mass += column.mass[p];
    }
    const double error = std::abs(momentum / mass / exact - 1.0);
    std::printf("layers, %d cells: first gap at %.4f of %.4f m, velocity %.4f of the exact\n", cells, first,
                layer, momentum / mass / exact);
    EXPECT_NEAR(first, layer, length / cells) << cells;
    // The linear viscosity spreads a front of sound by the root of its way and the cell.
    if (last > 0.0) {
      EXPECT_LT(error, 0.75 * last) << cells;
    }
    last = error;
  }
  EXPECT_LT(last, 0.12);
}

}  // namespace cavitation_test
}  // namespace whipple::verification

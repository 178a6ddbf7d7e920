// SPDX-License-Identifier: BSD-3-Clause
// Matter that flies towards mirror planes and walls: it does not act on them before it touches, and then as
// strongly as if it had touched from the start (docs/theory/mpm.md, section 3).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

constexpr double dx = 1e-4;     // m
constexpr double cells = 20.0;  // of the slab

/// Pressure of aluminium that a wall stops, exact.
double wall_pressure(double speed) { return 2785.0 * (5328.0 + 1.338 * speed) * speed; }
double shock_speed(double speed) { return 5328.0 + 1.338 * speed; }

std::string soft_aluminium() { return aluminium("soft_aluminium", "1 kPa"); }

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", x);
  return text;
}

/// A slab in a column of one cell, `gap` cells before a wall at x = 0 that it flies to.
struct Column {
  std::string wall = "symmetry";
  double gap = 0.0;      // cells
  double speed = 500.0;  // m/s
  Method method{};
  std::string more = {};  // of the body
  double offset = 0.0;    // cells, of the slab's particles against the nodes across the column

  [[nodiscard]] double touch() const { return gap * dx / speed; }
  [[nodiscard]] setup::Case read(double end) const {
    const double front = -gap * dx, rear = front - cells * dx;
    const std::string side = number(dx);
    return setup::read_case_text(
        method.time_toml(end) + method.toml() + "[output]\nmaximum_energy_error = 10.0\n[domain]\nlower = [" +
            number(-50 * dx) + ", 0, 0]\nupper = [0, " + side + ", " + side + "]\ncell_size = " + side +
            "\nboundary = { x_upper = \"" + wall +
            "\", y_lower = \"symmetry\", y_upper = \"symmetry\", z_lower = \"symmetry\", z_upper = "
            "\"symmetry\" }\n[[body]]\nname = \"slab\"\nmaterial = \"" +
            soft_aluminium() + "\"\nvelocity = [" + number(speed) + ", 0, 0]\n" + more +
            "shape = { box = { lower = [" + number(rear) + ", 0, 0], upper = [" + number(front) + ", " + side +
            ", " + side + "] } }\n",
        "column.toml");
  }
};

struct Hit {
  double peak = 0.0;        // largest pressure / exact
  double early = 0.0;       // cells of approach that were left at the first pressure
  double plateau = 0.0;     // mean pressure of the middle of the shocked matter / exact
  double before = 0.0;      // largest impulse on the body before it touches / its momentum
  double impulse_error = 0.0, energy_error = 0.0;
  double contact_heat = 0.0;  // share of the kinetic energy
  int steps = 0;
};

Hit hit(const Column& column) {
  const double us = shock_speed(column.speed), exact = wall_pressure(column.speed);
  const double end = column.touch() + 0.85 * cells * dx / us;
  solver::Simulation simulation(column.read(end), parallel::world());
  const Vector3 momentum = simulation.totals().momentum;
  Hit result;
  double first = -1.0;
  EnergyWatch watch;
  run_to(simulation, end, [&](const solver::Simulation& s) {
    watch(s);
    ++result.steps;
    const double p = *std::ranges::max_element(s.particles().pressure);
    result.peak = std::max(result.peak, p / exact);
    if (first < 0.0 && p > 0.02 * exact) first = s.state().time - s.state().time_step;
    const Vector3 impulse = s.state().ledger.wall_impulse;
    if (s.state().time < column.touch()) {
      result.before = std::max(result.before, impulse.norm() / momentum.norm());
    }
    result.impulse_error =
        std::max(result.impulse_error, (s.totals().momentum - momentum - impulse).norm() / momentum.norm());
  });
  result.early = (column.touch() - first) * column.speed / dx;
  result.energy_error = watch.worst;
  result.contact_heat =
      simulation.state().ledger.contact_heat / (0.5 * simulation.totals().mass * column.speed * column.speed);
  double sum = 0.0;
  int count = 0;
  const Particles& q = simulation.particles();
  for (std::size_t p = 0; p < q.size(); ++p) {
    // Matter keeps its order: by its mass from the front.
    const double depth = -q.position[p][0] / dx * (us / (us - column.speed));
    if (depth < 3.0 || depth > 12.0) continue;
    sum += q.pressure[p];
    ++count;
  }
  result.plateau = sum / count / exact;
  return result;
}

void print(const Column& column, const Hit& h) {
  std::printf(
      "%-10s %5.0f m/s gap %4.1f: peak %.3f, plateau %.3f, first %+.3f cells early, before %.1e, impulse %.1e, "
      "energy %.1e, heat %.1e, %d steps\n",
      column.wall.c_str(), column.speed, column.gap, h.peak, h.plateau, h.early, h.before, h.impulse_error,
      h.energy_error, h.contact_heat, h.steps);
}

TEST(WallContact, Survey) {
  for (const char* wall : {"symmetry", "separating", "no_slip"}) {
    for (const double speed : {200.0, 500.0, 2000.0, 6000.0}) {
      for (const double gap : {0.0, 0.1, 0.5, 1.0, 2.0, 5.0, 20.0}) {
        Column column{.wall = wall, .gap = gap, .speed = speed};
        print(column, hit(column));
      }
    }
  }
}

}  // namespace
}  // namespace whipple::verification

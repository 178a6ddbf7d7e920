// SPDX-License-Identifier: BSD-3-Clause
// Heat conduction in the solver: a hot core in a cold shell of the same material, rings about an axis.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

constexpr double radius = 1e-3, diffusivity = 0.1;  // m, m^2/s

/// Temperatures at the radii (i + 1/2) radius/n after a time, by finite volumes.
std::vector<double> radial_decay(std::size_t n, double end) {
  const double dr = radius / static_cast<double>(n);
  const auto steps = static_cast<std::size_t>(std::ceil(end * diffusivity / (0.25 * dr * dr)));
  const double number = diffusivity * end / static_cast<double>(steps) / (dr * dr);
  std::vector<double> t(n), flux(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) t[i] = 2 * i < n ? 600.0 : 300.0;
  for (std::size_t step = 0; step < steps; ++step) {
    for (std::size_t i = 1; i < n; ++i) flux[i] = static_cast<double>(i) * (t[i] - t[i - 1]);
    for (std::size_t i = 0; i < n; ++i)
      t[i] += number * (flux[i + 1] - flux[i]) / (static_cast<double>(i) + 0.5);
  }
  return t;
}

// Also for particles next to the step, which share their cells with particles of the other temperature
TEST(Conduction, StepOfTemperatureAboutAnAxisDecaysAsTheExactOne) {
  const std::string material = write_material("conductor", R"toml(
name = "no thermal pressure"
source = "constants of the verification problems"
[eos]
model = "mie_gruneisen"
source = "test"
reference_density = "8930 kg/m^3"
hugoniot_intercept = "3940 m/s"
hugoniot_slope = 1.49
gruneisen = 1e-6
heat_capacity = "385 J/(kg K)"
[strength]
model = "elastic"
source = "test"
shear_modulus = "1 GPa"
[thermal]
source = "test"
conductivity = "343805 W/(m K)"
)toml");
  const auto body = [&](const char* name, double inner, double outer, const char* more) {
    return fmt::format(R"(
[[body]]
name = "{}"
material = "{}"
{}
shape = {{ box = {{ lower = ["0 mm", "{} mm", "-1 mm"], upper = ["0.2 mm", "{} mm", "1 mm"] }} }}
)",
                       name, material, more, inner, outer);
  };
  const std::string text = R"(
[domain]
dimension = "axisymmetric"
lower = ["0 mm", "0 mm"]
upper = ["0.2 mm", "1 mm"]
cell_size = "0.05 mm"
boundary = { x_lower = "symmetry", x_upper = "symmetry", y_upper = "separating" }
[time]
end = "1 us"
[heat]
conduction = true
[contact]
method = "none"
)" + body("core", -0.5, 0.5, "initial = { temperature = \"600 K\", pressure = \"0 Pa\" }") +
                           body("shell", 0.5, 1.0, "");
  solver::Simulation simulation(cases::read_case_text(text, "conduction.toml"), parallel::world());
  const double before = simulation.totals().internal_energy;
  run_to(simulation, 1e-6);
  EXPECT_NEAR(simulation.totals().internal_energy, before, 1e-12 * std::abs(before));
  constexpr std::size_t n = 200;
  const std::vector<double> exact = radial_decay(n, 1e-6);
  const Particles& particles = simulation.particles();
  double largest = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double at = particles.position[p][1] / radius * n - 0.5;
    const auto i = std::min(static_cast<std::size_t>(std::max(at, 0.0)), n - 2);
    const double part = std::clamp(at - static_cast<double>(i), 0.0, 1.0);
    largest =
        std::max(largest, std::abs(particles.temperature[p] - (exact[i] + part * (exact[i + 1] - exact[i]))));
  }
  fmt::print("step about an axis: largest error {:.2f} K of 300 K\n", largest);
  EXPECT_LT(largest, 1.0);
}

}  // namespace
}  // namespace whipple::verification

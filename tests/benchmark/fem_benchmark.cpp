// SPDX-License-Identifier: BSD-3-Clause
// Time of a step of finite elements per element: forces, motion, deformation and constitutive update of a
// body of 32^3 elements that vibrates. `items_per_second` is element-steps per second.
#include <benchmark/benchmark.h>

#include <random>

#include "src/fem/step.hpp"
#include "src/fem/structured.hpp"
#include "src/material/material_file.hpp"
#include "src/material/update.hpp"

namespace whipple {
namespace {

constexpr std::size_t side = 32;

enum class Part { forces, motion, deformation, material, step };

void elements(benchmark::State& state, const char* name, fem::Quadrature quadrature, Part part) {
  const Material material = read_material(name);
  fem::Mesh mesh = fem::make_mesh(
      fem::make_box(Vector3::Zero(), Vector3::Constant(side * 1e-3), {side, side, side}), quadrature);
  fem::set_density(mesh, material.reference.density);
  initialise(material, mesh.points, 0, mesh.points.size());
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> uniform(-10.0, 10.0);
  for (Vector3& v : mesh.nodes.velocity)
    v = Vector3(uniform(generator), uniform(generator), uniform(generator));
  fem::Motion motion;
  fem::VelocityGradients gradients;
  gradients.resize(mesh.points.size());
  const fem::ViscosityCoefficients viscosity;
  double dt = 0.0;
  const auto update = [&](std::size_t begin, std::size_t end) {
    UpdateSettings settings;
    settings.time_step = dt;
    settings.lengths = mesh.points.length;
    const MaterialReport report =
        update_material(material, mesh.points, begin, end, gradients.from(begin), settings);
    if (!report.valid()) state.SkipWithError("a point left the range of its model");
  };
  const auto step = [&] {
    dt = 0.9 * fem::critical_time_step(mesh, viscosity);
    fem::internal_forces(mesh);
    fem::advance_velocities(mesh, dt, motion);
    fem::deform(mesh, motion, dt, {}, gradients, update);
    fem::move_nodes(mesh, motion, dt);
  };
  step();
  fem::VelocityGradients reversed = gradients;
  for (std::vector<double>& component : reversed.component) {
    for (double& rate : component) rate = -rate;
  }
  for (auto _ : state) {
    switch (part) {
      case Part::forces:
        mesh.blocks.forces_stand = false;
        fem::internal_forces(mesh);
        break;
      case Part::motion:
        dt = 0.9 * fem::critical_time_step(mesh, viscosity);
        fem::advance_velocities(mesh, 0.0, motion);
        fem::move_nodes(mesh, motion, 0.0);
        break;
      case Part::deformation:
        fem::deform(mesh, motion, 1e-12, {}, gradients);
        break;
      case Part::material:  // back and forth, so that the points stay near their state
        update(0, mesh.points.size());
        std::swap(gradients, reversed);
        break;
      case Part::step:
        step();
        break;
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.elements.size()));
}

using enum fem::Quadrature;
constexpr const char* plastic = "copper_taylor";
BENCHMARK_CAPTURE(elements, one_point_step, plastic, one_point, Part::step);
BENCHMARK_CAPTURE(elements, one_point_forces, plastic, one_point, Part::forces);
BENCHMARK_CAPTURE(elements, one_point_motion, plastic, one_point, Part::motion);
BENCHMARK_CAPTURE(elements, one_point_deformation, plastic, one_point, Part::deformation);
BENCHMARK_CAPTURE(elements, one_point_material, plastic, one_point, Part::material);
BENCHMARK_CAPTURE(elements, one_point_step_gray_johnson_cook, "copper", one_point, Part::step);
BENCHMARK_CAPTURE(elements, b_bar_step, plastic, b_bar, Part::step);
BENCHMARK_CAPTURE(elements, b_bar_forces, plastic, b_bar, Part::forces);
BENCHMARK_CAPTURE(elements, b_bar_deformation, plastic, b_bar, Part::deformation);

}  // namespace
}  // namespace whipple

BENCHMARK_MAIN();

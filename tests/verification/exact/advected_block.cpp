// SPDX-License-Identifier: BSD-3-Clause
#include "tests/verification/exact/advected_block.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "eos/loci.hpp"
#include "src/material/material_file.hpp"
#include "src/transfer/shapes.hpp"
#include "tests/verification/exact/planar_impact.hpp"
#include "tests/verification/exact/runs.hpp"

namespace whipple::verification::exact {

double force_noise(double per_cell, double slope_smoothing) {
  constexpr int samples = 200;
  double sum = 0.0;
  for (int sample = 0; sample < samples; ++sample) {
    double force = 0.0;  // of particles on a lattice at a node in their midst, over p dx^2
    for (double x = -2.0 + (sample + 0.5) / (samples * per_cell); x < 2.0; x += 1.0 / per_cell) {
      const double node = std::floor(x + 0.5), y = x - node;  // its middle node
      if (std::abs(node) > 1.0) continue;
      const auto at = transfer::QuadraticBSpline::weights(y + 1.0, {1.0, slope_smoothing});
      force += at.derivative[static_cast<std::size_t>(1.0 - node)] / per_cell;
    }
    sum += force * force / samples;
  }
  return sum;
}

Result run(const AdvectedBlock& block, double cell) {
  const std::string material = hydrodynamic(block.material);
  const Material metal = read_material(material);
  const eos::State reference = initial_state(metal);
  const auto on_isentrope = [&](double density) {
    return eos::isentrope(*metal.eos, reference, {density}).front().state;
  };
  const eos::State cold = on_isentrope(reference.density / (1.0 - block.compression));
  const eos::State state = metal.eos->state(cold.density, cold.specific_internal_energy + block.extra_energy);
  const double end = block.way / block.speed, stretch = 1.0 - block.compression;
  const double core = 10 * cell;  // half its length
  const double half = cell * std::ceil((core + 6 * cell + 1.5 * state.sound_speed * end) / (stretch * cell));
  const double reach = cell * std::ceil((half + 2.0 * state.sound_speed * end + block.way) / cell);
  const cases::Case setup =
      default_case(end,
                   fmt::format(R"(
[splitting]
length = 0
[domain]
lower = [0, 0, {0:.9g}]
upper = [{1:.9g}, {1:.9g}, {2:.9g}]
cell_size = {3:.9g}
boundary = {{ x_lower = "symmetry", y_lower = "symmetry", x_upper = "symmetry", y_upper = "symmetry" }}
[[body]]
name = "block"
material = "{4}"
velocity = [0, 0, {5}]
shape = {{ box = {{ lower = [0, 0, {6:.9g}], upper = [{1:.9g}, {1:.9g}, {7:.9g}] }} }}
)",
                               -reach, 2 * cell, reach, cell, material, block.speed, -half, half),
                   {}, fmt::format("courant = {}\n", block.courant));
  solver::Simulation simulation = start_with(setup, [&](Particles& q) {
    for (std::size_t p = 0; p < q.size(); ++p) {
      q.position[p][2] *= stretch;
      q.extent[p].zz *= stretch * stretch;
    }
    initialise(metal, q, 0, q.size(), state);
  });
  const auto start = positions_by_id(simulation.particles());
  EnergyWatch energy_watch;
  run_to(simulation, end, [&](const solver::Simulation& now) { energy_watch(now); });

  const Particles& q = simulation.particles();
  Mean heat, kept, density;
  for (std::size_t p = 0; p < q.size(); ++p) {
    if (std::abs(start[q.id[p]][2]) > core) continue;
    const double now = q.mass[p] / q.volume[p];
    heat.add(q.specific_internal_energy[p] - block.extra_energy - on_isentrope(now).specific_internal_energy,
             q.mass[p]);
    if (!q.unresolved_energy.empty()) kept.add(q.unresolved_energy[p], q.mass[p]);
    density.add(now / state.density, q.mass[p]);
  }
  const double crossed = block.way / cell, step = end / static_cast<double>(simulation.state().step);
  const double law = force_noise(2.0 / stretch, setup.transfer.slope_smoothing) *
                     std::pow(state.pressure / state.density, 2) * step / (block.speed * cell);
  Result result{block.name, cell, {}, {}};
  result.add("cells crossed", crossed, crossed);
  result.add("heat per cell crossed, J/kg", 0, heat.value() / crossed);
  result.add("unresolved energy per cell crossed, J/kg", 0, kept.value() / crossed);
  result.add("law with gamma 1, J/kg", std::nan(""), law);
  result.add("change of the density", 0, density.value() - 1.0);
  result.add("largest energy error", 0, energy_watch.worst);
  return result;
}

}  // namespace whipple::verification::exact

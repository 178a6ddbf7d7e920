// SPDX-License-Identifier: BSD-3-Clause
#include "tests/verification/exact/piston.hpp"

#include <fmt/format.h>

#include <cmath>

#include "eos/root.hpp"
#include "tests/verification/exact/runs.hpp"

namespace whipple::verification::exact {
namespace {

/// State behind a front in material of a stress, by the Hugoniot equation of energy at a density.
PlateauState behind(const eos::EquationOfState& eos, const PlateauState& before, double density,
                    double yield) {
  const double change = 1 / before.density - 1 / density;
  const auto energy_at = [&](double stress) {
    return before.energy + 0.5 * (before.stress + stress) * change;
  };
  const auto stress_of = [&](double energy) { return eos.state(density, energy).pressure + 2 * yield / 3; };
  const double guess = stress_of(before.energy);
  const double stress = eos::find_root([&](double s) { return stress_of(energy_at(s)) - s; }, 0.5 * guess,
                                       3 * guess, "stress behind the front");
  const double jump = std::sqrt((stress - before.stress) * change);
  return {density, stress - 2 * yield / 3, stress, -2 * yield / 3, energy_at(stress), before.velocity + jump};
}

}  // namespace

TwoWaves::TwoWaves(const Material& material, double shear_modulus, double yield_stress, double speed) {
  const eos::EquationOfState& eos = *material.eos;
  const eos::State& rest = material.reference;
  ahead_ = {rest.density, 0, 0, 0, rest.specific_internal_energy, -speed};
  elastic_ = behind(eos, ahead_, rest.density * std::exp(yield_stress / (2 * shear_modulus)), yield_stress);
  const double density = eos::find_root(
      [&](double rho) { return behind(eos, elastic_, rho, yield_stress).velocity; },
      elastic_.density * (1 + 1e-6), 1.5 * elastic_.density, "density behind the plastic front");
  plastic_ = behind(eos, elastic_, density, yield_stress);
  const auto speed_of = [&](const PlateauState& before, const PlateauState& after) {
    return (after.stress - before.stress) / (after.velocity - before.velocity) / rest.density;
  };
  elastic_speed_ = speed_of(ahead_, elastic_);
  plastic_speed_ = speed_of(elastic_, plastic_);
}

PlateauState TwoWaves::at(double x, double time) const {
  const double plastic_front = plastic_speed_ * time * ahead_.density / plastic_.density;
  const double elastic_front =
      plastic_front + (elastic_speed_ - plastic_speed_) * time * ahead_.density / elastic_.density;
  return x < plastic_front ? plastic_ : x < elastic_front ? elastic_ : ahead_;
}

Result elastic_plastic_piston(int cells) {
  constexpr double length = 10e-3, end = 1.2e-6, speed = 400;
  const double dx = length / cells;
  const std::string text = fmt::format(R"(
[domain]
lower = [0, 0, 0]
upper = [0.011, {0:.9g}, {0:.9g}]
cell_size = {0:.9g}
boundary = {{ x_lower = "symmetry", y_lower = "symmetry", y_upper = "symmetry", z_lower = "symmetry", z_upper = "symmetry" }}
[[body]]
name = "bar"
material = "{1}"
velocity = [{2}, 0, 0]
shape = {{ box = {{ lower = [0, 0, 0], upper = [{3:.9g}, {0:.9g}, {0:.9g}] }} }}
)",
                                       dx, aluminium("piston_aluminium", "1 GPa"), -speed, length);
  solver::Simulation simulation(default_case(end, text), parallel::world());
  const auto start = positions_by_id(simulation.particles());
  EnergyWatch watch;
  run_to(simulation, end, std::ref(watch));

  const TwoWaves exact(*simulation.setup().materials[0], 27.6e9, 1e9, speed);
  const PlateauState &rest = exact.ahead(), &elastic = exact.elastic(), &plastic = exact.plastic();
  const Particles& q = simulation.particles();
  L1 density, velocity, pressure, deviator, energy;
  Mean elastic_stress, plastic_stress, plastic_energy, first_energy;
  Layers layers(dx, 10);
  double swept_elastic = 0, swept_plastic = 0;
  for (std::size_t p = 0; p < q.size(); ++p) {
    const double x = q.position[p][0], depth = start[q.id[p]][0], volume = q.volume[p];
    const PlateauState state = exact.at(x, end);
    const double stress = q.pressure[p] - q.deviatoric_stress[p].xx, e = q.specific_internal_energy[p];
    const auto swept_by = [&](double threshold) {  // m, material coordinate
      return stress > threshold ? q.mass[p] / (rest.density * dx * dx) : 0.0;
    };
    density.add(q.mass[p] / volume, state.density, volume, plastic.density);
    velocity.add(q.velocity[p][0], state.velocity, volume, speed);
    pressure.add(q.pressure[p], state.pressure, volume, plastic.pressure);
    deviator.add(q.deviatoric_stress[p].xx, state.deviator, volume, -plastic.deviator);
    energy.add(e - rest.energy, state.energy - rest.energy, volume, plastic.energy - rest.energy);
    swept_elastic += swept_by(0.5 * elastic.stress);
    swept_plastic += swept_by(0.5 * (elastic.stress + plastic.stress));
    const double ratio = (e - rest.energy) / (plastic.energy - rest.energy);
    layers.add(depth, ratio, q.mass[p]);
    if (depth < dx) first_energy.add(ratio, q.mass[p]);
    const double front = exact.plastic_speed() * end, precursor = exact.elastic_speed() * end;
    if (depth > 0.2 * front && depth < 0.8 * front) {
      plastic_stress.add(stress / plastic.stress, q.mass[p]);
      plastic_energy.add(ratio, q.mass[p]);
    }
    if (depth > front + 0.35 * (precursor - front) && depth < front + 0.65 * (precursor - front)) {
      elastic_stress.add(stress / elastic.stress, q.mass[p]);
    }
  }
  Result result{fmt::format("{} cells", cells), dx, {}, {}};
  result.add("L1 density", 0, density.value());
  result.add("L1 velocity", 0, velocity.value());
  result.add("L1 pressure", 0, pressure.value());
  result.add("L1 s_xx", 0, deviator.value());
  result.add("L1 energy", 0, energy.value());
  result.add("speed of the elastic front, m/s", exact.elastic_speed(), swept_elastic / end);
  result.add("speed of the plastic front, m/s", exact.plastic_speed(), swept_plastic / end);
  result.add("stress behind the elastic front over exact", 1, elastic_stress.value());
  result.add("stress behind the plastic front over exact", 1, plastic_stress.value());
  result.add("e behind the plastic front over exact", 1, plastic_energy.value());
  result.add("e of the first cell over exact", 1, first_energy.value());
  result.add("largest energy error", 0, watch.worst);
  result.add("e over exact, cells 1 to 10 from the wall", layers.values());
  return result;
}

}  // namespace whipple::verification::exact

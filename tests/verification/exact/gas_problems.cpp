// SPDX-License-Identifier: BSD-3-Clause
#include "tests/verification/exact/gas_problems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "tests/verification/exact/runs.hpp"

namespace whipple::verification::exact {
namespace {

constexpr double cold = 1e-6;  ///< Pa, pressure of cold gas: 1e-6 of that behind the shocks

std::string column(int cells, double width) {
  return fmt::format(R"(
[domain]
lower = [0, 0, 0]
upper = [1, {0}, {0}]
cell_size = {1:.17g}
boundary = {{ x_lower = "symmetry", x_upper = "symmetry", y_lower = "symmetry", y_upper = "symmetry", z_lower = "symmetry", z_upper = "symmetry" }}
)",
                     width, 1.0 / cells);
}

std::string octant(double edge, int cells) {
  return fmt::format(R"(
[domain]
lower = [0, 0, 0]
upper = [{0}, {0}, {0}]
cell_size = {1:.17g}
boundary = {{ x_lower = "symmetry", x_upper = "symmetry", y_lower = "symmetry", y_upper = "symmetry", z_lower = "symmetry", z_upper = "symmetry" }}
)",
                     edge, edge / cells);
}

struct GasErrors {
  bool over_mass = false;  ///< instead of the volume: where thin hot gas would outweigh the rest
  L1 density, velocity, pressure, energy;

  void add(const Particles& q, std::size_t p, double velocity_now, const GasState& exact, double gamma,
           const GasState& scale) {
    const double weight = over_mass ? q.mass[p] : q.volume[p];
    density.add(q.mass[p] / q.volume[p], exact.density, weight, scale.density);
    velocity.add(velocity_now, exact.velocity, weight, scale.velocity);
    pressure.add(q.pressure[p], exact.pressure, weight, scale.pressure);
    energy.add(q.specific_internal_energy[p], exact.energy(gamma), weight, scale.energy(gamma));
  }
  /// @param with_energy  false where it has no bound: the centre of a blast
  void report(Result& result, bool with_energy = true) const {
    result.add("L1 density", 0, density.value());
    result.add("L1 velocity", 0, velocity.value());
    result.add("L1 pressure", 0, pressure.value());
    if (with_energy) result.add("L1 energy", 0, energy.value());
  }
};

Result result_of(int cells, double cell) { return {fmt::format("{} cells", cells), cell, {}, {}}; }

}  // namespace

Result sod(int cells) {
  constexpr double gamma = 1.4, end = 0.2;
  const GasState left{1, 0, 1}, right{0.125, 0, 0.1};
  const double dx = 1.0 / cells;
  std::string text = column(cells, dx);
  for (const auto& [name, from, state] : {std::tuple("left", 0.0, left), std::tuple("right", 0.5, right)}) {
    text += fmt::format(R"(
[[body]]
name = "{}"
material = "{}"
contact_group = "gas"
initial = {{ density = {}, pressure = {} }}
shape = {{ box = {{ lower = [{}, 0, 0], upper = [{}, {}, {}] }} }}
)",
                        name, gas(gamma), state.density, state.pressure, from, from + 0.5, dx, dx);
  }
  // Layers beside the contact are known by the numbers of their particles: none is split.
  solver::Simulation simulation(default_case(end, text, "[splitting]\nlength = 0\n"), parallel::world());
  const auto start = positions_by_id(simulation.particles());
  run_to(simulation, end);

  const RiemannProblem exact(left, right, gamma);
  const Particles& q = simulation.particles();
  GasErrors errors;
  L1 entropy;
  Mean left_of_contact, right_of_contact;
  for (std::size_t p = 0; p < q.size(); ++p) {
    const double x = q.position[p][0];
    const GasState state = exact.at((x - 0.5) / end);
    errors.add(q, p, q.velocity[p][0], state, gamma, {1, 1, gamma - 1});  // scales: 1
    const double density = q.mass[p] / q.volume[p];
    const auto entropy_of = [&](double pressure, double rho) {
      return std::log(pressure / std::pow(rho, gamma));
    };
    entropy.add(entropy_of(q.pressure[p], density), entropy_of(state.pressure, state.density), q.volume[p]);
    // By the material, not by the place: the entropy that two cells on either side of the contact have.
    const double depth = std::abs(start[q.id[p]][0] - 0.5);
    if (depth > 2 * dx) continue;
    const GasState beside = exact.at(exact.star_velocity() + (start[q.id[p]][0] < 0.5 ? -1e-9 : 1e-9));
    (start[q.id[p]][0] < 0.5 ? left_of_contact : right_of_contact)
        .add(q.specific_internal_energy[p] / beside.energy(gamma), q.mass[p]);
  }
  Result result = result_of(cells, dx);
  errors.report(result);
  result.add("L1 entropy", 0, entropy.value());
  result.add("e of two cells left of the contact over exact", 1, left_of_contact.value());
  result.add("e of two cells right of the contact over exact", 1, right_of_contact.value());
  result.add("energy error", 0, simulation.state().ledger.energy_error(simulation.totals()));
  return result;
}

Result noh_planar(int cells) {
  constexpr double end = 0.6;
  const Noh exact{1, 5.0 / 3};
  const double dx = 1.0 / cells;
  const std::string text = column(cells, dx) + fmt::format(R"(
[[body]]
name = "gas"
material = "{}"
velocity = [-1, 0, 0]
initial = {{ density = 1, pressure = {} }}
shape = {{ box = {{ lower = [0, 0, 0], upper = [1, {}, {}] }} }}
)",
                                                           gas(exact.gamma), cold, dx, dx);
  solver::Simulation simulation(default_case(end, text), parallel::world());
  const auto start = positions_by_id(simulation.particles());
  run_to(simulation, end);

  const Particles& q = simulation.particles();
  const GasState shocked = exact.at(0, end), scale{shocked.density, 1.0, shocked.pressure};
  GasErrors errors;
  Layers density(dx, 10), energy(dx, 10), entropy(dx, 10);
  Mean first_energy, first_density;
  double excess = 0;
  for (std::size_t p = 0; p < q.size(); ++p) {
    const double x = q.position[p][0], x0 = start[q.id[p]][0];
    if (x > 0.38) continue;  // without the free end
    const double rho = q.mass[p] / q.volume[p], e = q.specific_internal_energy[p];
    errors.add(q, p, q.velocity[p][0], exact.at(x, end), exact.gamma, scale);
    density.add(x0, rho / shocked.density, q.mass[p]);
    energy.add(x0, e / 0.5, q.mass[p]);
    entropy.add(x0, std::log(q.pressure[p] / shocked.pressure / std::pow(rho / shocked.density, exact.gamma)),
                q.mass[p]);
    if (x0 < 10 * dx) excess += q.mass[p] * (e / 0.5 - 1) / (dx * dx * dx);
    if (x0 > dx) continue;
    first_density.add(rho / shocked.density, q.mass[p]);
    first_energy.add(e / 0.5, q.mass[p]);
  }
  Result result = result_of(cells, dx);
  errors.report(result);
  result.add("first cell: rho over exact", 1, first_density.value());
  result.add("first cell: e over exact", 1, first_energy.value());
  result.add("excess of e in the first ten cells, cells", 0, excess);
  result.add("energy error", 0, simulation.state().ledger.energy_error(simulation.totals()));
  result.add("rho over exact, cells 1 to 10", density.values());
  result.add("e over exact, cells 1 to 10", energy.values());
  result.add("ln of p/rho^gamma over exact, cells 1 to 10", entropy.values());
  return result;
}

Result noh_spherical(int cells) {
  constexpr double end = 0.6;
  const Noh exact{3, 5.0 / 3};
  const double dx = 1.0 / cells;
  const cases::Case setup = default_case(end, octant(1.0, cells) + fmt::format(R"(
[[body]]
name = "gas"
material = "{}"
initial = {{ density = 1, pressure = {} }}
shape = {{ sphere = {{ center = [0, 0, 0], radius = 1 }} }}
)",
                                                                               gas(exact.gamma), cold));
  solver::Simulation simulation = start_with(setup, [](Particles& particles) {
    for (std::size_t p = 0; p < particles.size(); ++p)
      particles.velocity[p] = -particles.position[p].normalized();
  });
  const auto start = positions_by_id(simulation.particles());
  run_to(simulation, end);

  const Particles& q = simulation.particles();
  const GasState shocked = exact.at(0, end), scale{shocked.density, 1.0, shocked.pressure};
  GasErrors errors{.over_mass = true, .density = {}, .velocity = {}, .pressure = {}, .energy = {}};
  Layers density(dx, 10), energy(dx, 10);
  Mean inner_density, inner_energy, plateau_density, plateau_pressure;
  for (std::size_t p = 0; p < q.size(); ++p) {
    const double r = q.position[p].norm(), r0 = start[q.id[p]].norm();
    if (r > 0.38) continue;
    const double rho = q.mass[p] / q.volume[p], e = q.specific_internal_energy[p];
    errors.add(q, p, q.velocity[p].dot(q.position[p]) / r, exact.at(r, end), exact.gamma, scale);
    density.add(r0, rho / shocked.density, q.mass[p]);
    energy.add(r0, e / 0.5, q.mass[p]);
    if (r < 0.05) {
      inner_density.add(rho / shocked.density, q.volume[p]);
      inner_energy.add(e / 0.5, q.volume[p]);
    } else if (r > 0.08 && r < 0.15) {
      plateau_density.add(rho / shocked.density, q.volume[p]);
      plateau_pressure.add(q.pressure[p] / shocked.pressure, q.volume[p]);
    }
  }
  Result result = result_of(cells, dx);
  errors.report(result);
  result.add("rho over exact, 0.08 to 0.15 m", 1, plateau_density.value());
  result.add("p over exact, 0.08 to 0.15 m", 1, plateau_pressure.value());
  result.add("rho over exact, within 0.05 m", 1, inner_density.value());
  result.add("e over exact, within 0.05 m", 1, inner_energy.value());
  result.add("energy error", 0, simulation.state().ledger.energy_error(simulation.totals()));
  result.add("rho over exact, cells 1 to 10", density.values());
  result.add("e over exact, cells 1 to 10", energy.values());
  return result;
}

Result sedov(int cells) {
  constexpr double end = 1.0, edge = 1.2, gamma = 1.4, energy = 0.851072;
  const Sedov exact(energy, 1.0, gamma);
  const double dx = edge / cells;
  const cases::Case setup =
      default_case(end, octant(edge, cells) + fmt::format(R"(
[[body]]
name = "gas"
material = "{}"
initial = {{ density = 1, pressure = {} }}
shape = {{ box = {{ lower = [0, 0, 0], upper = [{}, {}, {}] }} }}
)",
                                                          gas(gamma), cold, edge, edge, edge));
  solver::Simulation simulation = start_with(setup, [&](Particles& particles) {
    const eos::EquationOfState& eos = *setup.materials[0]->eos;
    double mass = 0;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      if (particles.position[p].norm() < 2 * dx) mass += particles.mass[p];
    }
    for (std::size_t p = 0; p < particles.size(); ++p) {
      if (particles.position[p].norm() >= 2 * dx) continue;
      const eos::State hot = eos.state(1.0, particles.specific_internal_energy[p] + energy / 8 / mass);
      particles.specific_internal_energy[p] = hot.specific_internal_energy;
      particles.pressure[p] = hot.pressure;
      particles.temperature[p] = hot.temperature;
      particles.sound_speed[p] = hot.sound_speed;
    }
  });
  run_to(simulation, end);

  const Particles& q = simulation.particles();
  const double front = exact.shock_radius(end);
  const GasState behind = exact.at(front * (1 - 1e-9), end);
  GasErrors errors{.over_mass = true, .density = {}, .velocity = {}, .pressure = {}, .energy = {}};
  Layers shells(0.5 * dx, static_cast<std::size_t>(2 * cells)),
      density(0.5 * dx, static_cast<std::size_t>(2 * cells));
  for (std::size_t p = 0; p < q.size(); ++p) {
    const double r = q.position[p].norm();
    if (r > edge) continue;
    errors.add(q, p, q.velocity[p].dot(q.position[p]) / r, exact.at(r, end), gamma, behind);
    shells.add(r, q.pressure[p] / behind.pressure, q.volume[p]);
    density.add(r, q.mass[p] / q.volume[p] / behind.density, q.volume[p]);
  }
  // The outermost place where the pressure passes half of that behind the shock.
  const std::vector<double> pressure = shells.values();
  double radius = 0;
  for (std::size_t i = pressure.size() - 1; i > 0 && radius == 0; --i) {
    if (!(pressure[i - 1] > 0.5)) continue;
    radius =
        0.5 * dx * (static_cast<double>(i) - 0.5 + (pressure[i - 1] - 0.5) / (pressure[i - 1] - pressure[i]));
  }
  const std::vector<double> shell_density = density.values();
  double densest = 0;
  for (const double rho : shell_density) densest = std::max(densest, std::isnan(rho) ? 0.0 : rho);
  Result result = result_of(cells, dx);
  errors.report(result, false);
  result.add("radius of the shock over exact", 1, radius / front);
  result.add("largest density of a shell over that behind the shock", 1, densest);
  result.add("kinetic fraction of the energy", exact.kinetic_share(),
             (simulation.totals().kinetic_energy + simulation.totals().affine_kinetic_energy) / (energy / 8));
  result.add("energy error", 0, simulation.state().ledger.energy_error(simulation.totals()));
  return result;
}

}  // namespace whipple::verification::exact

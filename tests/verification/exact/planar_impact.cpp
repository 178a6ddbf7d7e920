// SPDX-License-Identifier: BSD-3-Clause
#include "tests/verification/exact/planar_impact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <map>
#include <sstream>

#include "src/core/base/error.hpp"
#include "src/material/material_file.hpp"
#include "tests/folders.hpp"
#include "tests/verification/exact/runs.hpp"

namespace whipple::verification::exact {
namespace {

/// Sums over one body.
struct BodyFigures {
  Mean energy, exact_energy, half_cell, first_cell, plateau, entropy, shock_pressure, shock_density,
      shock_energy;
  Mean first_release, plateau_first_release;
  Mean melted;
  double hottest = 0, not_solid = 0, mass = 0, largest_pressure = 0;
};

}  // namespace

std::string hydrodynamic(const std::string& material) {
  static std::map<std::string, std::string> written;
  const auto [known, is_new] = written.try_emplace(material);
  if (!is_new) return known->second;
  const std::filesystem::path file = find_material(material, whipple::tests::source_folder());
  std::ifstream in(file);
  std::string text, line;
  bool left_out = false;
  while (std::getline(in, line)) {
    if (line.starts_with("[")) left_out = line.starts_with("[strength]") || line.starts_with("[[failure]]");
    if (!left_out) text += line + "\n";
  }
  text +=
      "[strength]\nmodel = \"none\"\n[[failure]]\nmodel = \"tensile_pressure\"\nsource = "
      "\"test\"\nspall_strength = "
      "\"0.9 GPa\"\n";
  return known->second = write_material("hydrodynamic_" + file.stem().string(), text);
}

std::vector<PlanarImpact> planar_impacts() {
  const std::string lead = "cases/lead_sphere_on_plate_gray/lead_linear.toml";
  return {{"Al-Al 1 km/s", "aluminium_mie_gruneisen.toml", "aluminium_mie_gruneisen.toml", 2000, 4e-3, 4e-3,
           4e-6},
          {"Al-Al 3 km/s", "aluminium_mie_gruneisen.toml", "aluminium_mie_gruneisen.toml", 6000, 4e-3, 4e-3,
           3e-6},
          {"Al-Al 1 km/s, contact at rest", "aluminium_mie_gruneisen.toml", "aluminium_mie_gruneisen.toml",
           2000, 4e-3, 4e-3, 4e-6, 1000},
          {"Al-Al 1 km/s, GRAY", "aluminium.toml", "aluminium.toml", 2000, 4e-3, 4e-3, 4e-6},
          {"Al-Al 3 km/s, GRAY", "aluminium.toml", "aluminium.toml", 6000, 4e-3, 4e-3, 3e-6},
          {"Cu-Al 5.55 km/s", "copper.toml", "aluminium.toml", 5550, 3.45e-3, 2.87e-3, 3e-6},
          {"Pb-Pb 6.58 km/s", lead, lead, 6580, 7e-3, 6.35e-3, 8e-6},
          {"Ta-Ta 4 km/s", "tantalum.toml", "tantalum.toml", 4000, 4e-3, 4e-3, 4e-6}};
}

std::vector<PlanarImpact> melting_impacts() {
  const std::string cadmium = "cases/release_melting/cadmium_spall.toml";
  return {{"Melting of aluminium, 76.5 GPa", "aluminium.toml", "aluminium.toml", 6015.3, 4e-3, 4e-3, 4e-6},
          {"Melting of cadmium, 36.3 GPa", cadmium, cadmium, 2029.48, 4e-3, 4e-3, 6e-6},
          {"Melting of copper, 165.6 GPa", "copper.toml", "copper.toml", 4889.78, 4e-3, 4e-3, 4e-6},
          {"Melting of lead, 31.5 GPa", "lead.toml", "lead.toml", 1688.336, 4e-3, 4e-3, 8e-6}};
}

PlanarImpact planar_impact(const std::string& name) {
  const auto all = planar_impacts();
  const auto found = std::ranges::find(all, name, &PlanarImpact::name);
  if (found == all.end()) throw StateError("no impact '" + name + "'");
  return *found;
}

ShockedAndReleased::ShockedAndReleased(const Material& material, const eos::ShockState& shocked)
    : eos_(material.eos.get()),
      shocked_(shocked),
      initial_energy_(material.reference.specific_internal_energy),
      initial_entropy_(eos_->state(material.reference.density, material.reference.specific_internal_energy)
                           .specific_entropy) {
  double least = 1e-3 * shocked.state.density;
  try {
    released_ = eos::isentrope_at_pressure(*eos_, shocked.state, 0.0).state;
    least = released_.density;
  } catch (const StateError&) {  // it boils before
  }
  std::vector<double> densities;
  constexpr int points = 400;
  for (int i = 1; i <= points; ++i) {
    densities.push_back(shocked.state.density *
                        std::pow(least / shocked.state.density, static_cast<double>(i) / points));
  }
  release_.push_back(shocked.state);
  for (const eos::IsentropeState& point : eos::isentrope(*eos_, shocked.state, densities)) {
    release_.push_back(point.state);
  }
}

double ShockedAndReleased::energy(double density) const {
  const auto next = std::ranges::find_if(release_, [&](const eos::State& s) { return s.density <= density; });
  if (next == release_.begin()) return next->specific_internal_energy - initial_energy_;
  const auto last = next - 1;
  if (next == release_.end()) return last->specific_internal_energy - initial_energy_;
  const double share = (last->density - density) / (last->density - next->density);
  return (1 - share) * last->specific_internal_energy + share * next->specific_internal_energy -
         initial_energy_;
}

double ShockedAndReleased::entropy_share(double density, double specific_internal_energy) const {
  const double entropy = eos_->state(density, specific_internal_energy).specific_entropy;
  return (entropy - initial_entropy_) / (shocked_.state.specific_entropy - initial_entropy_);
}

Result run(const PlanarImpact& impact, double cell) {
  const double width = 2 * cell;
  // Layers are known by the numbers of their particles: none is split.
  std::string text = fmt::format(R"(
[splitting]
length = 0
[domain]
lower = [0, 0, -0.04]
upper = [{0:.9g}, {0:.9g}, 0.1]
cell_size = {1:.9g}
boundary = {{ x_lower = "symmetry", y_lower = "symmetry", x_upper = "symmetry", y_upper = "symmetry" }}
)",
                                 width, cell);
  const std::array<double, 2> length{impact.flyer_length, impact.target_length};
  for (const bool target : {false, true}) {
    text += fmt::format(R"(
[[body]]
name = "{}"
material = "{}"
velocity = [0, 0, {}]
shape = {{ box = {{ lower = [0, 0, {:.9g}], upper = [{:.9g}, {:.9g}, {:.9g}] }} }}
discretization = {{ lattice = "{}" }}
)",
                        target ? "target" : "flyer", hydrodynamic(target ? impact.target : impact.flyer),
                        (target ? 0.0 : impact.speed) - impact.frame, target ? 0.0 : -impact.flyer_length,
                        width, width, target ? impact.target_length : 0.0, impact.lattice);
  }
  solver::Simulation simulation(default_case(impact.end, text), parallel::world());
  const auto start = positions_by_id(simulation.particles());

  const auto& materials = simulation.setup().materials;
  const eos::Hugoniot of_flyer(*materials[0]->eos), of_target(*materials[1]->eos);
  const double interface = eos::match_impact(of_flyer, of_target, impact.speed).velocity;
  const std::array<ShockedAndReleased, 2> exact{
      ShockedAndReleased(*materials[0], of_flyer.at_particle_velocity(impact.speed - interface)),
      ShockedAndReleased(*materials[1], of_target.at_particle_velocity(interface))};

  std::array<BodyFigures, 2> bodies;
  const auto depth_of = [&](const Particles& q, std::size_t p) { return std::abs(start[q.id[p]][2]); };
  const auto inside = [&](std::size_t b, double depth) {
    return depth > 4 * cell && depth < length[b] - 3 * cell;
  };
  // Between three cells from the contact and six behind the front, while the front is between 80 and 95 % of
  // the body's length from the contact; not of fewer than two cells, which hold the noise of single layers.
  const auto watch_shock = [&](const solver::Simulation& now) {
    const Particles& q = now.particles();
    for (std::size_t p = 0; p < q.size(); ++p) {
      const auto b = q.body[p];
      const double front = exact[b].shocked().shock_velocity * now.state().time;
      if (front < 0.8 * length[b] || front > 0.95 * length[b] || front < 11 * cell) continue;
      if (depth_of(q, p) < 3 * cell || depth_of(q, p) > front - 6 * cell) continue;
      bodies[b].shock_pressure.add(q.pressure[p] / exact[b].shocked().state.pressure, q.mass[p]);
      bodies[b].shock_energy.add((q.specific_internal_energy[p] - exact[b].initial_energy()) /
                                     exact[b].energy(exact[b].shocked().state.density),
                                 q.mass[p]);
      bodies[b].shock_density.add(q.mass[p] / q.volume[p] / exact[b].shocked().state.density, q.mass[p]);
    }
  };
  // When the pressure of a particle falls for the first time: what shock and release alone have heated it.
  enum class Past : std::uint8_t { before, shocked, released };
  std::vector<Past> past(start.size(), Past::before);
  const auto watch_release = [&](const solver::Simulation& now) {
    const Particles& q = now.particles();
    for (std::size_t p = 0; p < q.size(); ++p) {
      const auto b = q.body[p];
      const double share = q.pressure[p] / exact[b].shocked().state.pressure;
      Past& was = past[q.id[p]];
      if (was == Past::before && share > 0.5) was = Past::shocked;
      if (was != Past::shocked || share > 0.02) continue;
      was = Past::released;
      const double ratio = (q.specific_internal_energy[p] - exact[b].initial_energy()) /
                           exact[b].energy(q.mass[p] / q.volume[p]);
      bodies[b].first_release.add(ratio, q.mass[p]);
      if (inside(b, depth_of(q, p))) bodies[b].plateau_first_release.add(ratio, q.mass[p]);
    }
  };
  EnergyWatch energy_watch;
  run_to(simulation, impact.end, [&](const solver::Simulation& now) {
    watch_shock(now);
    watch_release(now);
    energy_watch(now);
  });

  const Particles& q = simulation.particles();
  std::array<Layers, 2> energy{Layers(cell, 10), Layers(cell, 10)}, entropy = energy;
  std::array<Layers, 2> rear{Layers(0.5 * cell, 6), Layers(0.5 * cell, 6)};
  for (std::size_t p = 0; p < q.size(); ++p) {
    const auto b = q.body[p];
    const double depth = depth_of(q, p), density = q.mass[p] / q.volume[p], mass = q.mass[p];
    const double e = q.specific_internal_energy[p] - exact[b].initial_energy();
    const double should_be = exact[b].energy(density), ratio = e / should_be;
    BodyFigures& f = bodies[b];
    f.energy.add(e, mass);
    f.exact_energy.add(should_be, mass);
    if (depth < 0.5 * cell) f.half_cell.add(ratio, mass);
    if (depth < cell) f.first_cell.add(ratio, mass);
    if (inside(b, depth)) f.plateau.add(ratio, mass);
    const double s = exact[b].entropy_share(density, q.specific_internal_energy[p]);
    if (inside(b, depth)) f.entropy.add(s, mass);
    energy[b].add(depth, ratio, mass);
    entropy[b].add(depth, s, mass);
    rear[b].add(length[b] - depth, ratio, mass);
    f.hottest = std::max(f.hottest, q.temperature[p]);
    f.largest_pressure = std::max(f.largest_pressure, q.maximum_pressure[p]);
    f.mass += mass;
    f.melted.add(q.melted_fraction[p], mass);
    f.not_solid += q.melted_fraction[p] > 0 ? mass : 0.0;
  }
  Result result{fmt::format("{:g} mm", 1e3 * cell), cell, {}, {}};
  for (const std::size_t b : {0, 1}) {
    const BodyFigures& f = bodies[b];
    const std::string of = b == 0 ? "flyer: " : "target: ";
    const eos::State& released = exact[b].released();
    const double cells = length[b] / cell, share = f.energy.value() / f.exact_energy.value();
    result.add(of + "released e", 1, share);
    result.add(of + "excess of e, cells", 0, (share - 1) * cells);
    result.add(of + "e, first half cell", 1, f.half_cell.value());
    result.add(of + "e, first cell", 1, f.first_cell.value());
    result.add(of + "e, plateau", 1, f.plateau.value());
    result.add(of + "entropy, plateau", 1, f.entropy.value());
    result.add(of + "e, first release", 1, f.first_release.value());
    result.add(of + "e, plateau, first release", 1, f.plateau_first_release.value());
    result.add(of + "T max, K", released.temperature, f.hottest);
    if (!released.phase.empty()) {
      result.add(of + "fraction not solid", released.melted_fraction > 0 ? 1.0 : 0.0, f.not_solid / f.mass);
      result.add(of + "melted fraction", released.melted_fraction, f.melted.value());
    }
    result.add(of + "p behind the shock", 1, f.shock_pressure.value());
    result.add(of + "rho behind the shock", 1, f.shock_density.value());
    result.add(of + "e behind the shock", 1, f.shock_energy.value());
    result.add(of + "largest p", 1, f.largest_pressure / exact[b].shocked().state.pressure);
    result.add(of + "e, cells 1 to 10 from the contact", energy[b].values());
    result.add(of + "entropy, cells 1 to 10 from the contact", entropy[b].values());
    result.add(of + "e, half cells 1 to 6 from the free surface", rear[b].values());
  }
  double released_energy = 0;  // J, exact
  for (const BodyFigures& f : bodies) released_energy += f.mass * f.exact_energy.value();
  result.add("transfer dissipation over exact released e", std::nan(""),
             simulation.state().ledger.transfer_heat / released_energy);
  result.add("largest energy error", 0, energy_watch.worst);
  return result;
}

}  // namespace whipple::verification::exact

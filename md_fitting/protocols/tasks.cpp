// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/tasks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "md_fitting/data_set/hash.hpp"
#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/coexistence.hpp"
#include "md_fitting/protocols/hugoniot.hpp"
#include "md_fitting/protocols/lattice.hpp"
#include "md_fitting/protocols/nvt_state.hpp"
#include "md_fitting/protocols/zero_pressure.hpp"
#include "src/base/error.hpp"

namespace whipple::md {
namespace {

/// Raised when a protocol changes what it computes: points of an older revision are then computed again.
const std::map<std::string, int> revisions = {{"lattice", 1},  {"zero_pressure_volume", 1},
                                              {"isotherm", 1}, {"isochore", 1},
                                              {"hugoniot", 1}, {"coexistence", 1}};

using Settings = std::map<std::string, std::string>;

Settings size_settings(const RunSize& size) {
  return {{"cells", std::to_string(size.cells)},
          {"equilibration_steps", std::to_string(size.equilibration_steps)},
          {"steps", std::to_string(size.steps)},
          {"time_step", size.time_step > 0.0 ? fmt::format("{} s", size.time_step) : "automatic"}};
}

/// Provenance that all points of a plan share.
Settings common_settings(const Plan& plan, const Potential& potential) {
  return {{"element", potential.element()},
          {"molar_mass", fmt::format("{}", 1e-3 * potential.mass())},
          {"potential", potential.name()},
          {"potential_file", potential.file().filename().string()},
          {"potential_sha256", potential.hash()},
          {"potential_source", potential.source()},
          {"structure", potential.tables().structure},
          {"static_specific_volume", fmt::format("{}", potential.static_volume())},
          {"density_table_end", fmt::format("{}", potential.table_end())},
          {"lammps_version", std::to_string(lammps_release())},
          {"ranks", "1"},
          {"plan_seed", std::to_string(plan.seed)}};
}

Task make_task(const std::string& protocol, std::map<std::string, double> conditions, const Settings& common,
               const Settings& sizes, const std::string& dependency = {}) {
  Task task;
  task.protocol = protocol;
  task.conditions = std::move(conditions);
  task.dependency = dependency;
  task.provenance = common;
  task.provenance.insert(sizes.begin(), sizes.end());
  task.provenance["revision"] = std::to_string(revisions.at(protocol));
  // Names and places change no number; everything else does.
  static const std::set<std::string> without_effect = {"potential", "potential_file", "potential_source",
                                                       "static_specific_volume", "density_table_end"};
  std::string identity = "protocol=" + protocol + "\ndependency=" + dependency + "\n";
  for (const auto& [name, value] : task.conditions) identity += fmt::format("condition {}={}\n", name, value);
  for (const auto& [name, text] : task.provenance) {
    if (!without_effect.contains(name)) identity += fmt::format("{}={}\n", name, text);
  }
  task.key = sha256(identity);
  task.provenance["seed"] = std::to_string(seed_from(task.key));
  return task;
}

std::string melting_remark(bool solid) { return solid ? "" : "the crystal melted"; }

TaskResult compute_state(const Potential& potential, const RunSize& size, std::int64_t seed, double volume,
                         double temperature) {
  NvtStateSource source(potential, size, seed);
  const State state = source.state(volume, temperature, StateSource::Effort::final);
  return {{{"pressure", state.pressure},
           {"specific_internal_energy", state.specific_internal_energy},
           {"error_correlation", {state.correlation, 0.0}},
           {"mean_square_displacement", state.mean_square_displacement},
           {"solid", {state.solid ? 1.0 : 0.0, 0.0}}},
          melting_remark(state.solid),
          source.transcript()};
}

/// Temperature behind the shock from the static crystal's energy curve and a harmonic solid with Grueneisen
/// coefficient 2 V/V0 (equation 10): good to about a tenth, enough to begin with.
double first_hugoniot_temperature(const Potential& potential, const ReferenceState& reference,
                                  double volume) {
  const double mass = potential.mass();
  const int atoms = potential.tables().atoms_per_cell();
  const auto cold_energy = [&](double v) {
    return metal::specific_energy(
        potential.tables().crystal_energy(std::cbrt(metal::volume_per_atom(v, mass) * atoms)), mass);
  };
  const double dv = 1e-3 * volume;
  const double cold_pressure = -(cold_energy(volume + dv) - cold_energy(volume - dv)) / (2 * dv);
  const double heat = 3.0 * metal::specific_energy(metal::boltzmann, mass);
  const double half = 0.5 * (reference.specific_volume.value - volume);
  const double gruneisen = 2.0 * volume / reference.specific_volume.value;
  const double t = (half * cold_pressure - cold_energy(volume) + reference.specific_internal_energy.value) /
                   (heat * (1.0 - gruneisen * half / volume));
  return std::fmax(t, 100.0);
}

TaskResult compute_hugoniot(const Potential& potential, const RunSize& size, std::int64_t seed, double volume,
                            const PointRecord& zero_pressure) {
  const ReferenceState reference{zero_pressure.result("specific_volume"),
                                 zero_pressure.result("specific_internal_energy"),
                                 zero_pressure.condition("pressure")};
  NvtStateSource source(potential, size, seed);
  HugoniotSearch search;
  search.specific_heat = 3.0 * metal::specific_energy(metal::boltzmann, potential.mass());
  search.gruneisen = 2.0 * volume / reference.specific_volume.value;
  search.first_temperature = first_hugoniot_temperature(potential, reference, volume);
  const HugoniotState state = solve_hugoniot(source, reference, volume, search);
  return {{{"pressure", state.pressure},
           {"temperature", state.temperature},
           {"specific_internal_energy", state.specific_internal_energy},
           {"shock_velocity", state.shock_velocity},
           {"particle_velocity", state.particle_velocity},
           {"mean_square_displacement", state.mean_square_displacement},
           {"solid", {state.solid ? 1.0 : 0.0, 0.0}}},
          melting_remark(state.solid),
          source.transcript()};
}

}  // namespace

std::vector<Task> make_tasks(const Plan& plan, const Potential& potential) {
  std::string faults;
  const auto require = [&](const std::string& section, double ratio) {
    try {
      potential.require_range(ratio);
    } catch (const InputError& error) {
      faults += fmt::format("{}{}: {}", faults.empty() ? "" : "\n", section, error.what());
    }
  };
  const Settings common = common_settings(plan, potential);
  const double static_volume = potential.static_volume();
  std::vector<Task> tasks;
  const auto add = [&](Task task, auto&& compute) {
    const std::int64_t seed = seed_from(task.key);
    task.compute = [seed, compute](const PointRecord* dependency) { return compute(seed, dependency); };
    // The same point twice in a plan is one point.
    for (const Task& other : tasks) {
      if (other.key == task.key) return;
    }
    tasks.push_back(std::move(task));
  };

  std::string reference_key;
  if (plan.zero_pressure) {
    const RunSize size = plan.zero_pressure->size;
    for (const double temperature : plan.zero_pressure->temperature) {
      Task task = make_task("zero_pressure_volume", {{"temperature", temperature}, {"pressure", 0.0}}, common,
                            size_settings(size));
      if (reference_key.empty()) reference_key = task.key;
      add(std::move(task), [&potential, size, temperature](std::int64_t seed, const PointRecord*) {
        const ZeroPressureResult result = measure_zero_pressure(potential, temperature, size, seed);
        return TaskResult{{{"specific_volume", result.specific_volume},
                           {"specific_internal_energy", result.specific_internal_energy}},
                          "",
                          result.transcript};
      });
    }
  }
  add(make_task("lattice", {}, common, {}), [&potential](std::int64_t, const PointRecord*) {
    const LatticeResult result = measure_lattice(potential);
    return TaskResult{{{"lattice_constant", result.lattice_constant},
                       {"cohesive_energy", result.cohesive_energy},
                       {"specific_volume", result.specific_volume}},
                      "",
                      result.transcript};
  });
  if (plan.coexistence) {
    const CoexistencePlan& melting = *plan.coexistence;
    const RunSize size = melting.size;
    for (std::size_t i = 0; i < melting.pressure.size(); ++i) {
      const double pressure = melting.pressure[i];
      const double guess = melting.first_guess[i];
      const std::int64_t attempts = melting.attempts;
      Settings sizes = size_settings(size);
      sizes["first_guess"] = fmt::format("{}", guess);
      sizes["attempts"] = std::to_string(attempts);
      add(make_task("coexistence", {{"pressure", pressure}}, common, sizes),
          [&potential, size, pressure, guess, attempts](std::int64_t seed, const PointRecord*) {
            const CoexistenceResult result =
                measure_coexistence(potential, pressure, guess, attempts, size, seed);
            return TaskResult{{{"melting_temperature", result.melting_temperature},
                               {"solid_share", result.solid_share},
                               {"solid_specific_volume", result.solid_specific_volume},
                               {"liquid_specific_volume", result.liquid_specific_volume},
                               {"latent_heat", result.latent_heat}},
                              fmt::format("accepted at attempt {}", result.attempts),
                              result.transcript};
          });
    }
  }
  const auto add_state = [&](const std::string& protocol, double ratio, double temperature,
                             const RunSize& size) {
    require(protocol, ratio);
    const double volume = ratio * static_volume;
    add(make_task(protocol, {{"specific_volume", volume}, {"temperature", temperature}}, common,
                  size_settings(size)),
        [&potential, size, volume, temperature](std::int64_t seed, const PointRecord*) {
          return compute_state(potential, size, seed, volume, temperature);
        });
  };
  for (const IsothermPlan& isotherm : plan.isotherms) {
    for (const double ratio : isotherm.volume_ratio) {
      add_state("isotherm", ratio, isotherm.temperature, isotherm.size);
    }
  }
  for (const IsochorePlan& isochore : plan.isochores) {
    for (const double temperature : isochore.temperature) {
      add_state("isochore", isochore.volume_ratio, temperature, isochore.size);
    }
  }
  if (plan.hugoniot) {
    const RunSize size = plan.hugoniot->size;
    for (const double ratio : plan.hugoniot->volume_ratio) {
      require("hugoniot", ratio);
      const double volume = ratio * static_volume;
      add(make_task("hugoniot", {{"specific_volume", volume}}, common, size_settings(size), reference_key),
          [&potential, size, volume](std::int64_t seed, const PointRecord* reference) {
            return compute_hugoniot(potential, size, seed, volume, *reference);
          });
    }
  }
  if (!faults.empty()) throw InputError(faults);
  return tasks;
}

}  // namespace whipple::md

// SPDX-License-Identifier: BSD-3-Clause
#include "eos/curves/queries.hpp"

#include <fmt/format.h>

#include "eos/inversions.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos::curves {

State state_of(const EquationOfState& eos, const StateQuery& q) {
  const int given = q.density.has_value() + q.temperature.has_value() + q.energy.has_value() +
                    q.pressure.has_value() + q.entropy.has_value();
  if (given == 0) return eos.state(eos.reference_density(), eos.reference_energy());
  if (given == 2 && q.density && q.temperature) return eos.state_at_temperature(*q.density, *q.temperature);
  if (given == 2 && q.density && q.energy) {
    const State state = eos.state(*q.density, *q.energy);  // of the coldest state, if the energy is lower
    if (const double least = eos.minimum_energy(*q.density); *q.energy < least) {
      throw StateError(fmt::format(
          "{}: no state with {:.6g} J/kg at {:.6g} kg/m^3: the coldest one, of {} K, has {:.6g} J/kg",
          eos.model(), *q.energy, *q.density, eos.least_temperature(), least));
    }
    return state;
  }
  if (given == 2 && q.density && q.pressure) return state_at_pressure(eos, *q.density, *q.pressure);
  if (given == 2 && q.density && q.entropy) return state_at_entropy(eos, *q.density, *q.entropy);
  if (given == 2 && q.pressure && q.temperature) {
    return state_at_pressure_and_temperature(eos, *q.pressure, *q.temperature);
  }
  throw InputError(
      "a state is named by two quantities: density with temperature, energy, pressure or entropy, or "
      "pressure with "
      "temperature");
}

Hugoniot hugoniot_of(const EquationOfState& eos, const HugoniotStart& start) {
  const double reference = eos.reference_density();
  if (start.initial_density && *start.initial_density > reference) {
    throw InputError(
        fmt::format("the initial density of {:.6g} kg/m^3 is above the reference density of {:.6g} kg/m^3",
                    *start.initial_density, reference));
  }
  const Hugoniot hugoniot = start.initial_density && *start.initial_density < reference
                                ? Hugoniot::porous(eos, *start.initial_density)
                                : Hugoniot(eos);
  if (!start.reflected_pressure) return hugoniot;
  const State shocked = hugoniot.at_pressure(*start.reflected_pressure).state;
  return {eos, shocked.density, shocked.specific_internal_energy};
}

std::optional<ShockState> shock_of(const Hugoniot& hugoniot, const ShockQuery& q) {
  const int given = q.density.has_value() + q.pressure.has_value() + q.particle_velocity.has_value();
  if (given == 0) return std::nullopt;
  if (given > 1) throw InputError("a shock is named by one of pressure, particle velocity and density");
  if (q.density) return hugoniot.at_density(*q.density);
  return q.pressure ? hugoniot.at_pressure(*q.pressure) : hugoniot.at_particle_velocity(*q.particle_velocity);
}

ShockState required_shock(const EquationOfState& eos, const HugoniotStart& start, const ShockQuery& query) {
  if (const auto shock = shock_of(hugoniot_of(eos, start), query)) return *shock;
  throw InputError("a shock is named by one of pressure, particle velocity and density");
}

std::vector<ImpedanceMatch> interfaces(const Subjects& subjects, double velocity) {
  if (subjects.size() < 2) {
    throw InputError(
        "an impact has two materials at least: the impactor, the target, and what lies behind it");
  }
  if (!(velocity > 0.0)) throw InputError("an impact needs a velocity above zero");
  std::vector<ImpedanceMatch> matches = {
      match_impact(Hugoniot(*subjects[0].eos), Hugoniot(*subjects[1].eos), velocity)};
  for (std::size_t i = 2; i < subjects.size(); ++i) {
    const ImpedanceMatch& last = matches.back();
    matches.push_back(match_shock(*subjects[i - 1].eos,
                                  {last.right, last.right_shock_velocity, last.velocity},
                                  Hugoniot(*subjects[i].eos)));
  }
  return matches;
}

}  // namespace whipple::eos::curves

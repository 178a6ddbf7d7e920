// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/eos_remarks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "src/core/base/error.hpp"

namespace whipple::app {
namespace {

using eos::EquationOfState;
using eos::State;
using eos::curves::Subject;
using eos::curves::Subjects;

constexpr double GPa = 1e9;  // Pa

}  // namespace

Remarks state_remarks(const EosOptions& o, const Subjects& subjects) {
  Remarks remarks;
  for (const Subject& subject : subjects) {
    const State s = eos::curves::state_of(*subject.eos, state_query(o));
    if (s.phase.find("vapour") == std::string_view::npos || !(s.vaporised_fraction < 0.5)) continue;
    remarks.push_back(fmt::format(
        "{}: \"{}\" names the surface of the model, which continues beyond the limit of stretched material. "
        "Material "
        "of this density and energy in equilibrium is condensed, with voids: {:.2g} % of its mass is vapour",
        subject.name, s.phase, 100 * s.vaporised_fraction));
  }
  return remarks;
}

Remarks hugoniot_remarks(const EosOptions& o, const Subjects& subjects) {
  const eos::curves::HugoniotStart start = hugoniot_start(o);
  Remarks remarks;
  for (const Subject& subject : subjects) {
    const EquationOfState& eos = *subject.eos;
    if (start.reflected_pressure) {
      const eos::ShockState shocked =
          eos::curves::hugoniot_of(eos, {start.initial_density, {}}).at_pressure(*start.reflected_pressure);
      const eos::ShockState second = eos::reflected_at_wall(eos, shocked);
      remarks.push_back(
          fmt::format("{}: off a rigid wall {:.2f} GPa, {:.0f} K, {:.1f} kg/m^3; back against the "
                      "shocked material at {:.4g} km/s",
                      subject.name, second.state.pressure / GPa, second.state.temperature,
                      second.state.density, second.shock_velocity * 1e-3));
    } else if (!start.initial_density) {
      if (const auto melting = eos::shock_melting(eos)) {
        remarks.push_back(
            fmt::format("{}: shock melting: onset {:.2f} GPa, {:.0f} K; completion {:.2f} GPa, {:.0f} K",
                        subject.name, melting->onset.state.pressure / GPa, melting->onset.state.temperature,
                        melting->completion.state.pressure / GPa, melting->completion.state.temperature));
      }
    }
  }
  return remarks;
}

Remarks release_remarks(const EosOptions& o, const Subjects& subjects) {
  const double pressure = quantity("--to", o.to, "Pa").value_or(0.0);
  Remarks remarks;
  for (const Subject& subject : subjects) {
    const eos::ShockState shock =
        eos::curves::required_shock(*subject.eos, hugoniot_start(o), shock_query(o));
    std::string text = fmt::format("{}: shock up {:.4g} km/s, Us {:.4g} km/s", subject.name,
                                   shock.particle_velocity * 1e-3, shock.shock_velocity * 1e-3);
    const eos::Release release = eos::release(*subject.eos, shock.state, pressure);
    if (!release.in_equilibrium) {
      text += fmt::format("; velocity of the released surface {:.5g} km/s",
                          (shock.particle_velocity - release.end.riemann_velocity) * 1e-3);
    }
    remarks.push_back(text);
  }
  return remarks;
}

Remarks cold_remarks(const EosOptions& /*options*/, const Subjects& subjects) {
  Remarks remarks;
  for (const Subject& subject : subjects) {
    const eos::ColdCurve cold = eos::cold_curve(*subject.eos);
    std::string text = fmt::format("{}: at rest {:.5g} kg/m^3", subject.name, cold.at_rest.density);
    if (!cold.tension_limit.phase.empty()) {
      text += fmt::format("; limit in tension {:.4g} GPa at {:.5g} kg/m^3", cold.tension_limit.pressure / GPa,
                          cold.tension_limit.density);
    }
    text += fmt::format("; compression limit {:.5g} kg/m^3, {:.4g} GPa", cold.compression_limit.density,
                        cold.compression_limit.pressure / GPa);
    if (std::isfinite(cold.cohesive_energy)) {
      text += fmt::format("; cohesive energy {:.4g} MJ/kg", cold.cohesive_energy * 1e-6);
    }
    remarks.push_back(text);
  }
  return remarks;
}

Remarks melt_remarks(const EosOptions& /*options*/, const Subjects& subjects) {
  Remarks remarks;
  const auto threshold = [](const char* what, const std::optional<eos::ShockState>& shock) {
    return shock ? fmt::format("{} {:.1f} GPa ({:.3g} km/s)", what, shock->state.pressure / GPa,
                               shock->particle_velocity * 1e-3)
                 : std::string();
  };
  for (const Subject& subject : subjects) {
    const eos::ReleaseThresholds release = eos::release_thresholds(*subject.eos, 1e5);
    std::string text;
    for (const std::string& part : {threshold("melting begins", release.incipient_melting),
                                    threshold("is complete", release.complete_melting),
                                    threshold("vaporisation begins", release.incipient_vaporisation),
                                    threshold("is complete", release.complete_vaporisation)}) {
      if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
    }
    if (!text.empty()) remarks.push_back(fmt::format("{}: after release to 1 bar: {}", subject.name, text));
  }
  return remarks;
}

Remarks dome_remarks(const EosOptions& /*options*/, const Subjects& subjects) {
  Remarks remarks;
  for (const Subject& subject : subjects) {
    const eos::CriticalPoint& critical = subject.eos->vapour_dome()->critical_point();
    remarks.push_back(fmt::format("{}: critical point {:.5g} K, {:.4g} GPa, {:.4g} g/cm^3", subject.name,
                                  critical.temperature, critical.pressure / GPa,
                                  1e-3 / critical.specific_volume));
  }
  return remarks;
}

Remarks match_remarks(const EosOptions& o, const Subjects& subjects) {
  const eos::ImpedanceMatch last = eos::curves::interfaces(subjects, impact_velocity(o)).back();
  const EquationOfState& eos = *subjects.back().eos;
  try {
    return {fmt::format(
        "free surface of {}: {:.5g} km/s", subjects.back().name,
        1e-3 * eos::free_surface_velocity(eos, {last.right, last.right_shock_velocity, last.velocity}))};
  } catch (const StateError& error) {
    return {fmt::format("free surface of {}: {}", subjects.back().name, error.what())};
  }
}

Remarks drawn_remarks(const MaterialSamples& drawn) {
  Remarks remarks = {fmt::format("drawn: {}", fmt::join(drawn.names, ", "))};
  if (!drawn.unknown.empty()) {
    remarks.push_back(fmt::format("defaults of which no error is known, the same in all samples: {}",
                                  fmt::join(drawn.unknown, ", ")));
  }
  return remarks;
}

Remarks sample_remarks(const eos::curves::SampledHugoniot& sampled, std::size_t samples) {
  Remarks remarks;
  for (const auto& [text, pressure] : sampled.thresholds) {
    if (pressure.count() == 0) continue;
    remarks.push_back(fmt::format("{} {:.1f} +- {:.1f} GPa ({} of {} samples)", text, pressure.mean() / GPa,
                                  pressure.deviation() / GPa, pressure.count(), samples));
  }
  return remarks;
}

}  // namespace whipple::app

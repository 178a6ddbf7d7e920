// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/eos_audit.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "eos/detonation.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/text_table.hpp"

namespace whipple::app {
namespace {

using eos::Audit;
using Lines = std::vector<std::vector<std::string>>;

/// Formats a quantity as "name 1.234 unit,"; empty if the model does not provide it.
std::string written(const char* name, double value, double size, const char* unit) {
  if (std::isnan(value)) return {};
  return fmt::format(" {} {:.5g}{}{},", name, value / size, *unit == '\0' ? "" : " ", unit);
}

std::string without_last_comma(std::string text) {
  if (text.ends_with(',')) text.pop_back();
  return text;
}

std::string reference_text(const eos::State& s) {
  return without_last_comma(
      fmt::format("{:.6g} kg/m^3, {:.4g} K:", s.density, s.temperature) +
      written("c", s.sound_speed, 1e3, "km/s") + written("K_S", s.isentropic_bulk_modulus, 1e9, "GPa") +
      written("K_T", s.isothermal_bulk_modulus, 1e9, "GPa") + written("C_v", s.heat_capacity, 1, "J/(kg K)") +
      written("Gamma", s.gruneisen, 1, "") +
      written("volume expansion", s.thermal_expansion, 1e-6, "1e-6/K"));
}

std::string cold_text(const eos::ColdCurve& cold) {
  std::string text = fmt::format("at rest {:.5g} kg/m^3", cold.at_rest.density);
  if (!cold.tension_limit.phase.empty()) {
    text += fmt::format("; tension to {:.4g} GPa at {:.5g} kg/m^3", cold.tension_limit.pressure * 1e-9,
                        cold.tension_limit.density);
  } else {
    text += "; no limit in tension";
  }
  text += fmt::format("; compression to {:.5g} kg/m^3, {:.4g} GPa", cold.compression_limit.density,
                      cold.compression_limit.pressure * 1e-9);
  if (std::isfinite(cold.cohesive_energy)) {
    text += fmt::format("; cohesive energy {:.4g} MJ/kg", cold.cohesive_energy * 1e-6);
  }
  return text;
}

void add_identities(Lines& lines, const Audit& audit) {
  lines.push_back(
      {"phase", "states", "P", "c^2", "C_v", "Gamma", "K_T", "S(E)", "S(V)", "E(T(E))", "verdict"});
  for (const eos::PhaseIdentities& phase : audit.identities) {
    const eos::IdentityDefects& d = phase.largest;
    std::vector<std::string> line = {phase.phase, fmt::format("{}", phase.states)};
    for (const double defect : {d.pressure, d.sound_speed, d.heat_capacity, d.gruneisen, d.bulk_modulus,
                                d.entropy_energy, d.entropy_volume, d.round_trip}) {
      line.push_back(std::isnan(defect) ? "-" : fmt::format("{:.1e}", defect));
    }
    line.push_back(phase.verdict == eos::Verdict::sound ? "sound" : "reservations");
    lines.push_back(line);
  }
}

}  // namespace

void print_audit(const Material& material, eos::AuditDepth depth) {
  const Audit audit = eos::audit(*material.eos, depth);
  fmt::print("Audit: {} ({})\n", material.name, audit.model);
  Lines lines = {{"reference", reference_text(audit.reference)}};
  if (audit.cold) lines.push_back({"cold curve", cold_text(*audit.cold)});
  if (audit.melting) {
    std::string text = fmt::format("{:.5g} ... {:.5g} K at zero pressure", audit.melting->solidus.temperature,
                                   audit.melting->liquidus.temperature);
    if (audit.shock_melting) {
      text +=
          fmt::format("; by shock {:.4g} ... {:.4g} GPa", audit.shock_melting->onset.state.pressure * 1e-9,
                      audit.shock_melting->completion.state.pressure * 1e-9);
    }
    lines.push_back({"melting", text});
  }
  if (audit.critical) {
    std::string text =
        fmt::format("critical point {:.5g} K, {:.4g} GPa, {:.4g} kg/m^3", audit.critical->temperature,
                    audit.critical->pressure * 1e-9, 1 / audit.critical->specific_volume);
    if (audit.boiling) {
      text += fmt::format("; boils at {:.5g} K (1 atm), latent heat {:.4g} MJ/kg", audit.boiling->temperature,
                          audit.boiling->latent_heat() * 1e-6);
    }
    lines.push_back({"vapour", text});
  }
  if (material.eos->detonates()) {
    const eos::ChapmanJouguet wave = eos::chapman_jouguet(*material.eos);
    lines.push_back(
        {"detonation",
         fmt::format("Chapman-Jouguet: {:.4g} km/s, {:.4g} GPa, {:.5g} kg/m^3, particles {:.4g} km/s",
                     wave.detonation_velocity * 1e-3, wave.state.pressure * 1e-9, wave.state.density,
                     wave.particle_velocity * 1e-3)});
  }
  const bool usable = audit.verdict() != eos::Verdict::not_usable;
  if (usable) lines.push_back({"valid", audit.range_text()});
  if (!audit.range.end_of_shocks.empty()) lines.push_back({"shocks end", audit.range.end_of_shocks});
  fmt::print("{}", text_table(lines, "l"));
  if (!audit.identities.empty()) {
    Lines identities;
    add_identities(identities, audit);
    fmt::print("\nidentities, largest relative defects by finite differences\n{}",
               text_table(identities, "lr"));
  }
  for (const eos::Finding& finding : audit.findings) fmt::print("- {}\n", finding.text);
  if (!usable) throw InputError(fmt::format("{}: {}", material.name, audit.summary()));
  fmt::print("\nverdict: {}\n", audit.verdict() == eos::Verdict::sound ? "sound" : "sound with reservations");
}

}  // namespace whipple::app

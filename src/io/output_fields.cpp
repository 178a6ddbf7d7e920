// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/output_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "src/core/base/error.hpp"
#include "src/core/base/text.hpp"
#include "src/material/constitutive_catalogue.hpp"
#include "src/material/failure/catalogue.hpp"

namespace whipple::io {
namespace {

using Source = FieldSource;

SymmetricTensor stress(const Source& s, std::size_t i) {
  SymmetricTensor sigma = s.particles.deviatoric_stress[i];
  sigma.xx -= s.particles.pressure[i];
  sigma.yy -= s.particles.pressure[i];
  sigma.zz -= s.particles.pressure[i];
  return sigma;
}

double von_mises_stress(const Source& s, std::size_t i) {
  const SymmetricTensor& t = s.particles.deviatoric_stress[i];
  const double mean = (t.xx + t.yy + t.zz) / 3.0;  // not 0 where p (I - S) is kept with s
  return std::sqrt(1.5 * std::max(t.squared_norm() - 3.0 * mean * mean, 0.0));
}

double cell_size(const Source& s, std::size_t i) {
  if (s.geometry == nullptr) return 0.0;
  return s.particles.position.empty() ? s.geometry->cell_size
                                      : s.geometry->cell_size_at(s.particles.position[i]);
}

double void_fraction(const Source& s, std::size_t i) {
  const double opened = s.particles.void_volume[i];
  return opened / (s.particles.volume[i] + opened);
}

// clang-format off
const auto table_of_state = std::to_array<OutputField>({
    {"velocity", "m/s", "velocity", true,
     [](const Source& s, std::size_t i) { return s.particles.velocity[i]; }},
    {"mass", "kg", "mass of the particle", true,
     [](const Source& s, std::size_t i) { return s.particles.mass[i]; }},
    {"pressure", "Pa", "pressure, positive in compression, without artificial viscosity", false,
     [](const Source& s, std::size_t i) { return s.particles.pressure[i]; }},
    {"temperature", "K", "temperature", false,
     [](const Source& s, std::size_t i) { return s.particles.temperature[i]; }},
    {"density", "kg/m^3", "density of the material without voids", true,
     [](const Source& s, std::size_t i) { return s.particles.mass[i] / s.particles.volume[i]; }},
    {"internal_energy", "J/kg", "specific internal energy", false,
     [](const Source& s, std::size_t i) { return s.particles.specific_internal_energy[i]; }},
    {"unresolved_energy", "J/kg", "kinetic energy of motion that the cells do not resolve, no heat yet", false,
     [](const Source& s, std::size_t i) {
       return s.particles.unresolved_energy.empty() ? 0.0 : s.particles.unresolved_energy[i];
     }},
    {"phase", "", "0 solid, 1 melting, 2 liquid, 3 vapour (at least half of the mass)", false,
     [](const Source& s, std::size_t i) {
       return static_cast<std::uint8_t>(phase(s.particles.melted_fraction[i], s.particles.vaporised_fraction[i]));
     }},
    {"melted_fraction", "1", "mass fraction of liquid and vapour", false,
     [](const Source& s, std::size_t i) { return s.particles.melted_fraction[i]; }},
    {"vaporised_fraction", "1", "mass fraction of vapour", false,
     [](const Source& s, std::size_t i) { return s.particles.vaporised_fraction[i]; }},
    {"plastic_strain", "1", "equivalent plastic strain", false,
     [](const Source& s, std::size_t i) { return s.particles.plastic_strain[i]; }},
    {"failed", "", failure::code_meanings(), true,
     [](const Source& s, std::size_t i) { return s.particles.failed[i]; }},
    {"maximum_pressure", "Pa", "maximum pressure so far", false,
     [](const Source& s, std::size_t i) { return s.particles.maximum_pressure[i]; }},
    {"maximum_temperature", "K", "maximum temperature so far", false,
     [](const Source& s, std::size_t i) { return s.particles.maximum_temperature[i]; }},
    {"melting_time", "s", "when half of the mass was first melted; -1: never", false,
     [](const Source& s, std::size_t i) { return s.particles.melting_time[i]; }},
    {"void_fraction", "1", "volume of voids and open cracks over the whole", false, void_fraction},
    {"failure_threshold_factor", "1", "scatter of the failure threshold", false,
     [](const Source& s, std::size_t i) {
       const auto& factor = s.particles.failure_threshold_factor;
       return factor.empty() ? 1.0 : factor[i];
     }},
    {"strength_factor", "1", "scatter of the flow stress", false,
     [](const Source& s, std::size_t i) {
       const auto& factor = s.particles.strength_factor;
       return factor.empty() ? 1.0 : factor[i];
     }},
    {"stress", "Pa", "Cauchy stress xx yy zz xy yz zx, positive in tension, without artificial viscosity", false,
     stress},
    {"von_mises_stress", "Pa", "sqrt(3/2 s:s) of the deviatoric stress s", false, von_mises_stress},
    {"artificial_viscosity", "Pa", "pressure of artificial viscosity", false,
     [](const Source& s, std::size_t i) { return s.particles.artificial_viscosity[i]; }},
    {"sound_speed", "m/s", "longitudinal sound speed", false,
     [](const Source& s, std::size_t i) { return s.particles.sound_speed[i]; }},
    {"volume", "m^3", "volume of material", false,
     [](const Source& s, std::size_t i) { return s.particles.volume[i]; }},
    {"cell_size", "m", "edge of the cells around the particle; between two sizes where it has functions of both", false, cell_size},
    {"body", "", "number of the body in the case, from 0", true,
     [](const Source& s, std::size_t i) { return static_cast<std::uint16_t>(s.particles.body[i]); }},
    {"material", "", "number of the material in the case, from 0", false,
     [](const Source& s, std::size_t i) { return s.material_of_body[s.particles.body[i]]; }},
    {"id", "", "number of the particle, kept for its life", true,
     [](const Source& s, std::size_t i) { return s.particles.id[i]; }},
});
// clang-format on

const std::vector<OutputField>& table() {
  static const std::vector<OutputField> fields = [] {
    std::vector<OutputField> all(table_of_state.begin(), table_of_state.end());
    for (const HistoryField& field : material::history_fields()) {
      all.push_back({field.name, field.unit, field.meaning, false, &field});
    }
    return all;
  }();
  return fields;
}

}  // namespace

std::span<const OutputField> output_fields() { return table(); }

std::vector<std::string> output_field_names() {
  std::vector<std::string> names;
  for (const OutputField& field : table()) names.emplace_back(field.name);
  return names;
}

std::vector<std::string> default_output_fields() {
  return {"pressure", "temperature", "density", "internal_energy", "phase", "plastic_strain", "failed"};
}

std::vector<OutputField> select_output_fields(std::span<const std::string> names) {
  const std::vector<std::string> known = output_field_names();
  std::string unknown;
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    unknown += fmt::format("{}unknown output field {}{}", unknown.empty() ? "" : "\n", toml_string(name),
                           did_you_mean(name, known));
  }
  if (!unknown.empty()) throw InputError(fmt::format("{}\nknown: {}", unknown, fmt::join(known, ", ")));
  std::vector<OutputField> selected;
  for (const OutputField& field : table()) {
    if (field.always || std::find(names.begin(), names.end(), field.name) != names.end())
      selected.push_back(field);
  }
  return selected;
}

std::string describe_output_fields() {
  std::string text;
  for (const OutputField& field : table()) {
    text += fmt::format("{:<26}{:<10}{}{}\n", field.name, field.unit, field.meaning,
                        field.always ? " (always written)" : "");
  }
  return text;
}

}  // namespace whipple::io

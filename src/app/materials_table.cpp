// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/materials_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>
#include <vector>

#include "eos/detonation.hpp"
#include "eos/loci.hpp"
#include "src/core/base/error.hpp"
#include "src/material/material_file.hpp"

namespace whipple::app {
namespace {

constexpr double standard_atmosphere = 101325.0;  // Pa
constexpr double shock_of_the_table = 1000.0;     // m/s, particle velocity

using Row = std::vector<std::string>;

std::string cell(double value, int digits = 4) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : std::string("-");
}

std::string range(const std::optional<eos::ShockState>& from, const std::optional<eos::ShockState>& to) {
  const auto pressure = [](const std::optional<eos::ShockState>& s) {
    return s ? fmt::format("{:.0f}", s->state.pressure * 1e-9) : std::string("-");
  };
  return from || to ? fmt::format("{}..{}", pressure(from), pressure(to)) : std::string("-");
}

std::string range(double from, double to) {
  return std::isfinite(to) ? fmt::format("{:.0f}..{:.0f}", from, to)
                           : (std::isfinite(from) ? fmt::format("{:.0f}", from) : std::string("-"));
}

/// Returns the value of a curve, or nothing where the model is not valid.
template <class Curve>
auto if_defined(const Curve& curve) -> std::optional<decltype(curve())> {
  try {
    return curve();
  } catch (const StateError&) {
    return std::nullopt;
  }
}

const Row head_with_phases = {"material",
                              "model",
                              "rho0 g/cm3",
                              "c0 km/s",
                              "T_m K",
                              "measured",
                              "T_b K",
                              "measured",
                              "T_c K",
                              "melts in the shock, GPa",
                              "after release, GPa",
                              "boils after release, GPa",
                              "source"};

Row row_with_phases(const std::string& name, const Material& material) {
  const eos::EquationOfState& eos = *material.eos;
  const auto melting = if_defined([&] { return eos::melting_point(eos, 0.0); }).value_or(std::nullopt);
  const auto shock = if_defined([&] { return eos::shock_melting(eos); }).value_or(std::nullopt);
  const eos::ReleaseThresholds release = if_defined([&] {
                                           return eos::release_thresholds(eos, standard_atmosphere);
                                         }).value_or(eos::ReleaseThresholds{});
  const eos::VapourDome* dome = eos.vapour_dome();
  const auto boiling = dome != nullptr ? dome->at_pressure(standard_atmosphere) : std::nullopt;
  return {
      name,
      std::string(eos.model()),
      cell(material.reference.density * 1e-3),
      cell(material.reference.sound_speed * 1e-3),
      melting ? cell(0.5 * (melting->solidus.temperature + melting->liquidus.temperature)) : "-",
      range(material.measured.melting_point, material.measured.liquidus),
      boiling ? cell(boiling->temperature) : "-",
      range(material.measured.boiling_point, std::nan("")),
      dome != nullptr ? cell(dome->critical_point().temperature) : "-",
      shock ? range(shock->onset, shock->completion) : "-",
      range(release.incipient_melting, release.complete_melting),
      release.incipient_vaporisation ? cell(release.incipient_vaporisation->state.pressure * 1e-9, 3) : "-",
      material.source};
}

const Row head_without_phases = {"material", "model", "rho0 g/cm3", "c0 km/s", "p at up = 1 km/s, GPa",
                                 "source"};

Row row_without_phases(const std::string& name, const Material& material) {
  const auto shock =
      if_defined([&] { return eos::Hugoniot(*material.eos).at_particle_velocity(shock_of_the_table); });
  return {name,
          std::string(material.eos->model()),
          cell(material.reference.density * 1e-3),
          cell(material.reference.sound_speed * 1e-3),
          shock ? cell(shock->state.pressure * 1e-9) : "-",
          material.source};
}

const Row head_of_explosives = {"material", "model",       "rho0 g/cm3", "D km/s",
                                "p_CJ GPa", "rho_CJ/rho0", "T_CJ K",     "source"};

Row row_of_explosive(const std::string& name, const Material& material) {
  const eos::EquationOfState& eos = *material.eos;
  const eos::ChapmanJouguet wave = eos::chapman_jouguet(eos);
  return {name,
          std::string(eos.model()),
          cell(eos.reference_density() * 1e-3),
          cell(wave.detonation_velocity * 1e-3),
          cell(wave.state.pressure * 1e-9),
          cell(wave.state.density / eos.reference_density()),
          cell(wave.state.temperature),
          material.source};
}

/// Holds one table: its header and its rows.
struct Table {
  std::string title;
  const Row& head;
  Row (*row)(const std::string& name, const Material& material);
  std::vector<Row> rows = {};
};

/// Returns whether a material has melting or boiling; others are listed separately.
bool has_phases(const eos::EquationOfState& eos) {
  return eos.vapour_dome() != nullptr ||
         if_defined([&] { return eos::melting_point(eos, 0.0); }).value_or(std::nullopt);
}

std::string line(const Row& cells) { return fmt::format("| {} |\n", fmt::join(cells, " | ")); }

}  // namespace

std::string library_as_markdown() {
  std::string text;
  const std::vector<LibraryMaterial> library = library_materials();
  for (const char* group : material_groups) {
    Table phases{group, head_with_phases, row_with_phases};
    Table explosives{group, head_of_explosives, row_of_explosive};
    Table plain{group, head_without_phases, row_without_phases};
    for (const LibraryMaterial& entry : library) {
      if (entry.group != group) continue;
      const Material material = read_material(entry.file);
      Table& table = entry.group == "explosives" ? explosives : has_phases(*material.eos) ? phases : plain;
      table.rows.push_back(table.row(entry.file.stem().string(), material));
    }
    if (!phases.rows.empty()) plain.title += " without phases";
    for (const Table& table : {phases, explosives, plain}) {
      if (table.rows.empty()) continue;
      text +=
          fmt::format("\n### {}\n\n{}{}", table.title, line(table.head), line(Row(table.head.size(), "---")));
      for (const Row& row : table.rows) text += line(row);
    }
  }
  return text;
}

}  // namespace whipple::app

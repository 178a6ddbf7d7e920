// SPDX-License-Identifier: BSD-3-Clause
#include "eos/experiments/experiment.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numeric>
#include <string_view>
#include <utility>

#include "eos/experiments/measured_table.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/pattern.hpp"

namespace whipple::eos::experiments {
namespace {

constexpr double room_temperature = 298.0;  // K
constexpr double rest_pressure = 2e5;       // Pa; 1 bar, also if rounded, counts as unloaded

/// Returns whether the file name or a comment contains a word.
bool says(const MeasuredTable& table, const char* pattern) {
  const Pattern word(pattern, Pattern::Case::ignored);
  if (word.is_in(table.file().stem().string())) return true;
  return std::ranges::any_of(table.comments(),
                             [&](const std::string& comment) { return word.is_in(comment); });
}

bool has_volumes(const MeasuredTable& table) {
  constexpr std::array columns = {Quantity::volume_ratio, Quantity::atomic_volume, Quantity::specific_volume,
                                  Quantity::density};
  return std::ranges::any_of(columns, [&](Quantity quantity) { return table.find(quantity).has_value(); });
}

std::string measured_material(const MeasuredTable& table) {
  constexpr std::string_view key = "material:";
  for (const std::string& comment : table.comments()) {
    if (!comment.starts_with(key)) continue;
    const std::size_t first = comment.find_first_not_of(' ', key.size());
    return first == std::string::npos ? "" : comment.substr(first);
  }
  return "";
}

double isotherm_temperature(const MeasuredTable& table) {
  static const Pattern in_name("(^|_)([0-9]+)K(_|$)");
  static const Pattern in_comment("(^|[ (,])([0-9]+(\\.[0-9]+)?) K([ ,.;)]|$)");
  static const Pattern room("room[- ]temperature", Pattern::Case::ignored);
  if (const auto found = in_name.find(table.file().stem().string())) return std::stod(found->at(2));
  for (const std::string& comment : table.comments()) {
    if (const auto found = in_comment.find(comment)) return std::stod(found->at(2));
    if (room.is_in(comment)) return room_temperature;
  }
  throw InputError(
      fmt::format("{}: the temperature of the isotherm is neither in the file name (\"_298K\") nor in a "
                  "comment (\"298 K\", \"room temperature\"): give --temperature",
                  table.file().string()));
}

/// Returns the row at rest, including 1 bar and its rounding; the first if there are several.
std::optional<std::size_t> rest_row(const std::vector<double>& pressure) {
  const auto found = std::ranges::find_if(pressure, [](double p) { return std::abs(p) <= rest_pressure; });
  if (found == pressure.end()) return std::nullopt;
  return static_cast<std::size_t>(found - pressure.begin());
}

/// Holds the volumes of the rows.
struct Volumes {
  VolumeScale scale = VolumeScale::ratio;
  std::vector<double> values;            ///< V/V0 or densities
  std::vector<double> relative_error;    ///< one standard deviation; empty: no such column
  double ambient_volume = 0.0;           ///< m^3 per atom
  std::optional<std::size_t> reference;  ///< row of V0
};

/// Holds the column of volumes or densities, with `values` as volumes (ratios; m^3 per atom or per kg).
struct VolumeColumn {
  Quantity quantity;
  std::vector<double> values, relative_error;
};
VolumeColumn volume_column(const MeasuredTable& table) {
  for (const Quantity quantity :
       {Quantity::volume_ratio, Quantity::atomic_volume, Quantity::specific_volume, Quantity::density}) {
    const auto found = table.find(quantity);
    if (!found) continue;
    VolumeColumn column{quantity, table.numbers(*found), table.errors(quantity)};
    for (std::size_t i = 0; i < column.relative_error.size(); ++i)
      column.relative_error[i] /= column.values[i];
    if (quantity == Quantity::density) {
      for (double& value : column.values) value = 1.0 / value;
    }
    return column;
  }
  throw InputError(
      fmt::format("{}: no column of volume (V_over_V0, atomic_volume_A3, V_cm3_g, rho_g_cm3); the "
                  "columns are {}",
                  table.file().string(), table.headings()));
}

/// Returns V/V0 from the stated initial density, otherwise from the row at rest; without either, densities.
Volumes relative_volumes(const MeasuredTable& table, const std::vector<double>& pressure) {
  VolumeColumn column = volume_column(table);
  Volumes volumes{VolumeScale::ratio, std::move(column.values), std::move(column.relative_error), 0.0, {}};
  if (column.quantity == Quantity::volume_ratio) return volumes;
  const bool of_atoms = column.quantity == Quantity::atomic_volume;
  if (const std::vector<double> initial = table.numbers(Quantity::initial_density);
      !initial.empty() && !of_atoms) {
    for (std::size_t i = 0; i < initial.size(); ++i) volumes.values[i] *= initial[i];
    return volumes;
  }
  volumes.reference = rest_row(pressure);
  if (volumes.reference) {
    const double ambient = volumes.values[*volumes.reference];
    if (of_atoms) volumes.ambient_volume = ambient;
    for (double& value : volumes.values) value /= ambient;
    return volumes;
  }
  if (of_atoms) {
    throw InputError(fmt::format(
        "{}: volumes of atoms without the one at zero pressure; add a row with P = 0 (or 1 bar), or "
        "give densities or V_over_V0",
        table.file().string()));
  }
  volumes.scale = VolumeScale::density;
  for (double& value : volumes.values) value = 1.0 / value;
  return volumes;
}

/// Returns the volumes of an isotherm: densities and specific volumes are absolute, as those of the model.
Volumes isothermal_volumes(const MeasuredTable& table, const std::vector<double>& pressure) {
  VolumeColumn column = volume_column(table);
  if (column.quantity == Quantity::volume_ratio || column.quantity == Quantity::atomic_volume)
    return relative_volumes(table, pressure);
  for (double& value : column.values) value = 1.0 / value;
  return {VolumeScale::density, std::move(column.values), std::move(column.relative_error), 0.0, {}};
}

/// Returns the temperature of V0 for the ratios of an isotherm, and records its origin.
double reference_temperature(const MeasuredTable& table, Experiment& experiment, const Volumes& volumes,
                             const std::vector<double>& pressure, const std::vector<double>& temperatures) {
  if (volumes.reference) return temperatures[*volumes.reference];
  static const Pattern stated("V_?0 at ([0-9]+(\\.[0-9]+)?) ?K", Pattern::Case::ignored);
  for (const std::string& comment : table.comments()) {
    if (const auto found = stated.find(comment)) return std::stod(found->at(1));
  }
  for (std::size_t i = 0; i < pressure.size(); ++i) {
    if (std::abs(pressure[i]) <= rest_pressure && std::abs(volumes.values[i] - 1.0) < 1e-6)
      return temperatures[i];
  }
  const auto is_ambient = [](double t) { return t >= 273.0 && t <= 323.0; };
  if (std::ranges::all_of(temperatures, is_ambient)) return temperatures.front();
  experiment.remarks.push_back(
      fmt::format("V0 of the ratios is taken at zero pressure and {:g} K, not at the temperature of the "
                  "isotherm; a comment "
                  "\"V0 at 1500 K\" names another temperature",
                  room_temperature));
  return room_temperature;
}

/// Returns the reason why a row is not a measurement of a compressed state; empty if it is one.
std::string_view fault(const Experiment& experiment, double x, double y) {
  if (!std::isfinite(x) || !std::isfinite(y)) return "a value is missing or no number";
  switch (experiment.kind) {
    case ExperimentKind::shock_velocity:
      if (x == 0.0) return "at rest (up = 0: a sound speed, no shock)";
      if (x < 0.0) return "up is negative";
      if (y <= x) return "Us is not above up";
      break;
    case ExperimentKind::isotherm:
      if (x <= 0.0) return "the volume or density is not positive";
      if (y < -rest_pressure) return "P is negative";
      if (experiment.volume == VolumeScale::ratio && y <= rest_pressure && std::abs(x - 1.0) < 1e-6)
        return "at zero pressure, the reference itself";
      break;
    case ExperimentKind::shock_pressure:
    case ExperimentKind::isentrope:
      if (x <= 0.0) return "the volume or density is not positive";
      if (std::abs(y) <= rest_pressure) return "at zero pressure, the reference itself";
      if (y < 0.0) return "P is negative";
      break;
    case ExperimentKind::shock_temperature:
      if (x < 0.0) return "P is negative";
      [[fallthrough]];
    case ExperimentKind::melting:
      if (y <= 0.0) return "T is not positive";
      break;
    case ExperimentKind::sound_speed:
      if (x < 0.0) return "P is negative";
      if (y <= 0.0) return "the sound speed is not positive";
      break;
    case ExperimentKind::heat_capacity:
      if (y <= 0.0) return "the heat capacity is not positive";
      [[fallthrough]];
    case ExperimentKind::expansion:
      if (x <= 0.0) return "T is not positive";
      break;
  }
  return "";
}

/// Holds a measured quantity of every row with its standard deviations; without errors if there is no such column.
struct Measured {
  std::vector<double> values, errors;
};
Measured measured(const MeasuredTable& table, Quantity quantity) {
  return {table.numbers(quantity), table.errors(quantity)};
}
Measured measured(const Volumes& volumes) {
  Measured of{volumes.values, volumes.relative_error};
  for (std::size_t i = 0; i < of.errors.size(); ++i) of.errors[i] *= of.values[i];
  return of;
}

/// Copies the rows that are measurements of a compressed state, by increasing abscissa.
/// @param temperatures  of the rows of an isotherm; empty for the other kinds
void set_points(Experiment& experiment, const MeasuredTable& table, const Measured& abscissa,
                const Measured& ordinate, const std::vector<double>& temperatures = {}) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < abscissa.values.size(); ++i) {
    std::string_view reason = fault(experiment, abscissa.values[i], ordinate.values[i]);
    if (reason.empty() && !temperatures.empty() && !(temperatures[i] > 0.0)) reason = "T is not positive";
    if (reason.empty()) {
      order.push_back(i);
    } else {
      experiment.left_out[std::string(reason)].push_back(table.line(i));
    }
  }
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return abscissa.values[i]; });
  const auto stated = [](const std::vector<double>& values, std::size_t i, double otherwise) {
    return values.empty() ? otherwise : values[i];
  };
  const std::vector<double> density = table.numbers(Quantity::initial_density);
  const std::vector<double> porosity = table.numbers(Quantity::porosity);
  experiment.states_errors = !ordinate.errors.empty() || !abscissa.errors.empty();
  const double no_column = experiment.states_errors ? 0.0 : nan;
  for (const std::size_t i : order) {
    experiment.ordinate_error.push_back(stated(ordinate.errors, i, no_column));
    experiment.abscissa_error.push_back(stated(abscissa.errors, i, no_column));
    experiment.abscissa.push_back(abscissa.values[i]);
    experiment.ordinate.push_back(ordinate.values[i]);
    experiment.lines.push_back(table.line(i));
    experiment.initial_density.push_back(stated(density, i, nan));
    experiment.porosity.push_back(stated(porosity, i, nan));
    experiment.temperatures.push_back(stated(temperatures, i, nan));
  }
  if (order.empty()) throw InputError(fmt::format("{}: no compressed state in it", experiment.file.string()));
  for (const std::string& heading : table.unused_errors()) {
    experiment.remarks.push_back(
        fmt::format("column \"{}\" is not used: it is the error of no column that is", heading));
  }
}

/// Returns whether P and T without a volume are those of a Hugoniot rather than a melting line. The first mention
/// counts, in the name, the headings, the comments.
bool is_shock_temperature(const MeasuredTable& table) {
  static const Pattern word("(hugoniot|shock temperature)|melt|solidus|liquidus", Pattern::Case::ignored);
  static const Pattern melting_heading("(^|, )Tm($|[^a-z])", Pattern::Case::ignored);
  const std::string heading = table.headings();
  // Group 1 is that of shocks.
  if (const auto found = word.find(table.file().stem().string())) return !found->at(1).empty();
  if (const auto found = word.find(heading)) return !found->at(1).empty();
  if (melting_heading.is_in(heading)) return false;
  for (const std::string& comment : table.comments()) {
    if (const auto found = word.find(comment)) return !found->at(1).empty();
  }
  throw InputError(
      fmt::format("{}: pressures and temperatures of what? Write \"melting line\" or \"Hugoniot\" into a "
                  "comment or the name",
                  table.file().string()));
}

/// Sets up an isotherm, or a table of pressure, volume and temperature.
void set_isotherm(Experiment& experiment, const MeasuredTable& table, std::optional<double> temperature) {
  experiment.kind = ExperimentKind::isotherm;
  const Measured pressure = measured(table, Quantity::pressure);
  std::vector<double> temperatures = table.numbers(Quantity::temperature);
  if (temperatures.empty())
    temperatures.assign(table.rows(), temperature ? *temperature : isotherm_temperature(table));
  const Volumes volumes = isothermal_volumes(table, pressure.values);
  experiment.volume = volumes.scale;
  experiment.ambient_volume = volumes.ambient_volume;
  if (volumes.scale == VolumeScale::ratio) {
    experiment.volume_temperature =
        reference_temperature(table, experiment, volumes, pressure.values, temperatures);
  }
  set_points(experiment, table, measured(volumes), pressure, temperatures);
  const auto [least, most] = std::ranges::minmax(experiment.temperatures);
  if (least == most) experiment.temperature = least;
}

/// Returns Us = C + S up + S2 up^2/Us + S3 up^3/Us^2 (Steinberg), up and Us in m/s.
double fitted_shock_velocity(const std::array<double, 4>& c, double up) {
  double us = c[0] + c[1] * up;
  if (c[2] == 0.0 && c[3] == 0.0) return us;
  for (int i = 0; i < 100; ++i) us = c[0] + up * (c[1] + up / us * (c[2] + up / us * c[3]));
  return us;
}

/// Holds the range of up stated by a fit, "Up 0-4.16" in km/s or "7-108 GPa"; otherwise up to half of C.
struct StatedRange {
  double from, to, unit;
  bool of_pressure;
};
StatedRange stated_range(const std::string& text, double c) {
  static const Pattern velocities("Up ([0-9.]+)-([0-9.]+)"), pressures("([0-9.]+)-([0-9.]+) GPa");
  if (const auto found = velocities.find(text))
    return {std::stod(found->at(1)), std::stod(found->at(2)), 1e3, false};
  if (const auto found = pressures.find(text))
    return {std::stod(found->at(1)), std::stod(found->at(2)), 1e9, true};
  return {0.0, 0.5 * c, 1.0, false};
}

/// Converts every row of a table of fits to a separate Hugoniot, with points within its stated range.
std::vector<Experiment> shock_fits(const MeasuredTable& table, const Experiment& common) {
  constexpr int candidates = 60;  // up to up = 1.5 C
  const auto texts = [&](const char* heading) {
    const auto found = table.find_heading(heading);
    return found ? table.texts(*found) : std::vector<std::string>(table.rows());
  };
  const auto constants = [&](Quantity quantity) {
    const std::vector<double> values = table.numbers(quantity);
    return values.empty() ? std::vector<double>(table.rows(), 0.0) : values;
  };
  const auto names = texts("material"), words = texts("library"), ranges = texts("range");
  const std::array columns = {constants(Quantity::hugoniot_intercept), constants(Quantity::hugoniot_slope),
                              constants(Quantity::hugoniot_quadratic), constants(Quantity::hugoniot_cubic)};
  const std::vector<double> density = constants(Quantity::initial_density);
  std::vector<Experiment> fits;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    Experiment fit = common;
    fit.kind = ExperimentKind::shock_velocity;
    fit.name += fmt::format(":{} {}", table.line(row), names[row]);
    if (!names[row].empty()) fit.material = words[row].empty() ? names[row] : words[row];
    fit.only_its_material = !fit.material.empty();
    std::array<double, 4> c{};
    for (std::size_t k = 0; k < c.size(); ++k) c[k] = std::isnan(columns[k][row]) ? 0.0 : columns[k][row];
    const StatedRange range = stated_range(ranges[row], c[0]);
    if (c[0] <= 0.0 || (range.of_pressure && !(density[row] > 0.0))) {
      throw InputError(
          fmt::format("{}:{}: a fit of shock velocities needs C > 0, and rho0 if its range is one of "
                      "pressures",
                      table.file().string(), table.line(row)));
    }
    for (int i = 1; i <= candidates; ++i) {
      const double up = 1.5 * c[0] * i / candidates;
      const double us = fitted_shock_velocity(c, up);
      const double place = (range.of_pressure ? density[row] * us * up : up) / range.unit;
      if (place < range.from || place > range.to) continue;
      fit.abscissa.push_back(up);
      fit.ordinate.push_back(us);
      fit.lines.push_back(table.line(row));
      fit.initial_density.push_back(density[row] > 0.0 ? density[row] : nan);
      fit.porosity.push_back(nan);
      fit.temperatures.push_back(nan);
      fit.ordinate_error.push_back(nan);
      fit.abscissa_error.push_back(nan);
    }
    if (!fit.abscissa.empty()) fits.push_back(std::move(fit));
  }
  return fits;
}

}  // namespace

std::vector<double> measured_quantity(const std::filesystem::path& file, std::string_view column) {
  const MeasuredTable table = MeasuredTable::read(file);
  const auto by_row = [&](const auto& of_row) {
    std::vector<double> values;
    for (std::size_t i = 0; i < table.rows(); ++i) values.push_back(of_row(i));
    return values;
  };
  const std::optional<Quantity> wanted = MeasuredTable::quantity_of(std::string(column));
  if (wanted) {
    if (const auto found = table.find(*wanted)) return table.numbers(*found);
  }
  const std::vector<double> us = table.numbers(Quantity::shock_velocity);
  const std::vector<double> up = table.numbers(Quantity::particle_velocity);
  const bool shocks = !us.empty() && !up.empty();
  if (wanted == Quantity::volume_ratio) {
    if (shocks) return by_row([&](std::size_t i) { return 1 - up[i] / us[i]; });
    if (const auto p = table.find(Quantity::pressure)) {
      Volumes volumes = relative_volumes(table, table.numbers(*p));
      if (volumes.scale == VolumeScale::ratio) return volumes.values;
    }
  } else if (wanted == Quantity::pressure) {
    const std::vector<double> rho0 = table.numbers(Quantity::initial_density);
    if (shocks && !rho0.empty()) return by_row([&](std::size_t i) { return rho0[i] * us[i] * up[i]; });
  }
  throw InputError(fmt::format("{}: no column that gives {}; the columns are {}", file.string(), column,
                               table.headings()));
}

std::vector<Experiment> read_experiments(const std::filesystem::path& file,
                                         std::optional<double> temperature) {
  const MeasuredTable table = MeasuredTable::read(file);
  Experiment experiment;
  experiment.file = file;
  experiment.name = file.stem().string();
  experiment.source = table.comments().empty() ? "" : table.comments().front();
  experiment.material = measured_material(table);
  if (table.find(Quantity::hugoniot_intercept) && table.find(Quantity::hugoniot_slope)) {
    return shock_fits(table, experiment);
  }
  const auto has = [&](Quantity quantity) { return table.find(quantity).has_value(); };
  if (has(Quantity::shock_velocity) && has(Quantity::particle_velocity)) {
    experiment.kind = ExperimentKind::shock_velocity;
    set_points(experiment, table, measured(table, Quantity::particle_velocity),
               measured(table, Quantity::shock_velocity));
    return {experiment};
  }
  for (const auto& [quantity, kind] : {std::pair(Quantity::heat_capacity, ExperimentKind::heat_capacity),
                                       std::pair(Quantity::linear_expansion, ExperimentKind::expansion)}) {
    if (!has(quantity) || !has(Quantity::temperature) || has(Quantity::pressure)) continue;
    experiment.kind = kind;
    set_points(experiment, table, measured(table, Quantity::temperature), measured(table, quantity));
    return {experiment};
  }
  if (!has(Quantity::pressure)) {
    throw InputError(fmt::format(
        "{}: neither a Hugoniot (columns us_km_s, up_km_s) nor pressures (P_GPa) with volumes, "
        "temperatures (T_K) or bulk sound speeds (c_bulk_km_s), nor heat capacities (cp_J_kgK) or "
        "linear expansions (alpha_lin_1e-6_per_K) with temperatures, nor fits of shock velocities "
        "(C_km_s, S); the columns are {}",
        file.string(), table.headings()));
  }
  const Measured pressure = measured(table, Quantity::pressure);
  if (has(Quantity::bulk_sound_speed)) {
    experiment.kind = ExperimentKind::sound_speed;
    set_points(experiment, table, pressure, measured(table, Quantity::bulk_sound_speed));
    return {experiment};
  }
  if (has(Quantity::temperature) && !has_volumes(table)) {
    experiment.kind =
        is_shock_temperature(table) ? ExperimentKind::shock_temperature : ExperimentKind::melting;
    set_points(experiment, table, pressure, measured(table, Quantity::temperature));
    return {experiment};
  }
  // The comments of an isentrope may mention the Hugoniot.
  const bool along_isentrope = says(table, "isentrop");
  if (!along_isentrope && !says(table, "hugoniot")) {
    set_isotherm(experiment, table, temperature);
    return {experiment};
  }
  experiment.kind = along_isentrope ? ExperimentKind::isentrope : ExperimentKind::shock_pressure;
  const Volumes volumes = relative_volumes(table, pressure.values);
  experiment.volume = volumes.scale;
  experiment.ambient_volume = volumes.ambient_volume;
  set_points(experiment, table, measured(volumes), pressure);
  return {experiment};
}

}  // namespace whipple::eos::experiments

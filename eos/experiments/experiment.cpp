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
#include <regex>
#include <string_view>

#include "eos/experiments/measured_table.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos::experiments {
namespace {

constexpr double room_temperature = 298.0;  // K

/// Whether the file name or a comment holds a word.
bool says(const MeasuredTable& table, const char* pattern) {
  const std::regex word(pattern, std::regex::icase);
  if (std::regex_search(table.file().stem().string(), word)) return true;
  return std::ranges::any_of(table.comments(),
                             [&](const std::string& comment) { return std::regex_search(comment, word); });
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
  static const std::regex in_name("(^|_)([0-9]+)K(_|$)");
  static const std::regex in_comment("(^|[ (,])([0-9]+(\\.[0-9]+)?) K([ ,.;)]|$)");
  static const std::regex room("room[- ]temperature", std::regex::icase);
  std::smatch match;
  const std::string stem = table.file().stem().string();
  if (std::regex_search(stem, match, in_name)) return std::stod(match[2]);
  for (const std::string& comment : table.comments()) {
    if (std::regex_search(comment, match, in_comment)) return std::stod(match[2]);
    if (std::regex_search(comment, room)) return room_temperature;
  }
  throw InputError(
      fmt::format("{}: the temperature of the isotherm is neither in the file name (\"_298K\") nor in a "
                  "comment (\"298 K\", \"room temperature\"): give --temperature",
                  table.file().string()));
}

/// V/V0 from whichever column of volume or density there is. The volume of reference is that of the stated
/// initial density, else that of the row at zero pressure.
std::vector<double> volume_ratios(const MeasuredTable& table, const std::vector<double>& pressure,
                                  double& ambient_volume) {
  if (const auto ratio = table.find(Quantity::volume_ratio)) return table.numbers(*ratio);
  std::vector<double> volume;
  bool of_atoms = false;
  if (const auto atomic = table.find(Quantity::atomic_volume)) {
    volume = table.numbers(*atomic);
    of_atoms = true;
  } else if (const auto specific = table.find(Quantity::specific_volume)) {
    volume = table.numbers(*specific);
  } else if (const auto density = table.find(Quantity::density)) {
    volume = table.numbers(*density);
    for (double& value : volume) value = 1.0 / value;
  } else {
    throw InputError(
        fmt::format("{}: no column of volume (V_over_V0, atomic_volume_A3, V_cm3_g, rho_g_cm3); the "
                    "columns are {}",
                    table.file().string(), table.headings()));
  }
  if (const std::vector<double> initial = table.numbers(Quantity::initial_density);
      !initial.empty() && !of_atoms) {
    for (std::size_t i = 0; i < volume.size(); ++i) volume[i] *= initial[i];
    return volume;
  }
  const auto ambient = std::ranges::find(pressure, 0.0);
  if (ambient == pressure.end()) {
    throw InputError(
        fmt::format("{}: volumes without the one at zero pressure; add a row with P = 0, or a column "
                    "V_over_V0",
                    table.file().string()));
  }
  ambient_volume = volume[static_cast<std::size_t>(ambient - pressure.begin())];
  for (double& value : volume) value /= ambient_volume;
  return volume;
}

/// Why a row is no measurement of a compressed state; empty: it is one.
std::string_view fault(ExperimentKind kind, double x, double y) {
  if (!std::isfinite(x) || !std::isfinite(y)) return "a value is missing or no number";
  switch (kind) {
    case ExperimentKind::shock_velocity:
      if (x == 0.0) return "at rest (up = 0: a sound speed, no shock)";
      if (x < 0.0) return "up is negative";
      if (y <= x) return "Us is not above up";
      break;
    case ExperimentKind::shock_pressure:
    case ExperimentKind::isotherm:
    case ExperimentKind::isentrope:
      if (y == 0.0) return "at zero pressure, the reference itself";
      if (y < 0.0) return "P is negative";
      if (x <= 0.0) return "V/V0 is not positive";
      break;
    case ExperimentKind::melting:
      if (y <= 0.0) return "T is not positive";
      break;
    case ExperimentKind::sound_speed:
      if (x < 0.0) return "P is negative";
      if (y <= 0.0) return "the sound speed is not positive";
      break;
  }
  return "";
}

/// Takes over the rows that are measurements of a compressed state, by rising abscissa.
void set_points(Experiment& experiment, const MeasuredTable& table, const std::vector<double>& abscissa,
                const std::vector<double>& ordinate) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < abscissa.size(); ++i) {
    const std::string_view reason = fault(experiment.kind, abscissa[i], ordinate[i]);
    if (reason.empty()) {
      order.push_back(i);
    } else {
      experiment.left_out[std::string(reason)].push_back(table.line(i));
    }
  }
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return abscissa[i]; });
  const std::vector<double> density = table.numbers(Quantity::initial_density);
  const std::vector<double> porosity = table.numbers(Quantity::porosity);
  const bool isotherm = experiment.kind == ExperimentKind::isotherm;
  const std::vector<double> none;
  const std::vector<double> pressure_error = isotherm ? table.numbers(Quantity::pressure_error) : none;
  const std::vector<double> volume_error =
      isotherm && experiment.ambient_volume > 0.0 ? table.numbers(Quantity::volume_error) : none;
  for (const std::size_t i : order) {
    if (!pressure_error.empty()) experiment.ordinate_error.push_back(pressure_error[i]);
    if (!volume_error.empty())
      experiment.abscissa_error.push_back(volume_error[i] / experiment.ambient_volume);
    experiment.abscissa.push_back(abscissa[i]);
    experiment.ordinate.push_back(ordinate[i]);
    experiment.lines.push_back(table.line(i));
    experiment.initial_density.push_back(density.empty() ? nan : density[i]);
    experiment.porosity.push_back(porosity.empty() ? nan : porosity[i]);
  }
  if (order.empty()) throw InputError(fmt::format("{}: no compressed state in it", experiment.file.string()));
}

/// Us = C + S up + S2 up^2/Us + S3 up^3/Us^2 (Steinberg), up and Us in m/s.
double fitted_shock_velocity(const std::array<double, 4>& c, double up) {
  double us = c[0] + c[1] * up;
  if (c[2] == 0.0 && c[3] == 0.0) return us;
  for (int i = 0; i < 100; ++i) us = c[0] + up * (c[1] + up / us * (c[2] + up / us * c[3]));
  return us;
}

/// The range of up that a fit states, "Up 0-4.16" in km/s or "7-108 GPa"; else up to half of C.
struct StatedRange {
  double from, to, unit;
  bool of_pressure;
};
StatedRange stated_range(const std::string& text, double c) {
  static const std::regex velocities("Up ([0-9.]+)-([0-9.]+)"), pressures("([0-9.]+)-([0-9.]+) GPa");
  std::smatch match;
  if (std::regex_search(text, match, velocities))
    return {std::stod(match[1]), std::stod(match[2]), 1e3, false};
  if (std::regex_search(text, match, pressures)) return {std::stod(match[1]), std::stod(match[2]), 1e9, true};
  return {0.0, 0.5 * c, 1.0, false};
}

/// Every row of a table of fits as a Hugoniot of its own, of points within the range that it states.
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
      double ambient_volume = 0.0;
      return volume_ratios(table, table.numbers(*p), ambient_volume);
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
  const auto us = table.find(Quantity::shock_velocity);
  const auto up = table.find(Quantity::particle_velocity);
  if (us && up) {
    experiment.kind = ExperimentKind::shock_velocity;
    set_points(experiment, table, table.numbers(*up), table.numbers(*us));
    return {experiment};
  }
  const auto p = table.find(Quantity::pressure);
  if (!p) {
    throw InputError(fmt::format(
        "{}: neither a Hugoniot (columns us_km_s, up_km_s) nor pressures (P_GPa) with volumes, "
        "melting temperatures (T_K) or bulk sound speeds (c_bulk_km_s), nor fits of shock velocities "
        "(C_km_s, S); the columns are {}",
        file.string(), table.headings()));
  }
  const std::vector<double> pressure = table.numbers(*p);
  if (const auto sound = table.find(Quantity::bulk_sound_speed)) {
    experiment.kind = ExperimentKind::sound_speed;
    set_points(experiment, table, pressure, table.numbers(*sound));
    return {experiment};
  }
  if (const auto melting = table.find(Quantity::temperature); melting && !has_volumes(table)) {
    experiment.kind = ExperimentKind::melting;
    set_points(experiment, table, pressure, table.numbers(*melting));
    return {experiment};
  }
  const std::vector<double> ratios = volume_ratios(table, pressure, experiment.ambient_volume);
  // An isentrope's comments may well speak of the Hugoniot.
  if (says(table, "isentrop")) {
    experiment.kind = ExperimentKind::isentrope;
  } else if (says(table, "hugoniot")) {
    experiment.kind = ExperimentKind::shock_pressure;
  } else {
    experiment.kind = ExperimentKind::isotherm;
    experiment.temperature = temperature ? *temperature : isotherm_temperature(table);
  }
  set_points(experiment, table, ratios, pressure);
  return {experiment};
}

}  // namespace whipple::eos::experiments

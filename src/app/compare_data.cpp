// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/compare_data.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>
#include <regex>
#include <string_view>

#include "eos/inversions.hpp"
#include "eos/loci.hpp"
#include "src/base/error.hpp"
#include "src/base/units.hpp"
#include "src/process/paths.hpp"

namespace whipple::app {
namespace {

constexpr double room_temperature = 298.0;  // K
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Endings of column names and their units.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> unit_endings = {{{"_km_s", "km/s"},
                                                                                        {"_m_s", "m/s"},
                                                                                        {"_GPa", "GPa"},
                                                                                        {"_kbar", "kbar"},
                                                                                        {"_A3", "angstrom^3"},
                                                                                        {"_cm3_g", "cm^3/g"},
                                                                                        {"_g_cm3", "g/cm^3"},
                                                                                        {"_kg_m3", "kg/m^3"},
                                                                                        {"_K", "K"}}};

struct Csv {
  std::vector<std::string> comments;
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;
  std::vector<int> lines;  ///< line number of each row
};

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  bool inside_quotes = false;
  for (const char c : line) {
    if (c == '"') {
      inside_quotes = !inside_quotes;
    } else if (c == ',' && !inside_quotes) {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

Csv read_csv(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("cannot read '{}'", path.string()));
  Csv csv;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.empty() || line == "\r") continue;
    if (line.front() == '#') {
      csv.comments.push_back(line.substr(
          line.find_first_not_of("# ") == std::string::npos ? line.size() : line.find_first_not_of("# ")));
    } else if (csv.names.empty()) {
      csv.names = split(line);
    } else {
      csv.rows.push_back(split(line));
      csv.lines.push_back(number);
      if (csv.rows.back().size() != csv.names.size()) {
        throw InputError(fmt::format("{}:{}: {} cells, the header has {}", path.string(), number,
                                     csv.rows.back().size(), csv.names.size()));
      }
    }
  }
  if (csv.rows.empty()) throw InputError(fmt::format("{}: no rows of data", path.string()));
  return csv;
}

/// Index of the column called `quantity` + a unit ending; "P" also finds "P_revised_ruby_GPa".
std::optional<std::size_t> find_column(const Csv& csv, std::string_view quantity, bool any_middle = false) {
  for (std::size_t i = 0; i < csv.names.size(); ++i) {
    const std::string& name = csv.names[i];
    for (const auto& [ending, unit] : unit_endings) {
      if (!name.ends_with(ending)) continue;
      const std::string_view bare = std::string_view(name).substr(0, name.size() - ending.size());
      if (bare == quantity || (any_middle && bare.starts_with(quantity) && bare.size() > quantity.size() &&
                               bare[quantity.size()] == '_')) {
        return i;
      }
    }
  }
  return std::nullopt;
}

std::optional<std::size_t> find_exact(const Csv& csv, std::string_view name) {
  const auto found = std::find(csv.names.begin(), csv.names.end(), name);
  if (found == csv.names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - csv.names.begin());
}

/// The numbers of a column in SI; empty cells, where they may be, are NaN.
std::vector<double> column(const Csv& csv, std::size_t index, std::string_view si_unit,
                           const std::filesystem::path& path, bool may_be_empty = false) {
  units::Conversion conversion;
  for (const auto& [ending, unit] : unit_endings) {
    if (csv.names[index].ends_with(ending)) conversion = units::conversion(unit, si_unit);
  }
  std::vector<double> values;
  for (std::size_t row = 0; row < csv.rows.size(); ++row) {
    const std::string& cell = csv.rows[row][index];
    if (cell.empty() && may_be_empty) {
      values.push_back(nan);
      continue;
    }
    double value = 0.0;
    const auto [rest, status] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (status != std::errc() || rest != cell.data() + cell.size()) {
      throw InputError(fmt::format("{}:{}: '{}' in column {} is not a number", path.string(), csv.lines[row],
                                   cell, csv.names[index]));
    }
    values.push_back(conversion.factor * value + conversion.offset);
  }
  return values;
}

std::optional<std::size_t> pressure_column(const Csv& csv) {
  for (const char* name : {"P", "P_revised_ruby", "P_revised"}) {
    if (const auto found = find_column(csv, name)) return found;
  }
  return find_column(csv, "P", true);
}

bool says_hugoniot(const Csv& csv, const std::filesystem::path& path) {
  static const std::regex word("hugoniot", std::regex::icase);
  if (std::regex_search(path.stem().string(), word)) return true;
  return std::any_of(csv.comments.begin(), csv.comments.end(),
                     [](const std::string& comment) { return std::regex_search(comment, word); });
}

/// The temperature of a file that has no volumes: a melting line.
std::optional<std::size_t> melting_column(const Csv& csv) {
  for (const char* volume : {"V", "atomic_volume", "rho"}) {
    if (find_column(csv, volume)) return std::nullopt;
  }
  if (find_exact(csv, "V_over_V0")) return std::nullopt;
  const auto temperature = find_column(csv, "Tm");
  return temperature ? temperature : find_column(csv, "T");
}

std::string measured_material(const Csv& csv) {
  constexpr std::string_view key = "material:";
  for (const std::string& comment : csv.comments) {
    if (!comment.starts_with(key)) continue;
    const std::size_t first = comment.find_first_not_of(' ', key.size());
    return first == std::string::npos ? ""
                                      : comment.substr(first, comment.find_last_not_of(" \r") + 1 - first);
  }
  return "";
}

double isotherm_temperature(const Csv& csv, const std::filesystem::path& path) {
  static const std::regex in_name("(^|_)([0-9]+)K(_|$)");
  static const std::regex in_comment("(^|[ (,])([0-9]+(\\.[0-9]+)?) K([ ,.;)]|$)");
  static const std::regex room("room[- ]temperature", std::regex::icase);
  std::smatch match;
  const std::string stem = path.stem().string();
  if (std::regex_search(stem, match, in_name)) return std::stod(match[2]);
  for (const std::string& comment : csv.comments) {
    if (std::regex_search(comment, match, in_comment)) return std::stod(match[2]);
    if (std::regex_search(comment, room)) return room_temperature;
  }
  throw InputError(
      fmt::format("{}: the temperature of the isotherm is neither in the file name (\"_298K\") nor in a "
                  "comment (\"298 K\", \"room temperature\"): give --temperature",
                  path.string()));
}

/// V/V0 from whichever column of volume or density there is.
std::vector<double> volume_ratios(const Csv& csv, const std::vector<double>& pressure,
                                  Experiment& experiment) {
  const std::filesystem::path& path = experiment.file;
  if (const auto ratio = find_exact(csv, "V_over_V0")) return column(csv, *ratio, "", path);
  std::vector<double> volume;
  if (const auto atomic = find_column(csv, "atomic_volume")) {
    volume = column(csv, *atomic, "m^3", path);
  } else if (const auto specific = find_column(csv, "V")) {
    volume = column(csv, *specific, "m^3/kg", path);
  } else if (const auto density = find_column(csv, "rho")) {
    volume = column(csv, *density, "kg/m^3", path);
    for (double& value : volume) value = 1.0 / value;
  } else {
    throw InputError(
        fmt::format("{}: no column of volume (V_over_V0, atomic_volume_A3, V_cm3_g, rho_g_cm3); the "
                    "columns are {}",
                    path.string(), fmt::join(csv.names, ", ")));
  }
  const auto ambient = std::find(pressure.begin(), pressure.end(), 0.0);
  if (ambient == pressure.end()) {
    throw InputError(
        fmt::format("{}: volumes without the one at zero pressure; add a row with P = 0, or a column "
                    "V_over_V0",
                    path.string()));
  }
  experiment.ambient_volume = volume[static_cast<std::size_t>(ambient - pressure.begin())];
  for (double& value : volume) value /= experiment.ambient_volume;
  return volume;
}

/// Keeps the points that are measurements of a compressed state, by rising abscissa.
void set_points(Experiment& experiment, const std::vector<double>& abscissa,
                const std::vector<double>& ordinate, const std::vector<double>& zero_at_rest) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < abscissa.size(); ++i) {
    if (zero_at_rest[i] > 0.0) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return abscissa[a] < abscissa[b]; });
  for (const std::size_t i : order) {
    experiment.abscissa.push_back(abscissa[i]);
    experiment.ordinate.push_back(ordinate[i]);
  }
  if (order.empty()) throw InputError(fmt::format("{}: no compressed state in it", experiment.file.string()));
}

}  // namespace

std::filesystem::path find_experiment(const std::string& name) {
  std::filesystem::path path(name);
  if (std::filesystem::exists(path)) return path;
  if (!path.has_parent_path()) {
    std::filesystem::path file = path;
    if (!file.has_extension()) file += ".csv";
    try {
      return process::find_data(std::filesystem::path("eos/data") / file);
    } catch (const InputError&) {
      // Reported below, with the folders in the user's words.
    }
  }
  throw InputError(
      fmt::format("no experiment '{}': neither a file nor one of the data that come with the program "
                  "(eos/data)",
                  name));
}

std::vector<double> measured_quantity(const std::filesystem::path& file, const std::string& wanted) {
  const Csv csv = read_csv(file);
  const auto by_row = [&](const auto& of_row) {
    std::vector<double> values;
    for (std::size_t i = 0; i < csv.rows.size(); ++i) values.push_back(of_row(i));
    return values;
  };
  const auto shock_column = [&](const char* quantity, const char* unit) {
    const auto found = find_column(csv, quantity);
    return found ? column(csv, *found, unit, file, true) : std::vector<double>();
  };
  if (const auto exact = find_exact(csv, wanted); exact && wanted == "V_over_V0") {
    return column(csv, *exact, "", file, true);
  }
  const std::vector<double> us = shock_column("us", "m/s"), up = shock_column("up", "m/s");
  const bool shocks = !us.empty() && !up.empty();
  if (wanted == "V_over_V0") {
    if (shocks) return by_row([&](std::size_t i) { return 1 - up[i] / us[i]; });
    if (const auto p = pressure_column(csv)) {
      Experiment experiment;
      experiment.file = file;
      return volume_ratios(csv, column(csv, *p, "Pa", file, true), experiment);
    }
  } else if (wanted == "P_GPa") {
    if (const auto p = pressure_column(csv)) return column(csv, *p, "Pa", file, true);
    const std::vector<double> rho0 = shock_column("rho0", "kg/m^3");
    if (shocks && !rho0.empty()) return by_row([&](std::size_t i) { return rho0[i] * us[i] * up[i]; });
  } else if (wanted == "T_K") {
    for (const char* name : {"T", "Tm"}) {
      if (const auto found = find_column(csv, name)) return column(csv, *found, "K", file, true);
    }
  } else {
    for (const auto& [ending, unit] : unit_endings) {
      if (!wanted.ends_with(ending)) continue;
      const std::string quantity = wanted.substr(0, wanted.size() - ending.size());
      const char* si = unit == "km/s" ? "m/s" : unit == "kg/m^3" ? "kg/m^3" : nullptr;
      const auto found = si == nullptr ? std::nullopt : find_column(csv, quantity);
      if (found) return column(csv, *found, si, file, true);
    }
  }
  throw InputError(fmt::format("{}: no column that gives {}; the columns are {}", file.string(), wanted,
                               fmt::join(csv.names, ", ")));
}

Experiment read_experiment(const std::filesystem::path& file, std::optional<double> temperature) {
  const Csv csv = read_csv(file);
  Experiment experiment;
  experiment.file = file;
  experiment.name = file.stem().string();
  experiment.source = csv.comments.empty() ? "" : csv.comments.front();
  experiment.material = measured_material(csv);
  const auto us = find_column(csv, "us");
  const auto up = find_column(csv, "up");
  if (us && up) {
    experiment.kind = ExperimentKind::shock_velocity;
    const std::vector<double> particle_velocity = column(csv, *up, "m/s", file);
    set_points(experiment, particle_velocity, column(csv, *us, "m/s", file), particle_velocity);
    return experiment;
  }
  const auto p = pressure_column(csv);
  if (!p) {
    throw InputError(
        fmt::format("{}: neither a Hugoniot (columns us_km_s, up_km_s) nor pressures (P_GPa) with volumes or "
                    "melting temperatures (T_K); "
                    "the columns are {}",
                    file.string(), fmt::join(csv.names, ", ")));
  }
  const std::vector<double> pressure = column(csv, *p, "Pa", file);
  if (const auto melting = melting_column(csv)) {
    experiment.kind = ExperimentKind::melting;
    const std::vector<double> melting_temperature = column(csv, *melting, "K", file);
    set_points(experiment, pressure, melting_temperature, melting_temperature);
    return experiment;
  }
  const std::vector<double> ratios = volume_ratios(csv, pressure, experiment);
  if (says_hugoniot(csv, file)) {
    experiment.kind = ExperimentKind::shock_pressure;
  } else {
    experiment.kind = ExperimentKind::isotherm;
    experiment.temperature = temperature ? *temperature : isotherm_temperature(csv, file);
  }
  set_points(experiment, ratios, pressure, pressure);
  return experiment;
}

bool belongs_to(const Experiment& experiment, const Material& material) {
  const auto lower = [](std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
  };
  const std::string word = lower(experiment.material);
  return lower(material.name).find(word) != std::string::npos ||
         lower(material.file.stem().string()).find(word) != std::string::npos;
}

std::vector<double> curve(const Material& material, const Experiment& experiment,
                          const std::vector<double>& abscissa) {
  const eos::EquationOfState& eos = *material.eos;
  std::vector<double> values;
  values.reserve(abscissa.size());
  const auto guarded = [&](const auto& function) {
    for (const double x : abscissa) {
      try {
        values.push_back(function(x));
      } catch (const StateError&) {
        values.push_back(nan);  // outside the material's range: counted by the caller
      }
    }
  };
  if (experiment.kind == ExperimentKind::melting) {
    guarded([&](double pressure) {
      const auto melting = eos::melting_point(eos, pressure);
      return melting ? 0.5 * (melting->solidus.temperature + melting->liquidus.temperature) : nan;
    });
    return values;
  }
  if (experiment.kind == ExperimentKind::isotherm) {
    const double density = eos::density_at_pressure(eos, 0.0, experiment.temperature);
    guarded([&](double ratio) {
      return eos.state_at_temperature(density / ratio, experiment.temperature).pressure;
    });
    return values;
  }
  const eos::Hugoniot hugoniot(eos, material.reference.density, material.reference.specific_internal_energy);
  if (experiment.kind == ExperimentKind::shock_velocity) {
    guarded([&](double up) { return hugoniot.at_particle_velocity(up).shock_velocity; });
  } else {
    guarded(
        [&](double ratio) { return hugoniot.at_density(material.reference.density / ratio).state.pressure; });
  }
  return values;
}

Comparison compare(const Material& material, const Experiment& experiment) {
  Comparison result;
  result.model = curve(material, experiment, experiment.abscissa);
  for (std::size_t i = 0; i < experiment.abscissa.size(); ++i) {
    const double measured = experiment.ordinate[i];
    const double difference = result.model[i] - measured;
    const bool relative =
        experiment.kind == ExperimentKind::shock_velocity || experiment.kind == ExperimentKind::melting;
    const double deviation = relative ? 100.0 * difference / measured : difference;
    result.deviation.push_back(deviation);
    if (std::isnan(deviation)) {
      ++result.out_of_range;
      continue;
    }
    ++result.points;
    result.rms += deviation * deviation;
    result.mean += deviation;
    if (std::abs(deviation) > std::abs(result.maximum)) result.maximum = deviation;
  }
  if (result.points > 0) {
    result.rms = std::sqrt(result.rms / result.points);
    result.mean /= result.points;
  }
  return result;
}

}  // namespace whipple::app

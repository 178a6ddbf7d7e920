// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/material_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include "eos/models/three_phase_model.hpp"
#include "md_fitting/elements/element_defaults.hpp"
#include "md_fitting/fit/constant_list.hpp"
#include "md_fitting/fit/fit_report.hpp"
#include "md_fitting/fit/identifiability.hpp"
#include "md_fitting/fit/joint/joint_report.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/hash.hpp"
#include "src/core/base/text.hpp"
#include "src/core/base/units.hpp"
#include "src/core/input/document.hpp"
#include "src/material/material_file.hpp"

namespace whipple::fit {
namespace {

/// Returns the name of the table that a line opens: "strength" for "[strength]", "failure" for "[[failure]]"; empty
/// if none.
std::string_view opened_table(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(" \t[");
  if (begin == std::string_view::npos || line[line.find_first_not_of(" \t")] != '[') return {};
  return line.substr(begin, line.find_first_of("]. \t", begin) - begin);
}

/// Writes the constants of one correction, ten coefficients a line.
std::string correction_lines(const eos::CorrectionConstants& correction, const char* prefix) {
  std::string text = fmt::format(
      "{0}_least_volume_ratio = {1:.8g}\n{0}_greatest_volume_ratio = {2:.8g}\n{0}_temperature = \"{3:.8g} "
      "K\"\n{0}_temperatures = {4}\n{0}_coefficients = [",
      prefix, correction.least_volume_ratio, correction.greatest_volume_ratio, correction.temperature,
      correction.temperatures);
  constexpr std::size_t per_line = 10;
  for (std::size_t i = 0; i < correction.coefficients.size(); ++i)
    text += fmt::format("{}{:.9g},", i % per_line == 0 ? "\n  " : " ", correction.coefficients[i]);
  return text + "\n]\n";
}

std::string constant_line(const Constant& constant) {
  const std::string unit = constant.unit;
  const std::string text = practical_quantity(constant.value, unit);
  const bool bare = text.find(' ') == std::string::npos;
  std::string line = fmt::format("{} = {}", constant.name, bare ? text : toml_string(text));
  switch (constant.origin) {
    case Origin::fitted: {
      // Print the errors in the unit of the value.
      const double size = units::parse_quantity(practical_quantity(constant.value, unit), unit);
      const double factor = constant.value == 0.0 ? 1.0 : std::strtod(text.c_str(), nullptr) / size;
      line += fmt::format("  # fitted: +- {:.2g}, of which noise {:.2g}", constant.error * factor,
                          constant.statistical_error * factor);
      break;
    }
    case Origin::given:
      line += fmt::format("  # given: {}", constant.source);
      break;
    case Origin::by_default:
      line +=
          fmt::format("  # default, {}: {}",
                      constant.error > 0.0 ? fmt::format("+- {}", practical_quantity(constant.error, unit, 2))
                                           : std::string("no error known"),
                      constant.source);
      break;
  }
  return line + "\n";
}

/// Returns the lines of a text as comments.
std::string comment_lines(const std::string& text) {
  std::istringstream lines(text);
  std::string comments;
  for (std::string line; std::getline(lines, line);) comments += fmt::format("# {}\n", line);
  return comments;
}

/// Formats a symmetric matrix of the fitted constants as a table, one row per name.
std::string matrix_table(const char* title, const std::vector<std::string>& names,
                         const Eigen::MatrixXd& matrix, const std::function<std::string(double)>& number) {
  std::string text = fmt::format("\n[{}]\n", title);
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::vector<std::string> row;
    for (const double value : matrix.row(static_cast<Eigen::Index>(i))) row.push_back(number(value));
    text += fmt::format("{} = [{}]\n", names[i], fmt::join(row, ", "));
  }
  return text;
}

/// Returns the scatter over the bootstrap replicates, by the names of the covariance; "nan" for constants that the
/// bootstrap does not cover (those of the vapour).
std::vector<std::string> bootstrap_errors(const Fit& fit) {
  std::vector<std::string> errors;
  for (const std::string& name : fit.fitted_names) {
    const auto place = std::find(fit.left_out_names.begin(), fit.left_out_names.end(), name);
    const Eigen::Index row = place - fit.left_out_names.begin();
    errors.push_back(place == fit.left_out_names.end()
                         ? std::string("nan")
                         : fmt::format("{:.4e}", std::sqrt(fit.bootstrap->covariance(row, row))));
  }
  return errors;
}

std::string covariance_table(const Fit& fit) {
  if (fit.fitted_names.empty()) return {};  // a sample has no covariance
  std::vector<std::string> names;
  std::vector<std::string> si_units;
  for (const std::string& name : fit.fitted_names) {
    names.push_back(toml_string(name));
    si_units.push_back(toml_string(fit.constant(name).unit));
  }
  std::string text = fmt::format(
      "[covariance]\n# Of the fitted constants, from the noise of the data, the model error and the scatter "
      "over the "
      "windows: entry k of row i in units[i] * units[k].\nnames = [{}]\nunits = [{}]\n",
      fmt::join(names, ", "), fmt::join(si_units, ", "));
  std::vector<std::string> noise;
  for (Eigen::Index i = 0; i < fit.statistical_covariance.rows(); ++i) {
    noise.push_back(fmt::format("{:.4e}", std::sqrt(fit.statistical_covariance(i, i))));
  }
  text += fmt::format("statistical_error = [{}]\n", fmt::join(noise, ", "));
  if (fit.bootstrap) {
    text += fmt::format("bootstrap_replicates = {}\nbootstrap_error = [{}]\n", fit.bootstrap->replicates,
                        fmt::join(bootstrap_errors(fit), ", "));
  }
  text +=
      fmt::format("chi_squared = {:.6g}\ndegrees_of_freedom = {}\n", fit.chi_squared, fit.degrees_of_freedom);
  std::vector<std::string> information;
  for (const double value : identifiability(fit).eigenvalues)
    information.push_back(fmt::format("{:.4g}", value));
  text += fmt::format(
      "fisher_eigenvalues = [{}]  # constants in units of themselves, or of their larger errors\n",
      fmt::join(information, ", "));
  text += matrix_table("covariance.matrix", fit.fitted_names, fit.covariance,
                       [](double value) { return fmt::format("{:.6e}", value); });
  text += matrix_table("covariance.statistical", fit.fitted_names, fit.statistical_covariance,
                       [](double value) { return fmt::format("{:.6e}", value); });
  text += matrix_table("covariance.correlation", fit.fitted_names, fit.correlation(),
                       [](double value) { return fmt::format("{:.3f}", value); });
  return text;
}

std::string settings_table(const Fit& fit) {
  const FitSettings& settings = fit.settings;
  const ModelErrors& errors = settings.model_errors;
  std::string text = "[provenance.fit]\n";
  text += fmt::format("reference_temperature = \"{} K\"\n", settings.reference_temperature);
  text += fmt::format("particle_velocities = [\"{} km/s\", \"{} km/s\"]\n",
                      settings.least_particle_velocity / 1000.0, settings.most_particle_velocity / 1000.0);
  text += fmt::format("melting = {}\n", toml_string(word_of(settings.melting)));
  text +=
      fmt::format("windows = {}\nwindows_averaged = {}\n", toml_string(word_of(settings.windows)),
                  std::ranges::count_if(fit.windows, [](const auto& window) { return window.weight > 0.0; }));
  text += fmt::format("nuclei = {}\n", toml_string(word_of(settings.nuclei)));
  text += fmt::format("model_errors = {}\n", toml_string(word_of(settings.structure)));
  text += fmt::format("correlation_particle_velocity = \"{} km/s\"\n",
                      settings.lengths.particle_velocity / 1000.0);
  text += fmt::format("correlation_volume_ratio = {}\ncorrelation_temperature = \"{} K\"\n",
                      settings.lengths.volume_ratio, settings.lengths.temperature);
  if (!fit.remarks.empty()) {
    std::vector<std::string> remarks;
    for (const std::string& remark : fit.remarks) remarks.push_back(toml_string(remark));
    text += fmt::format("remarks = [{}]\n", fmt::join(remarks, ", "));
  }
  text += "# Model errors, one standard deviation (docs/theory/fit.md), and what chi^2 multiplied them by\n";
  for (const ChiSquaredPart& part : fit.chi_squared_parts) {
    std::string name = part.quantity;
    std::ranges::replace(name, ' ', '_');
    text += fmt::format("inflation_{} = {:.4g}\n", name, part.inflation);
  }
  text += fmt::format("model_error_volume = {}\nmodel_error_shock_velocity = {}\n",
                      errors.zero_pressure_volume, errors.shock_velocity);
  text += fmt::format("model_error_gruneisen = {}\nmodel_error_anharmonic = \"{} J/(mol K^2)\"\n",
                      errors.gruneisen, errors.anharmonic);
  text += fmt::format("model_error_thermal_pressure = {}\nmodel_error_energy = {}\n", errors.thermal_pressure,
                      errors.energy);
  text += fmt::format("model_error_melting_temperature = {}\nmodel_error_latent_heat = {}\n",
                      errors.melting_temperature, errors.latent_heat);
  text += fmt::format("model_error_isotherm_pressure = {}\nmodel_error_isotherm_volume = {}\n",
                      errors.isotherm_pressure, errors.isotherm_volume);
  text += fmt::format("model_error_liquid_density = {}\nmodel_error_vapour_density = {}\n",
                      errors.liquid_density, errors.vapour_density);
  return text;
}

std::string provenance_table(const Fit& fit, const StoreOrigin& origin) {
  std::string text =
      fmt::format("[provenance]\nstore = {}\nstore_sha256 = {}\npotential = {}\n", toml_string(origin.name),
                  toml_string(origin.sha256), toml_string(fit.potential));
  for (const auto& [name, value] : origin.common) {
    if (name != "potential") text += fmt::format("{} = {}\n", name, toml_string(value));
  }
  text += fmt::format("superheated_states_left_out = {}\n", fit.superheated_states);
  for (const auto& [title, counts] :
       {std::pair{"finished_points", &origin.finished}, std::pair{"failed_points", &origin.failed}}) {
    if (counts->empty()) continue;
    text += fmt::format("\n[provenance.{}]\n", title);
    for (const auto& [protocol, count] : *counts) text += fmt::format("{} = {}\n", protocol, count);
  }
  return fmt::format("{}\n{}", text, settings_table(fit));
}

std::string defaults_table(const Fit& fit) {
  std::string text =
      "[defaults]\n# Constants that the simulations do not determine: name of the choice, and its source.\n";
  for (const Constant& constant : fit.constants) {
    if (constant.origin == Origin::by_default) {
      text += fmt::format("{} = {}\n", constant.name, toml_string(constant.source));
    }
  }
  if (fit.fitted_names.empty()) return text;  // a sample has no covariance
  std::vector<std::string> names, units, errors, sources, unknown;
  for (const Constant& constant : fit.constants) {
    if (constant.origin != Origin::by_default) continue;
    if (!(constant.error > 0.0)) {
      unknown.push_back(toml_string(constant.name));
      continue;
    }
    names.push_back(toml_string(constant.name));
    units.push_back(toml_string(constant.unit));
    errors.push_back(fmt::format("{:.4e}", constant.error));
    sources.push_back(toml_string(constant.error_source));
  }
  return text +
         fmt::format(
             "\n[default_errors]\n# One standard deviation of the defaults whose sources give one, errors[i] "
             "in "
             "units[i]: samples draw these, too. No error is known of the others.\nnames = [{}]\nunits = "
             "[{}]\nerrors = [{}]\nsources = [{}]\nunknown = [{}]\n",
             fmt::join(names, ", "), fmt::join(units, ", "), fmt::join(errors, ", "),
             fmt::join(sources, ", "), fmt::join(unknown, ", "));
}

/// Formats the second tier of the errors, for constants that the material takes from its fit.
std::string spread_table(const Fit& fit, const PotentialSpread& spread) {
  std::vector<Eigen::Index> kept;
  std::vector<std::string> names, quoted, units, potentials, deviations;
  for (std::size_t k = 0; k < spread.names.size(); ++k) {
    if (std::ranges::find(fit.fitted_names, spread.names[k]) == fit.fitted_names.end()) continue;
    kept.push_back(static_cast<Eigen::Index>(k));
    names.push_back(spread.names[k]);
    quoted.push_back(toml_string(spread.names[k]));
    units.push_back(toml_string(spread.units[k]));
    deviations.push_back(fmt::format("{:.4e}", std::sqrt(spread.covariance(kept.back(), kept.back()))));
  }
  for (const std::string& potential : spread.potentials) potentials.push_back(toml_string(potential));
  std::string text = fmt::format(
      "\n[potential_spread]\n# Second tier: scatter of the constants over potentials of the element, not "
      "contained in "
      "[covariance].\npotentials = [{}]\nnames = [{}]\nunits = [{}]\nstandard_deviation = [{}]\n",
      fmt::join(potentials, ", "), fmt::join(quoted, ", "), fmt::join(units, ", "),
      fmt::join(deviations, ", "));
  return text + matrix_table("potential_spread.matrix", names, spread.covariance(kept, kept),
                             [](double value) { return fmt::format("{:.6e}", value); });
}

}  // namespace

StoreOrigin store_origin(const std::filesystem::path& store, std::span<const md::PointRecord> points) {
  StoreOrigin origin;
  origin.name = store.filename().string();
  origin.sha256 = whipple::sha256_of_file(store);
  std::map<std::string, std::set<std::string>> values;
  int finished = 0;
  for (const md::PointRecord& point : points) {
    ++(point.done() ? origin.finished : origin.failed)[point.protocol];
    if (!point.done()) continue;
    ++finished;
    for (const auto& [name, value] : point.provenance) values[name].insert(value);
  }
  for (const auto& [name, found] : values) {
    if (found.size() != 1 || name == "lammps_commands") continue;  // kept in the database only
    const bool everywhere =
        std::all_of(points.begin(), points.end(), [&, key = name](const md::PointRecord& point) {
          return !point.done() || point.provenance.contains(key);
        });
    if (everywhere && finished > 0) origin.common[name] = *found.begin();
  }
  return origin;
}

std::string strength_and_failure(const std::filesystem::path& material) {
  std::istringstream lines(whipple::material_text(material));
  std::string text;
  std::string pending;  // comments and blank lines, written before the line that follows
  bool copying = false;
  for (std::string line; std::getline(lines, line);) {
    const std::string_view table = opened_table(line);
    if (!table.empty()) copying = table == "strength" || table == "failure";
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string::npos || line[first] == '#') {
      pending += line + "\n";
      continue;
    }
    if (copying) text += pending + line + "\n";
    pending.clear();
  }
  const std::size_t begin = text.find_first_not_of('\n');
  return begin == std::string::npos ? std::string() : text.substr(begin);
}

bool has_strength(const std::filesystem::path& material) {
  struct Strength {
    std::string model;
  };
  input::Document document = input::Document::from_text(whipple::material_text(material), material.string());
  std::optional<input::Table> table = document.root().optional_table("strength");
  Strength strength;
  return table &&
         table->read(ParameterTable<Strength>{text("model", &Strength::model, "law of strength")},
                     strength) &&
         strength.model != "none";
}

std::optional<std::filesystem::path> default_template(const elements::ElementDefaults& table) {
  if (!table.template_name) return std::nullopt;
  const std::string file = *table.template_name + ".toml";
  std::vector<std::string> names;
  for (const std::filesystem::path& folder : library_folders()) {
    if (std::filesystem::exists(folder / file)) return folder / file;
    names.push_back(folder.string());
  }
  throw InputError(
      fmt::format("no material '{}' to take strength and failure from (searched: {}); name one with "
                  "--template",
                  file, fmt::join(names, ", ")));
}

std::string material_text(const Fit& fit, const StoreOrigin& origin,
                          const std::optional<std::filesystem::path>& template_file,
                          const std::optional<PotentialSpread>& spread) {
  const std::string metal = elements::element_defaults(fit.element, fit.settings.defaults).metal;
  const bool gray = fit.model == FitModel::gray;
  std::string text = comment_lines(sources_table(fit));
  text += fmt::format("\nname = \"{} ({} fitted to molecular dynamics, {})\"\n", metal,
                      gray ? "GRAY" : name_of(fit.model), origin.name);
  std::vector<std::string> tables;
  for (const std::filesystem::path& table : fit.settings.measured) tables.push_back(table.stem().string());
  const std::string measured =
      tables.empty() ? "" : fmt::format(" together with measurements ({})", fmt::join(tables, ", "));
  text +=
      fmt::format("source = {}\n", toml_string(fmt::format("whipple fit of {}{}; interatomic potential {}",
                                                           origin.name, measured, fit.potential)));
  text += fmt::format(
      "note = \"solid from molecular dynamics{}; {}{}\"\n\n", tables.empty() ? "" : " and measurements",
      gray ? "electrons, liquid and vapour from the named defaults as far as not fitted; " : "",
      template_file ? "strength and failure as in " + template_file->filename().string()
                    : "without strength and failure: a fluid");
  text +=
      fmt::format("[eos]\nmodel = \"{}\"\n", fit.correction ? eos::CorrectedGray::name : name_of(fit.model));
  text +=
      fmt::format("source = {}\n",
                  toml_string(fmt::format(
                      "fitted: weighted least squares, {} (docs/theory/fit.md); the rest: table [defaults]",
                      origin.name)));
  for (const Constant& constant : fit.constants) text += constant_line(constant);
  for (const auto& [name, word] : fit.words) text += fmt::format("{} = {}\n", name, toml_string(word));
  if (fit.correction)
    text +=
        correction_lines(fit.correction->common, "common") + correction_lines(fit.correction->fluid, "fluid");
  text += "\n";
  text += template_file ? strength_and_failure(*template_file)
                        : fmt::format(
                              "[strength]\nmodel = \"none\"\nnote = \"the table of {} names no template to "
                              "take strength and "
                              "failure from; whipple fit --template FILE names one\"\n",
                              fit.element);
  // Constants of corrected free energies are not varied alone: their errors are those of the correction.
  const std::string covariance = fit.correction ? "" : covariance_table(fit);
  text += fmt::format("\n{}{}\n{}", covariance.empty() ? covariance : covariance + "\n",
                      provenance_table(fit, origin), defaults_table(fit));
  if (fit.joint && !covariance.empty()) text += coverage_tables(*fit.joint);
  return spread && !covariance.empty() ? text + spread_table(fit, *spread) : text;
}

void write_file(const std::filesystem::path& path, const std::string& text, bool force) {
  require_new_file(path, force);
  if (path.has_parent_path()) make_folder(path.parent_path());
  write_text_atomically(path, text);
}

}  // namespace whipple::fit

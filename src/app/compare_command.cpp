// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/compare_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "eos/curves/samples.hpp"
#include "eos/curves/table.hpp"
#include "eos/experiments/calibration.hpp"
#include "eos/experiments/comparison.hpp"
#include "src/app/compare_calibration.hpp"
#include "src/app/completion_command.hpp"
#include "src/app/eos_figure.hpp"
#include "src/app/eos_options.hpp"
#include "src/app/eos_remarks.hpp"
#include "src/app/eos_table.hpp"
#include "src/core/base/csv.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/json.hpp"
#include "src/core/base/text_table.hpp"
#include "src/core/process/paths.hpp"
#include "src/core/process/scripts.hpp"
#include "src/material/material_coverage.hpp"
#include "src/material/material_file.hpp"

namespace whipple::app {
namespace {

using eos::experiments::Comparison;
using eos::experiments::Experiment;
using eos::experiments::ExperimentKind;
using eos::experiments::same_density;
using eos::experiments::VolumeScale;

struct CompareOptions {
  std::vector<std::string> materials;
  std::vector<std::string> experiments;
  std::string temperature;
  std::string csv;
  std::string plot;
  CalibrationOptions calibration;
  bool force = false;
};

/// Describes how experiments of a kind are printed.
struct Style {
  const char* kind;
  const char* deviation;  ///< unit of the deviations
  double deviation_size;  ///< value of that unit in SI or percent
  eos::curves::Column abscissa, ordinate;
};

Style style(const Experiment& experiment) {
  using eos::curves::plain_column;
  using eos::curves::quantity_column;
  const auto pressure = quantity_column("P", "GPa", "Pa", "pressure");
  const auto temperature = quantity_column("T", "K", "K", "temperature");
  const auto volume = experiment.volume == VolumeScale::density
                          ? quantity_column("rho", "g/cm^3", "kg/m^3", "density")
                          : plain_column("V/V0", "relative volume");
  switch (experiment.kind) {
    case ExperimentKind::shock_velocity:
      return {"Hugoniot", "% of Us", 1.0, quantity_column("up", "km/s", "m/s", "particle velocity"),
              quantity_column("Us", "km/s", "m/s", "shock velocity")};
    case ExperimentKind::shock_pressure:
      return {"Hugoniot", "GPa", pressure.size, volume, pressure};
    case ExperimentKind::isotherm:
      return {"isotherm", "GPa", pressure.size, volume, pressure};
    case ExperimentKind::melting:
      return {"melting line", "% of T", 1.0, pressure, temperature};
    case ExperimentKind::shock_temperature:
      return {"Hugoniot", "% of T", 1.0, pressure, temperature};
    case ExperimentKind::isentrope:
      return {"isentrope", "GPa", pressure.size, volume, pressure};
    case ExperimentKind::sound_speed:
      return {"sound speed", "% of c", 1.0, pressure,
              quantity_column("c", "km/s", "m/s", "bulk sound speed")};
    case ExperimentKind::heat_capacity:
      return {"heat capacity", "% of c_p", 1.0, temperature,
              quantity_column("c_p", "J/(kg K)", "J/(kg K)", "heat capacity")};
    case ExperimentKind::expansion:
      return {"linear expansion", "% of alpha", 1.0, temperature,
              quantity_column("alpha_lin", "1/MK", "1/K", "linear thermal expansion")};
  }
  throw InternalError("unknown kind of experiment");
}

/// Returns the temperatures of isotherms, " 298 K" or " 300 ... 1500 K"; empty for other kinds.
std::string temperatures_of(const Experiment& experiment) {
  if (experiment.kind != ExperimentKind::isotherm) return "";
  if (std::isfinite(experiment.temperature)) return fmt::format(" {:g} K", experiment.temperature);
  const auto [least, most] = std::ranges::minmax(experiment.temperatures);
  return fmt::format(" {:g} ... {:g} K", least, most);
}

struct Row {
  const Experiment* experiment;
  const Material* material;
  std::string label;  ///< of the material
  Comparison comparison;
};

/// Formats line numbers as ranges: "line 4", "lines 2, 5-9".
std::string line_ranges(std::vector<int> lines) {
  std::ranges::sort(lines);
  const auto repeated = std::ranges::unique(lines);
  lines.erase(repeated.begin(), repeated.end());
  std::string text = lines.size() == 1 ? "line" : "lines";
  for (std::size_t i = 0, end = 0; i < lines.size(); i = end) {
    for (end = i + 1; end < lines.size() && lines[end] == lines[end - 1] + 1;) ++end;
    text += fmt::format("{} {}", i == 0 ? "" : ",", lines[i]);
    if (end > i + 1) text += fmt::format("-{}", lines[end - 1]);
  }
  return text;
}

void print_table(const std::vector<Row>& rows) {
  std::vector<std::vector<std::string>> cells = {
      {"experiment", "kind", "material", "points", "range", "rms", "mean", "largest", "unit"}};
  for (const Row& row : rows) {
    const Experiment& experiment = *row.experiment;
    const Style s = style(experiment);
    const std::string kind = s.kind + temperatures_of(experiment);
    const auto figure = [&](double value) { return fmt::format("{:.2f}", value / s.deviation_size); };
    const auto signed_figure = [&](double value) { return fmt::format("{:+.2f}", value / s.deviation_size); };
    const bool any = row.comparison.points > 0;
    cells.push_back({experiment.name, kind, row.label, fmt::format("{}", row.comparison.points),
                     fmt::format("{} {:.3g} ... {:.3g}{}{}", s.abscissa.name,
                                 experiment.abscissa.front() / s.abscissa.size,
                                 experiment.abscissa.back() / s.abscissa.size,
                                 s.abscissa.unit.empty() ? "" : " ", s.abscissa.unit),
                     any ? figure(row.comparison.rms) : "-", any ? signed_figure(row.comparison.mean) : "-",
                     any ? signed_figure(row.comparison.maximum) : "-", s.deviation});
  }
  fmt::print("{}", text_table(cells, "lllrlrrrl"));
  fmt::print("deviations: material less experiment\n");
  const Experiment* last = nullptr;
  for (const Row& row : rows) {
    const Experiment& experiment = *row.experiment;
    const auto note = [&](const std::vector<int>& lines, const std::string& what) {
      if (!lines.empty()) fmt::print("{}: {} {}\n", experiment.name, line_ranges(lines), what);
    };
    if (&experiment != last) {
      for (const auto& [reason, lines] : experiment.left_out) note(lines, "left out: " + reason);
      for (const std::string& remark : experiment.remarks) fmt::print("{}: {}\n", experiment.name, remark);
    }
    last = &experiment;
    const Comparison& c = row.comparison;
    note(c.porous,
         fmt::format("compared with the porous Hugoniot of {} from the initial density given", row.label));
    note(c.denser, fmt::format("initially denser than {} by more than {:g} %, compared as of its density",
                               row.label, 100 * same_density));
    note(c.out_of_range, fmt::format("not counted: outside of the range of {}", row.label));
  }
}

/// Prints how well the fit of each material predicted the curves that it did not see.
void print_coverage(const std::vector<Material>& materials) {
  std::vector<std::vector<std::string>> cells = {{"material", "curve that its fit did not see", "points",
                                                  "within 68 %", "95 %", "half-width of 95 %", "rms"}};
  for (const Material& material : materials) {
    for (const Coverage& row : coverage_of(material)) {
      cells.push_back(
          {material.file.stem().string(), row.curve, fmt::format("{}", row.points),
           fmt::format("{:.0f} %", 100 * row.inside_68), fmt::format("{:.0f} %", 100 * row.inside_95),
           fmt::format("{:.2f} %", 100 * row.half_width_with_form), fmt::format("{:.2f} %", 100 * row.rms)});
    }
  }
  if (cells.size() > 1) fmt::print("\n{}", text_table(cells, "llr"));
}

std::string csv_text(const std::vector<Row>& rows) {
  std::ostringstream file;
  file << "# whipple compare: measured points compared with equations of state\n"
          "experiment,material,abscissa,abscissa_value,abscissa_unit,ordinate,measured,model,ordinate_unit,"
          "deviation,"
          "deviation_unit\n";
  for (const Row& row : rows) {
    const Experiment& experiment = *row.experiment;
    const Style s = style(experiment);
    const std::string name = csv_cell(experiment.name);
    for (std::size_t i = 0; i < experiment.abscissa.size(); ++i) {
      file << fmt::format("{},\"{}\",{},{:.8g},{},{},{:.8g},{:.8g},{},{:.6g},{}\n", name, row.label,
                          s.abscissa.name, experiment.abscissa[i] / s.abscissa.size, s.abscissa.unit,
                          s.ordinate.name, experiment.ordinate[i] / s.ordinate.size,
                          row.comparison.model[i] / s.ordinate.size, s.ordinate.unit,
                          row.comparison.deviation[i] / s.deviation_size, s.deviation);
    }
  }
  return file.str();
}

/// Converts values to JSON, which has no NaN: out-of-range points become null.
nlohmann::json numbers(const std::vector<double>& values, double size) {
  nlohmann::json list = nlohmann::json::array();
  for (const double value : values) {
    list.push_back(std::isnan(value) ? nlohmann::json() : nlohmann::json(value / size));
  }
  return list;
}

/// Returns the points of curves through groups of measured points: those of one initial density, or of one isotherm.
/// Groups are separated by a point without a value. Groups that are too many to be distinguished in a figure have no
/// curves.
eos::experiments::CurvePoints curve_points(const Material& material, const Experiment& experiment,
                                           int count) {
  constexpr std::size_t most_groups = 12;
  const std::vector<double> stated = initial_densities(material.reference.density, experiment);
  const bool by_temperature = experiment.kind == ExperimentKind::isotherm;
  std::map<double, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < stated.size(); ++i) {
    const double value = by_temperature ? experiment.temperatures[i] : stated[i];
    auto group = groups.lower_bound(value * (1.0 - same_density));
    if (group == groups.end() || group->first > value * (1.0 + same_density))
      group = groups.emplace(value, std::vector<std::size_t>()).first;
    group->second.push_back(i);
  }
  eos::experiments::CurvePoints points;
  if (groups.size() > most_groups) return points;
  for (const auto& [value, members] : groups) {
    const double least = experiment.abscissa[members.front()], most = experiment.abscissa[members.back()];
    for (int i = 0; i < count; ++i) points.abscissa.push_back(least + (most - least) * i / (count - 1));
    points.abscissa.push_back(std::numeric_limits<double>::quiet_NaN());
    points.initial_density.resize(points.abscissa.size(), stated[members.front()]);
    points.temperature.resize(points.abscissa.size(), experiment.temperatures[members.front()]);
  }
  return points;
}

/// Computes the limits of the 95 % band of a fitted material at some points: the curve of the material plus and minus
/// two standard deviations of its samples; no value where half of the samples have none.
std::pair<std::vector<double>, std::vector<double>> band(const Row& row, const MaterialSamples& samples,
                                                         const std::vector<double>& central,
                                                         const eos::experiments::CurvePoints& points) {
  std::vector<eos::curves::Scatter> at(central.size());
  for (const auto& [eos, initial] : states_at_rest(samples)) {
    const std::vector<double> values = curve(*eos, initial, *row.experiment, points);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::isfinite(values[i])) at[i].add(values[i]);
    }
  }
  std::vector<double> lower = central, upper = central;
  for (std::size_t i = 0; i < central.size(); ++i) {
    const bool known = 2 * at[i].count() > static_cast<int>(samples.materials.size());
    const double width = known ? eos::experiments::half_width_95 * at[i].deviation()
                               : std::numeric_limits<double>::quiet_NaN();
    lower[i] -= width;
    upper[i] += width;
  }
  return {lower, upper};
}

void draw(const std::vector<Row>& rows, const DrawnMaterials& drawn, const std::string& path) {
  nlohmann::json panels = nlohmann::json::array();
  const Experiment* last = nullptr;
  for (const Row& row : rows) {
    const Experiment& experiment = *row.experiment;
    const Style s = style(experiment);
    if (&experiment != last) {
      panels.push_back({{"experiment", experiment.name},
                        {"source", experiment.source},
                        {"kind", s.kind + temperatures_of(experiment)},
                        {"abscissa", s.abscissa.name},
                        {"abscissa_unit", s.abscissa.unit},
                        {"ordinate", s.ordinate.name},
                        {"ordinate_unit", s.ordinate.unit},
                        {"deviation_unit", s.deviation},
                        {"x", numbers(experiment.abscissa, s.abscissa.size)},
                        {"measured", numbers(experiment.ordinate, s.ordinate.size)},
                        {"materials", nlohmann::json::array()}});
      last = &experiment;
    }
    const Material& material = *row.material;
    const auto samples = drawn.find(&material);
    const auto points = curve_points(material, experiment, samples == drawn.end() ? 200 : 40);
    const std::vector<double> central = curve(*material.eos, material.reference, experiment, points);
    nlohmann::json entry = {{"name", row.label},
                            {"x", numbers(points.abscissa, s.abscissa.size)},
                            {"curve", numbers(central, s.ordinate.size)},
                            {"deviation", numbers(row.comparison.deviation, s.deviation_size)},
                            {"rms", row.comparison.rms / s.deviation_size}};
    if (samples != drawn.end()) {
      const auto [lower, upper] = band(row, samples->second, central, points);
      entry["lower"] = numbers(lower, s.ordinate.size);
      entry["upper"] = numbers(upper, s.ordinate.size);
    }
    panels.back()["materials"].push_back(std::move(entry));
  }
  // File names need not be UTF-8.
  process::draw_json("scripts/plot_compare.py", json_text(panels, 1), path);
}

bool belongs_to(const Experiment& experiment, const Material& material) {
  return eos::experiments::belongs_to(experiment, material.name) ||
         eos::experiments::belongs_to(experiment, material.file.stem().string());
}

void run(const CompareOptions& options) {
  if (!is_standard_output(options.csv)) require_new_file(options.csv, options.force);
  require_new_file(options.calibration.csv, options.force);
  if (!options.calibration.csv.empty() && options.calibration.samples == 0) {
    throw InputError("--calibration: give the number of samples with --samples");
  }
  require_new_figure(options.plot, options.force);
  const std::optional<double> temperature = quantity("--temperature", options.temperature, "K");
  std::vector<Material> materials;
  for (const std::string& name : options.materials) {
    materials.push_back(read_material(name));
    refuse_foam(materials.back());
  }
  std::vector<Experiment> experiments;
  for (const std::string& name : options.experiments) {
    std::ranges::move(eos::experiments::read_experiments(process::find_experiment(name), temperature),
                      std::back_inserter(experiments));
  }
  std::vector<Row> rows;
  for (const Experiment& experiment : experiments) {
    for (const Material& material : materials) {
      // A file for one material is compared only with that material: copper data are not compared with aluminium. A
      // material that no file names is compared with all files.
      const bool of_others = std::ranges::any_of(experiments, [&](const Experiment& other) {
        return !other.material.empty() && belongs_to(other, material);
      });
      if ((of_others || experiment.only_its_material) && !belongs_to(experiment, material)) continue;
      rows.push_back({&experiment, &material, material.file.stem().string(),
                      compare(*material.eos, material.reference, experiment)});
    }
  }
  if (rows.empty()) throw InputError("none of the data is of one of the materials");
  const bool csv_alone = is_standard_output(options.csv);
  if (!csv_alone) {
    print_table(rows);
    print_coverage(materials);
  }
  write_output(options.csv, csv_text(rows));
  DrawnMaterials drawn;
  if (options.calibration.samples > 0) {
    std::vector<CalibratedPair> pairs;
    for (const Row& row : rows) pairs.push_back({row.experiment, row.material, row.label});
    drawn = draw_fitted(pairs, options.calibration);
    const std::string report = calibration_report(pairs, drawn, options.calibration);
    if (!csv_alone) fmt::print("{}", report);
  }
  if (options.plot.empty()) return;
  draw(rows, drawn, options.plot);
  if (!csv_alone) fmt::print("written: {}\n", options.plot);
}

}  // namespace

void add_compare_command(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand("compare",
                                         "Compare equations of state with measured Hugoniots, isotherms, "
                                         "isentropes, sound speeds and melting lines");
  offer_materials(
      command->add_option("materials", options->materials, "Material files, or names of the library")
          ->required());
  command
      ->add_option("--with", options->experiments,
                   "Tables of measurements (docs/manual/equations_of_state.md), or names of those that come "
                   "with the program (eos/data); a "
                   "material that some of them were measured on is compared with those only")
      ->required();
  command->add_option("--temperature", options->temperature,
                      "Temperature of the isotherms (default: that of the file)");
  command->add_option("--csv", options->csv,
                      "Write every point with its deviation; -: to standard output, and nothing else");
  command->add_option("--plot", options->plot, "Figure of curves, points and deviations, FILE.png");
  command
      ->add_option("--samples", options->calibration.samples,
                   "Draw so many sets of constants of each material, which must be a fitted one: width of "
                   "its 95 % band, "
                   "and the fraction of the points inside")
      ->check(CLI::Range(2, 100000));
  command->add_option("--seed", options->calibration.seed, "Of the draws")->capture_default_str();
  command->add_option("--tier", options->calibration.tier, tier_help)
      ->check(CLI::IsMember(word_list<ErrorTier>()))
      ->capture_default_str();
  command->add_option("--calibration", options->calibration.csv,
                      "With --samples: write every point with its errors, FILE.csv");
  command->add_flag("--force", options->force, "Overwrite existing files");
  command->footer(
      "Example:\n  whipple compare copper copper_md_liu2013 --with cu_hugoniot_marsh1980 "
      "cu_isotherm_298K_dewaele2004 "
      "--plot copper.png");
  command->callback([options] { run(*options); });
}

}  // namespace whipple::app

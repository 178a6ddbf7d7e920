// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/eos_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "eos/audit.hpp"
#include "eos/curves/diagrams.hpp"
#include "eos/curves/samples.hpp"
#include "eos/curves/tables.hpp"
#include "eos/experiments/calibration.hpp"
#include "src/app/completion_command.hpp"
#include "src/app/eos_audit.hpp"
#include "src/app/eos_card_command.hpp"
#include "src/app/eos_figure.hpp"
#include "src/app/eos_options.hpp"
#include "src/app/eos_queries.hpp"
#include "src/app/eos_remarks.hpp"
#include "src/app/eos_table.hpp"
#include "src/app/eos_tabulate.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"
#include "src/material/material_file.hpp"
#include "src/material/material_samples.hpp"

namespace whipple::app {
namespace {

using eos::curves::Column;
using eos::curves::column_index;
using eos::curves::CurveRow;
using eos::curves::CurveTable;
using eos::curves::DiagramKind;
using eos::curves::Figure;
using eos::curves::FigureCurve;
using eos::curves::Series;
using eos::curves::Subjects;

/// Describes the outputs of a table in addition to the terminal.
struct Output {
  std::string csv;
  std::string plot;
  std::string x, y;                  ///< columns of the figure
  std::string logarithmic;           ///< "x", "y", "xy" or nothing
  std::vector<std::string> overlay;  ///< measurements
  bool json = false;                 ///< print the table as JSON to standard output, and nothing else
  bool force = false;

  [[nodiscard]] bool alone() const { return json || is_standard_output(csv); }
};

/// Holds the options for samples drawn from the covariance of a fitted material.
struct SampleOptions {
  int count = 0;
  std::uint64_t seed = 1;
  std::string tier{word_of(ErrorTier::fit)};
  std::string release_pressure = "100 kPa";
};

struct Request {
  std::vector<std::string> materials;
  EosOptions options;
  SampleOptions samples;  ///< of the Hugoniot
  Output output;
};

Subjects read_subjects(const std::vector<std::string>& names) {
  std::vector<Material> materials;
  for (const std::string& name : names) materials.push_back(read_material(name));
  return subjects_of(materials);
}

/// Plots one column of a table against another, with one curve for each material.
Figure figure_of(const CurveTable& table, const Output& output) {
  const std::size_t x = column_index(table, output.x), y = column_index(table, output.y);
  Figure figure;
  figure.title = table.title;
  figure.x = table.columns[x];
  figure.y = table.columns[y];
  figure.logarithmic_x = output.logarithmic.find('x') != std::string::npos;
  figure.logarithmic_y = output.logarithmic.find('y') != std::string::npos;
  for (const Series& series : table.series) {
    FigureCurve curve;
    curve.label = "equation of state";
    curve.material = series.name;
    curve.colour = static_cast<int>(figure.curves.size());
    for (const CurveRow& row : series.rows) {
      const double* a = std::get_if<double>(&row[x]);
      const double* b = std::get_if<double>(&row[y]);
      if (a == nullptr || b == nullptr) throw InputError("--x, --y: a column of words makes no curve");
      curve.x.push_back(*a / figure.x.size);
      curve.y.push_back(*b / figure.y.size);
    }
    figure.curves.push_back(std::move(curve));
  }
  add_measurements(figure, output.overlay);
  return figure;
}

void write(const CurveTable& table, const Output& output) {
  write_output(output.csv, csv_text(table));
  if (!output.plot.empty()) draw(figure_of(table, output), output.plot);
}

void warn_of_ends(const CurveTable& table) {
  for (const Series& series : table.series) {
    if (series.end.empty()) continue;
    log::warning("{}: the curve ends after {} points: {}", series.name, series.rows.size(), series.end);
  }
}

/// Warns of states above the maximum temperature of the audit: a model returns values wherever its formulas are
/// defined, also where they are not valid.
void warn_beyond_audit(const CurveTable& table, const Subjects& subjects) {
  const auto column = std::ranges::find(table.columns, "T_K", &Column::name);
  if (column == table.columns.end() || table.series.size() != subjects.size()) return;
  const auto place = static_cast<std::size_t>(column - table.columns.begin());
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    double hottest = 0;
    for (const CurveRow& row : table.series[i].rows)
      hottest = std::fmax(hottest, std::get<double>(row[place]));
    const double limit = eos::audit(*subjects[i].eos, eos::AuditDepth::brief).range.greatest_temperature;
    if (limit > 0 && hottest > limit) {
      log::warning(
          "{}: {:.6g} K is beyond {:.4g} K, to which the audit finds the model valid (whipple eos audit)",
          subjects[i].name, hottest, limit);
    }
  }
}

/// Makes the figure of a sampled Hugoniot: the curves of all materials, and the 95 % band of the fitted one.
Figure figure_with_band(const Request& request, const Subjects& subjects, std::size_t fitted,
                        const eos::curves::SampledHugoniot& sampled, const eos::curves::CurveRange& range) {
  constexpr double half_width = eos::experiments::half_width_95;
  const CurveTable own = hugoniot_table(subjects, {}, {}, eos::curves::Variable::particle_velocity, range);
  const bool is_of_one =
      std::ranges::find(own.columns, request.output.y, &eos::curves::Column::name) != own.columns.end();
  Figure figure = figure_of(is_of_one ? own : sampled.table, request.output);
  const std::size_t y = column_index(sampled.table, request.output.y);
  FigureCurve& central = figure.curves[is_of_one ? fitted : 0];
  if (!is_of_one) central.label = "mean of the samples";
  eos::curves::FigureBand band{"95 % band", {}, {}, {}, central.colour};
  const auto& rows = sampled.table.series.front().rows;
  for (std::size_t i = 0; i < std::min(rows.size(), central.y.size()); ++i) {
    const double width = half_width * std::get<double>(rows[i][y + 1]) / figure.y.size;
    band.x.push_back(central.x[i]);
    band.lower.push_back(central.y[i] - width);
    band.upper.push_back(central.y[i] + width);
  }
  figure.bands.push_back(std::move(band));
  return figure;
}

/// Prints and draws the scatter of the Hugoniots of a fitted material; further materials are drawn for comparison.
void run_samples(const Request& request) {
  std::vector<Material> materials;
  for (const std::string& name : request.materials) materials.push_back(read_material(name));
  const auto fitted = std::ranges::find_if(materials, has_covariance);
  if (fitted == materials.end()) {
    throw InputError(
        fmt::format("{} has no table [covariance]: only a fitted material can be sampled (whipple fit)",
                    materials.front().file.string()));
  }
  if (std::ranges::count_if(materials, has_covariance) > 1)
    throw InputError("--samples: one fitted material at a time; others may be drawn next to it");
  const EosOptions& o = request.options;
  const double last = quantity("--to", o.to, "m/s").value_or(4000.0);
  const double first = quantity("--from", o.from, "m/s").value_or(last / o.points);
  const double release_pressure = *quantity("--release-pressure", request.samples.release_pressure, "Pa");
  const MaterialSamples drawn = sample_material(fitted->file, request.samples.count, request.samples.seed,
                                                value_of<ErrorTier>(request.samples.tier).value());
  const eos::curves::SampledHugoniot sampled = eos::curves::sampled_hugoniot(
      subjects_of(drawn.materials), eos::curves::spaced(first, last, o.points), release_pressure);
  const Output& output = request.output;
  if (output.json) fmt::print("{}", table_as_json(sampled.table));
  if (!output.alone()) print(sampled.table);
  write_output(output.csv, csv_text(sampled.table));
  if (!output.plot.empty()) {
    draw(figure_with_band(request, subjects_of(materials),
                          static_cast<std::size_t>(fitted - materials.begin()), sampled,
                          {first, last, o.points}),
         output.plot);
  }
  if (output.alone()) return;
  for (const std::string& remark : sample_remarks(sampled, drawn.materials.size()))
    fmt::print("{}\n", remark);
  for (const std::string& remark : drawn_remarks(drawn)) fmt::print("{}\n", remark);
  if (drawn.refused > 0) {
    fmt::print("{} draws of which the model makes no material were replaced by others\n", drawn.refused);
  }
}

void add_query(CLI::App& command, const EosQuery& query) {
  auto request = std::make_shared<Request>();
  CLI::App* sub = command.add_subcommand(query.name, query.summary);
  offer_materials(sub->add_option("materials", request->materials, "Material files, or names of the library")
                      ->required());
  add_quantities(*sub, query.quantities, request->options);
  sub->add_option(
      "--csv", request->output.csv,
      "Write the table, units in the names of the columns; -: to standard output, and nothing else");
  sub->add_flag("--json", request->output.json, "The table as JSON to standard output, and nothing else")
      ->excludes(sub->get_option("--csv"));
  if (query.x != nullptr) {
    sub->add_option("--points", request->options.points, "Points of the curve")
        ->check(CLI::Range(2, 100000))
        ->capture_default_str();
    sub->add_option("--plot", request->output.plot, "Figure, FILE.png, .pdf or .svg");
    request->output.x = query.x;
    request->output.y = query.y;
    sub->add_option("--x", request->output.x, "Column along the figure")->capture_default_str();
    sub->add_option("--y", request->output.y, "Column up the figure")->capture_default_str();
    sub->add_option("--log", request->output.logarithmic, "Logarithmic axes")
        ->check(CLI::IsMember({"x", "y", "xy"}));
    sub->add_option("--with", request->output.overlay,
                    "Measurements drawn as points: CSV files, or names of those that come with the program "
                    "(eos/data)");
  }
  if (query.with_samples) {
    sub->add_option(
           "--samples", request->samples.count,
           "Draw so many sets of constants from the covariance of a fitted material: mean and standard "
           "deviation of the Hugoniot, of fractions after release, and of the thresholds of melting")
        ->check(CLI::Range(2, 100000));
    sub->add_option("--seed", request->samples.seed, "Of the draws")->capture_default_str();
    sub->add_option("--tier", request->samples.tier, tier_help)
        ->check(CLI::IsMember(word_list<ErrorTier>()))
        ->capture_default_str();
    sub->add_option("--release-pressure", request->samples.release_pressure,
                    "With --samples: end of the releases")
        ->capture_default_str();
  }
  sub->add_flag("--force", request->output.force, "Overwrite existing files");
  sub->footer(fmt::format("Example:\n  {}", query.example));
  sub->callback([request, &query] {
    const Output& output = request->output;
    if (!is_standard_output(output.csv)) require_new_file(output.csv, output.force);
    require_new_figure(output.plot, output.force);
    if (request->samples.count > 0) return run_samples(*request);
    const Subjects subjects = read_subjects(request->materials);
    const CurveTable table = query.table(request->options, subjects);
    warn_of_ends(table);
    const bool one_each =
        std::ranges::all_of(table.series, [](const Series& s) { return s.rows.size() == 1; });
    const bool is_list = query.as_list && one_each;
    if (output.json) fmt::print("{}", table_as_json(table));
    if (!output.alone()) (is_list ? print_list : print)(table);
    write(table, output);
    warn_beyond_audit(table, subjects);
    if (query.remarks == nullptr || output.alone() || !request->options.states.empty()) return;
    for (const std::string& remark : query.remarks(request->options, subjects)) fmt::print("{}\n", remark);
  });
}

void add_audit(CLI::App& command) {
  auto name = std::make_shared<std::string>();
  CLI::App* audit = command.add_subcommand(
      "audit", "Is the equation of state sound, and where: limits, stability, identities, verdict");
  offer_materials(audit->add_option("material", *name, "Material file, or name of the library")->required());
  audit->footer("Example:\n  whipple eos audit copper");
  audit->callback([name] { print_audit(read_material(*name), eos::AuditDepth::full); });
}

void add_plot(CLI::App& command) {
  static const std::vector<std::pair<std::string, DiagramKind>> kinds = {
      {"us-up", DiagramKind::shock_velocity},
      {"p-v", DiagramKind::pressure_volume},
      {"p-t", DiagramKind::pressure_temperature},
      {"p-rho", DiagramKind::pressure_density}};
  struct Plot : Request {
    std::string kind;
    std::vector<std::string> releases;
  };
  auto plot = std::make_shared<Plot>();
  CLI::App* sub =
      command.add_subcommand("plot", "Diagrams of several loci, with phase boundaries and measurements");
  offer_materials(
      sub->add_option("materials", plot->materials, "Material files, or names of the library")->required());
  sub->add_option(
         "--kind", plot->kind,
         "us-up: Hugoniots and their melting range; p-v: Hugoniot, isotherm, cold curve; p-t: solidus, "
         "liquidus, Hugoniot, isentrope, releases; p-rho: Hugoniot, releases, liquid and vapour")
      ->required()
      ->check(CLI::IsMember(kinds));
  sub->add_option("-o,--output", plot->output.plot, "FILE.png, .pdf or .svg")->required();
  sub->add_option("--to", plot->options.to, "Greatest pressure (default 200 GPa)");
  sub->add_option("--release", plot->releases, "Shock pressures to release from, e.g. '100 GPa' '150 GPa'");
  sub->add_option("--with", plot->output.overlay, "Measurements, as for the curves");
  sub->add_flag("--force", plot->output.force, "Overwrite existing files");
  sub->footer("Example:\n  whipple eos plot copper --kind p-t --to '300 GPa' -o copper_p_t.png");
  sub->callback([plot] {
    require_new_figure(plot->output.plot, plot->output.force);
    const double greatest = quantity("--to", plot->options.to, "Pa").value_or(200e9);
    std::vector<double> releases;
    for (const std::string& text : plot->releases) releases.push_back(*quantity("--release", text, "Pa"));
    const DiagramKind kind =
        std::ranges::find(kinds, plot->kind, &std::pair<std::string, DiagramKind>::first)->second;
    Figure figure = eos::curves::diagram(kind, read_subjects(plot->materials), greatest, releases);
    add_measurements(figure, plot->output.overlay);
    draw(figure, plot->output.plot);
  });
}

}  // namespace

void add_eos_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("eos", "States and curves of a material's equation of state");
  command->require_subcommand(1);
  command->footer("Example:\n  whipple eos hugoniot copper --to '300 GPa' --plot hugoniot.png");
  for (const EosQuery& query : eos_queries()) add_query(*command, query);
  add_audit(*command);
  add_plot(*command);
  add_eos_tabulate(*command);
  add_eos_card(*command);
}

}  // namespace whipple::app

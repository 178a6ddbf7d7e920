// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/analyse_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "src/analysis/analyse.hpp"
#include "src/analysis/measures.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/json.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/option_quantity.hpp"
#include "src/core/base/units.hpp"

namespace whipple::app {
namespace {

struct AnalyseOptions {
  std::string run;
  std::string output;
  AnalysisWords words;
};

/// Converts the text of an option to a length > 0; returns 0 for an empty text.
double length(const std::string& text, const char* option) {
  return text.empty() ? 0.0 : option_quantity(option, text, "m", range::positive());
}

/// Prints quantities.csv of a folder as JSON; values that could not be measured are null, with their reason.
void print_quantities_as_json(const std::filesystem::path& folder) {
  nlohmann::ordered_json all = nlohmann::ordered_json::object();
  for (const analysis::Quantity& quantity : analysis::read_quantities(folder)) {
    nlohmann::ordered_json& entry = all[quantity.name];
    entry["value"] = std::isfinite(quantity.value) ? nlohmann::ordered_json(quantity.value) : nullptr;
    entry["unit"] = quantity.unit;
    entry["meaning"] = quantity.meaning;
    if (!quantity.reason.empty()) entry["reason"] = quantity.reason;
  }
  fmt::print("{}\n", json_text(all, 1));
}

}  // namespace

void add_analysis_options(CLI::App& command, AnalysisWords& words) {
  command.add_option("--axis", words.axis, "Axis of the flight (default: along which the bodies approach)")
      ->check(CLI::IsMember({"x", "y", "z"}));
  command.add_option("--link", words.link, "Linking length of fragments (default: 1.5 cells)")
      ->type_name("LENGTH");
  command.add_flag("--by-distance", words.by_distance,
                   "Also pieces by distance alone, failed or not, for links of 1.25, 1.5 and 2 cells");
  command.add_option("--witness", words.witness, "Axial coordinate of a witness plate, e.g. '200 mm'")
      ->type_name("LENGTH");
  command
      .add_option(
          "--loads", words.loads,
          "Loads in the course of the run on the face of a body, or on a plane at an axial coordinate")
      ->type_name("BODY|LENGTH");
  command
      .add_option("--diameter-at", words.diameter_at,
                  "Of a bar against a wall: diameter at this distance from it")
      ->type_name("LENGTH");
  command
      .add_option("--peak-decay", words.peak_decay, "Follow the peak pressure in this body below the impact")
      ->type_name("BODY");
  command.add_option("--pixel", words.pixel, "Of the radiographs (default: half the cell size)")
      ->type_name("LENGTH");
  command.add_option("--spot", words.spot, "Blur of the radiographs, full width at half maximum")
      ->type_name("LENGTH")
      ->capture_default_str();
  command
      .add_option(
          "--attenuation", words.attenuation,
          "Mass attenuation coefficient of a body, e.g. plate='0.138 cm^2/g' (repeatable; default: that)")
      ->type_name("BODY=VALUE")
      ->allow_extra_args(false);
  command.add_option("--radiographs", words.radiographs, "Radiographs at so many times")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
}

void run_analysis(const std::filesystem::path& run, const AnalysisWords& words,
                  const std::filesystem::path& output) {
  analysis::Options options;
  if (!words.axis.empty()) options.axis = words.axis[0] - 'x';
  options.link = length(words.link, "--link");
  options.by_distance = words.by_distance;
  options.pixel = length(words.pixel, "--pixel");
  options.spot = option_quantity("--spot", words.spot, "m", range::non_negative());
  options.diameter_at = length(words.diameter_at, "--diameter-at");
  options.peak_decay = words.peak_decay;
  options.radiographs = words.radiographs;
  options.views = words.views;
  if (!words.witness.empty())
    options.witness = option_quantity("--witness", words.witness, "m", range::any());
  for (const std::string& word : words.attenuation) {
    const std::size_t equal = word.find('=');
    if (equal == std::string::npos || equal == 0) {
      throw InputError(fmt::format("--attenuation is \"{}\", expected BODY='0.2 cm^2/g'", word));
    }
    const std::string body = word.substr(0, equal);
    options.attenuation[body] =
        option_quantity("--attenuation " + body, word.substr(equal + 1), "m^2/kg", range::non_negative());
  }
  const analysis::Run read = analysis::read_run(run);
  const bool is_body =
      std::ranges::find(read.bodies, words.loads, &analysis::BodyInput::name) != read.bodies.end();
  if (is_body) {
    options.loads = words.loads;
  } else if (!words.loads.empty()) {
    try {
      options.loads_at = units::parse_quantity(words.loads, "m");
    } catch (const InputError&) {
      throw InputError(fmt::format("--loads is \"{}\", expected a body of the run or a length", words.loads));
    }
  }
  require_no_file(output);
  analysis::analyse(read, options, output);
}

void add_analyse_command(CLI::App& app) {
  auto options = std::make_shared<AnalyseOptions>();
  CLI::App* command = app.add_subcommand(
      "analyse", "Measures of a run: cloud, fragments, crater, hole, radiographs, witness plate");
  command->add_option("run", options->run, "The run directory")->required();
  command->add_option("-o,--output", options->output,
                      "Folder of the tables (default: report/ in the run directory)");
  add_analysis_options(*command, options->words);
  command
      ->add_option("--views", options->words.views.times,
                   "Views of the cloud at so many times in analysis.h5, for the page of whipple report")
      ->check(CLI::Range(1, 1000));
  command->footer(
      "Example:\n  whipple analyse run/disk --witness '200 mm'\n"
      "Writes quantities.csv, series.csv, bodies.csv, fragments.csv and more, and analysis.h5 with all of "
      "it");
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json,
                    "Print the final values for programs: {name: {value, unit, meaning}} (SI)");
  command->callback([options, json] {
    const std::filesystem::path output =
        std::filesystem::path(options->output.empty() ? options->run + "/report" : options->output);
    run_analysis(options->run, options->words, output);
    if (*json) print_quantities_as_json(output);
    log::info("wrote {}", output.string());
  });
}

}  // namespace whipple::app

// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/measure_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/analysis/requests.hpp"
#include "src/core/base/json.hpp"

namespace whipple::app {
namespace {

struct MeasureOptions {
  std::string run;
  std::vector<std::string> measures;
};

std::string list_of_measures() {
  std::string text = "Measures:\n";
  for (const analysis::RequestedMeasure& one : analysis::requested_measures()) {
    text += fmt::format("  {}.{}", one.kind, one.names);
    if (!one.parameters.empty()) text += fmt::format(" ({})", one.parameters);
    text += fmt::format("\n      {}\n", one.meaning);
  }
  return text;
}

}  // namespace

void add_measure_command(CLI::App& app) {
  auto options = std::make_shared<MeasureOptions>();
  CLI::App* command = app.add_subcommand(
      "measure", "Measures of a run that need names and parameters: of gauges, fracture, jets, profiles");
  command->add_option("run", options->run, "The run directory")->required()->check(CLI::ExistingDirectory);
  command
      ->add_option("measures", options->measures,
                   "Each \"KIND.NAMES KEY=VALUE ...\", e.g. \"jet_speed.liner fraction=1 %\"")
      ->required();
  command->footer(
      list_of_measures() +
      "Example:\n  whipple measure run/charge 'jet_speed.liner fraction=1 %' arrival_speed.front\n"
      "Prints {measure: {value, unit, meaning}} as JSON (SI); the value is null, with a reason, where "
      "there is none");
  command->callback([options] {
    nlohmann::ordered_json all = nlohmann::ordered_json::object();
    for (const std::string& text : options->measures) {
      const analysis::Quantity quantity = analysis::take_on_request(options->run, text);
      nlohmann::ordered_json& entry = all[text];
      entry["value"] = std::isfinite(quantity.value) ? nlohmann::ordered_json(quantity.value) : nullptr;
      entry["unit"] = quantity.unit;
      entry["meaning"] = quantity.meaning;
      if (!quantity.reason.empty()) entry["reason"] = quantity.reason;
    }
    fmt::print("{}\n", json_text(all, 1));
  });
}

}  // namespace whipple::app

// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/eos_tabulate.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "eos/files/table_file.hpp"
#include "src/base/files.hpp"
#include "src/base/progress.hpp"
#include "src/base/text_table.hpp"
#include "src/base/units.hpp"
#include "src/material/material_file.hpp"
#include "src/parallel/threads.hpp"

namespace whipple::app {
namespace {

constexpr std::size_t verification_states = 1000000;

struct Options {
  std::string material, file;
  double error = 1e-4;
  std::vector<std::string> densities, temperatures;
  bool force = false;
};

void run(const Options& o) {
  require_new_file(o.file, o.force);
  const Material material = read_material(o.material);
  eos::TableRequest request;
  request.error = o.error;
  if (!o.densities.empty()) {
    request.minimum_density = units::parse_quantity(o.densities[0], "kg/m^3");
    request.maximum_density = units::parse_quantity(o.densities[1], "kg/m^3");
  }
  if (!o.temperatures.empty()) {
    request.least_temperature = units::parse_quantity(o.temperatures[0], "K");
    request.greatest_temperature = units::parse_quantity(o.temperatures[1], "K");
  }
  const eos::ForEach for_each = [](std::size_t n, const std::function<void(std::size_t)>& body) {
    parallel::for_each_uneven(n, body);
  };
  eos::TableFile file;
  {
    Progress progress("table", 1.0);
    file.data = eos::tabulate(*material.eos, request, for_each,
                              [&](double share) { progress.update(share, material.name); });
  }
  const eos::Table table(file.data);
  {
    Progress progress("verify", 1.0);
    file.verification = eos::verify(table, *material.eos, verification_states, for_each,
                                    [&](double share) { progress.update(share, material.name); });
  }
  eos::write_table(o.file, file);

  fmt::print("Table of {} (model {}): {:.6g} to {:.6g} kg/m^3, {:.6g} to {:.6g} K, {:.0f} kB\n",
             material.name, material.eos->model(), table.minimum_density(), table.maximum_density(),
             request.least_temperature, request.greatest_temperature,
             1e-3 * static_cast<double>(file.data.size()));
  fmt::print("Greatest differences from the model over {} random states; requested {:.2g} in T and p:\n",
             verification_states, request.error);
  std::vector<std::vector<std::string>> rows = {
      {"phase", "states", "T", "p", "c", "mean c", "fractions", "mean fractions"}};
  for (const auto& [phase, e] : file.verification) {
    rows.push_back({phase, fmt::format("{}", e.states)});
    for (const double value :
         {e.temperature, e.pressure, e.sound_speed, e.mean_sound_speed, e.fraction, e.mean_fraction})
      rows.back().push_back(fmt::format("{:.2g}", value));
  }
  fmt::print("{}wrote {}\n", text_table(rows, "lr"), o.file);
}

}  // namespace

void add_eos_tabulate(CLI::App& eos_command) {
  auto o = std::make_shared<Options>();
  CLI::App* command = eos_command.add_subcommand(
      "table", "Write the equation of state as a table, a file that materials and runs can use");
  command->add_option("material", o->material, "Material file, or name of the library")->required();
  command->add_option("-o,--output", o->file, "NAME.eos.h5")->required();
  command->add_option("--error", o->error, "Relative error of temperature and pressure")
      ->check(CLI::Range(1e-8, 0.05))
      ->capture_default_str();
  command
      ->add_option("--density-range", o->densities,
                   "Two densities; default: 1e-5 of the reference density to the greatest of the model")
      ->expected(2);
  command->add_option("--temperature-range", o->temperatures, "Two temperatures; default: '50 K' '50000 K'")
      ->expected(2);
  command->add_flag("--force", o->force, "Overwrite an existing file");
  command->footer("Example:\n  whipple eos table copper --error 1e-4 -o copper.eos.h5");
  command->callback([o] { run(*o); });
}

}  // namespace whipple::app

// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/eos_tabulate.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "eos/files/sesame.hpp"
#include "eos/files/table_file.hpp"
#include "src/app/eos_options.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/progress.hpp"
#include "src/core/base/text_table.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/material/material_file.hpp"

namespace whipple::app {
namespace {

constexpr std::size_t verification_states = 1000000;

struct TabulateOptions {
  std::string material, file;
  double error = 1e-4;
  std::vector<std::string> densities, temperatures;
  std::string sesame_file, atomic_mass;
  int number = 1;
  double atomic_number = 0;
  bool force = false;
};

/// Builds a request with the range given by the user.
template <class Request>
Request ranged(const TabulateOptions& o) {
  Request request;
  if (!o.densities.empty()) {
    request.minimum_density = quantity("--density", o.densities[0], "kg/m^3").value_or(0.0);
    request.maximum_density = quantity("--density", o.densities[1], "kg/m^3").value_or(0.0);
  }
  if (!o.temperatures.empty()) {
    request.least_temperature = quantity("--temperature", o.temperatures[0], "K").value_or(0.0);
    request.greatest_temperature = quantity("--temperature", o.temperatures[1], "K").value_or(0.0);
  }
  return request;
}

void write_sesame(const TabulateOptions& o) {
  require_new_file(o.sesame_file, o.force);
  const Material material = read_material(o.material);
  eos::SesameMaterial table = eos::sesame_of(*material.eos, ranged<eos::SesameRequest>(o));
  table.number = o.number;
  table.atomic_number = o.atomic_number;
  if (const auto mass = quantity("--atomic-mass", o.atomic_mass, "kg/mol")) table.atomic_mass = *mass;
  table.comment = fmt::format("material. {} /source. whipple, model {} /refs. {} /", material.name,
                              material.eos->model(), material.source);
  eos::write_sesame(o.sesame_file, {&table, 1});
  const eos::SesameGrid& grid = table.total;
  fmt::print(
      "SESAME material {}: {} (model {}), {} densities from {:.6g} to {:.6g} kg/m^3, {} temperatures from "
      "{:.6g} to {:.6g} K\n",
      table.number, material.name, material.eos->model(), grid.density.size(), grid.density.front(),
      grid.density.back(), grid.temperature.size(), grid.temperature.front(), grid.temperature.back());
  fmt::print(
      "{}, {}\nwrote {}\n",
      grid.helmholtz.empty() ? "no Helmholtz energy (the model has no entropy)" : "with Helmholtz energy",
      table.vaporisation.temperature.empty()
          ? "no table 401 (the model has no dome)"
          : fmt::format("table 401 of {} temperatures", table.vaporisation.temperature.size()),
      o.sesame_file);
}

void write_table(const TabulateOptions& o) {
  require_new_file(o.file, o.force);
  const Material material = read_material(o.material);
  auto request = ranged<eos::TableRequest>(o);
  request.error = o.error;
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
      {"phase", "states", "beyond", "T", "p", "c", "mean c", "fractions", "mean fractions"}};
  for (const auto& [phase, e] : file.verification) {
    rows.push_back({phase, fmt::format("{}", e.states), fmt::format("{}", e.beyond)});
    for (const double value :
         {e.temperature, e.pressure, e.sound_speed, e.mean_sound_speed, e.fraction, e.mean_fraction})
      rows.back().push_back(fmt::format("{:.2g}", value));
  }
  fmt::print("{}wrote {}\n", text_table(rows, "lr"), o.file);
}

}  // namespace

void add_eos_tabulate(CLI::App& eos_command) {
  auto o = std::make_shared<TabulateOptions>();
  CLI::App* command = eos_command.add_subcommand(
      "table", "Write the equation of state as a table, a file that materials and runs can use");
  command->add_option("material", o->material, "Material file, or name of the library")->required();
  CLI::Option* table = command->add_option("-o,--output", o->file, "NAME.eos.h5");
  CLI::Option* sesame =
      command->add_option("--sesame", o->sesame_file, "SESAME file in ASCII layout, instead of NAME.eos.h5")
          ->excludes(table);
  command->add_option("--error", o->error, "Relative error of temperature and pressure")
      ->check(CLI::Range(1e-8, 0.05))
      ->capture_default_str()
      ->needs(table);
  command->add_option("--number", o->number, "Number of the material in the SESAME file")
      ->check(CLI::Range(1, 999999))
      ->capture_default_str()
      ->needs(sesame);
  command->add_option("--atomic-number", o->atomic_number, "Mean atomic number for table 201; 0: not known")
      ->check(CLI::Range(0.0, 120.0))
      ->needs(sesame);
  command->add_option("--atomic-mass", o->atomic_mass, "Mean atomic mass for table 201, e.g. '63.546 g/mol'")
      ->needs(sesame);
  command
      ->add_option(
          "--density-range", o->densities,
          "Two densities; default: 1e-5 of the reference density to the maximum of the model; with --sesame "
          "1e-4 to 10 times the reference density")
      ->expected(2);
  command->add_option("--temperature-range", o->temperatures, "Two temperatures; default: '50 K' '50000 K'")
      ->expected(2);
  command->add_flag("--force", o->force, "Overwrite an existing file");
  command->footer(
      "Examples:\n  whipple eos table copper --error 1e-4 -o copper.eos.h5\n"
      "  whipple eos table copper --sesame copper.ses --number 90029 --atomic-number 29 --atomic-mass "
      "'63.546 g/mol'");
  command->callback([o] {
    if (o->file.empty() && o->sesame_file.empty())
      throw InputError("the file to write is missing: expected --output NAME.eos.h5 or --sesame FILE");
    o->sesame_file.empty() ? write_table(*o) : write_sesame(*o);
  });
}

}  // namespace whipple::app

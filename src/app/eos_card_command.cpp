// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/eos_card_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "src/app/completion_command.hpp"
#include "src/app/eos_options.hpp"
#include "src/app/eos_table.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/words.hpp"
#include "src/decks/eos_card.hpp"
#include "src/material/material_file.hpp"

namespace whipple::app {
namespace {

struct CardOptions {
  std::string material, format, file;
  std::string units = "mm ms kg";
  int number = 1;
  bool force = false;
};

void write_card(const CardOptions& o) {
  const auto units = decks::parse_unit_system(o.units);
  if (!units) {
    throw InputError(
        fmt::format("--units '{}': expected units of length, mass and time, as in 'mm ms kg'", o.units));
  }
  if (!o.file.empty()) require_new_file(o.file, o.force);
  const Material material = read_material(o.material);
  refuse_foam(material);
  const auto format = value_of<decks::CardFormat>(o.format).value();
  const std::string card = decks::eos_card(material.name, *material.eos, format, *units, o.number);
  if (o.file.empty()) {
    fmt::print("{}", card);
    return;
  }
  write_output(o.file, card);
}

}  // namespace

void add_eos_card(CLI::App& eos_command) {
  auto o = std::make_shared<CardOptions>();
  CLI::App* command = eos_command.add_subcommand(
      "card", "Write the equation of state as a card of LS-DYNA or OpenRadioss (mie_gruneisen, jwl)");
  offer_materials(
      command->add_option("material", o->material, "Material file, or name of the library")->required());
  command->add_option("--format", o->format, "The other program")
      ->required()
      ->check(CLI::IsMember(word_list<decks::CardFormat>()));
  command->add_option("--units", o->units, "Consistent units of the card: length, mass and time")
      ->capture_default_str();
  command
      ->add_option("--number", o->number,
                   "Number of the equation of state, or of the material in OpenRadioss")
      ->check(CLI::Range(1, 99999999))
      ->capture_default_str();
  command->add_option("-o,--output", o->file, "File to write (default: standard output)");
  command->add_flag("--force", o->force, "Overwrite an existing file");
  command->footer(
      "Example:\n  whipple eos card copper_ofhc_mie_gruneisen --format ls-dyna --units 'mm ms kg' -o "
      "copper.k");
  command->callback([o] { write_card(*o); });
}

}  // namespace whipple::app

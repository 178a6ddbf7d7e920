// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/units_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/units.hpp"

namespace whipple::app {
namespace {

/// Describes a kind of quantity of the inputs, with accepted examples.
struct Quantity {
  std::string name;
  std::string si_unit;
  std::vector<std::string> examples;
};

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> all = {
      {"length", "m", {"0.5 mm", "40 um", "3.615 angstrom", "1 inch"}},
      {"time", "s", {"20 us", "1 ps", "10 min"}},
      {"velocity", "m/s", {"6.58 km/s", "0.394 cm/us", "1 mm/us"}},
      {"acceleration", "m/s^2", {"1 km/s^2"}},
      {"mass", "kg", {"2.03 g", "63.546 u"}},
      {"molar mass", "kg/mol", {"63.546 g/mol"}},
      {"density", "kg/m^3", {"8.93 g/cm^3", "8.93 g/cc"}},
      {"specific volume", "m^3/kg", {"0.1118 cm^3/g"}},
      {"pressure, stress", "Pa", {"140 GPa", "1.4 Mbar", "2.1 kbar"}},
      {"specific energy", "J/kg", {"1.2 MJ/kg", "0.05 Mbar cm3/g", "5.2 kJ/g"}},
      {"specific heat capacity", "J/(kg K)", {"383 J/(kg K)", "0.383 J/(g K)"}},
      {"molar heat coefficient", "J/(mol K^2)", {"0.00069 J/(mol K^2)", "6.9e-7 kJ/(mole K2)"}},
      {"temperature", "K", {"300 K", "25 degC"}},
      {"energy", "J", {"1 eV", "13.6 eV"}},
      {"fraction", "", {"0.25", "25 %"}},
  };
  return all;
}

void print_table() {
  fmt::print("Quantities are texts with a unit. Examples by kind of quantity:\n\n");
  for (const Quantity& quantity : quantities()) {
    fmt::print("{} [{}]\n", quantity.name, quantity.si_unit.empty() ? "1" : quantity.si_unit);
    for (const std::string& example : quantity.examples) {
      fmt::print("  {:<24} = {}\n", "\"" + example + "\"",
                 units::format_quantity(units::parse_quantity(example, quantity.si_unit), quantity.si_unit));
    }
  }
  fmt::print(
      "\nAny product or power of units of UDUNITS-2 with SI prefixes is accepted (\"m/s\", \"m s-1\", "
      "\"m.s^-1\");\n"
      "eV is the exact value of the SI of 2019. The dimension is checked where the quantity is read.\n");
}

/// Prints a quantity in the SI unit of its kind.
void print_in_si(const std::string& text) {
  for (const Quantity& quantity : quantities()) {
    if (quantity.si_unit.empty()) continue;
    try {
      const double value = units::parse_quantity(text, quantity.si_unit);
      fmt::print("{} ({})\n", units::format_quantity(value, quantity.si_unit), quantity.name);
      return;
    } catch (const InputError&) {
      // a quantity of another kind
    }
  }
  throw InputError(fmt::format(
      "'{}' is no quantity with a unit that 'whipple units' lists: name one with --to UNIT", text));
}

}  // namespace

void add_units_command(CLI::App& app) {
  struct UnitsOptions {
    std::string quantity;
    std::string unit;
  };
  auto options = std::make_shared<UnitsOptions>();
  CLI::App* command = app.add_subcommand("units", "Accepted units with examples; converts a quantity");
  command->add_option("quantity", options->quantity, "A quantity to convert, for example \"6.58 km/s\"");
  command->add_option("--to", options->unit, "The unit to convert to");
  command->footer(
      "Example:\n  whipple units\n  whipple units \"10 ug\"\n  whipple units \"1.4 Mbar\" --to GPa");
  command->callback([options] {
    if (options->quantity.empty() && !options->unit.empty()) {
      throw InputError("--to needs a quantity to convert, as in: whipple units \"1.4 Mbar\" --to GPa");
    }
    if (options->quantity.empty()) {
      print_table();
    } else if (options->unit.empty()) {
      print_in_si(options->quantity);
    } else {
      const double value = units::parse_quantity(options->quantity, options->unit);
      fmt::print("{}\n", units::format_quantity(value, options->unit));
    }
  });
}

}  // namespace whipple::app

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <vector>

#include "eos/curves/table.hpp"
#include "src/app/eos_options.hpp"
#include "src/app/eos_remarks.hpp"

/// Defines the subcommands of `whipple eos` that print a table: states and curves.
namespace whipple::app {

/// Lists the quantities of the command line that a subcommand may accept.
enum class EosQuantity {
  density,
  temperature,
  energy,
  pressure,
  entropy,
  particle_velocity,
  initial_density,
  reflected,
  velocity,
  from,
  to,
  states,
  volume,
};

/// Describes one subcommand: the quantities that it accepts and the table that it computes.
struct EosQuery {
  const char* name;
  const char* summary;
  std::vector<EosQuantity> quantities;
  const char* x;  ///< default columns of the figure; null: a list without figure
  const char* y;
  eos::curves::CurveTable (*table)(const EosOptions&, const eos::curves::Subjects&);
  Remarks (*remarks)(const EosOptions&, const eos::curves::Subjects&);  ///< may be null
  const char* example;
  bool as_list = false;       ///< print one quantity per line
  bool with_samples = false;  ///< can be repeated for samples of a fitted material
};

/// Returns the subcommands, in the order of the help.
const std::vector<EosQuery>& eos_queries();

/// Adds the options of quantities to a subcommand.
void add_quantities(CLI::App& sub, const std::vector<EosQuantity>& takes, EosOptions& options);

}  // namespace whipple::app

// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/data_set/run_cost.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

#include "src/core/base/error.hpp"

namespace whipple::md {

RunShape run_shape(const std::map<std::string, std::string>& provenance) {
  const auto number = [&](const char* name, double otherwise) {
    const auto entry = provenance.find(name);
    if (entry == provenance.end()) return otherwise;
    const std::string& text = entry->second;
    double value = 0.0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || rest != text.data() + text.size())
      throw InputError(
          fmt::format("the provenance entry '{}' of a point is \"{}\", not a number", name, text));
    return value;
  };
  const double cells = number("cells", 0.0);
  return {.cells = cells,
          .length = number("length", cells),
          .equilibration_steps = number("equilibration_steps", 0.0),
          .steps = number("steps", 0.0),
          .replicas = number("replicas", 1.0)};
}

double atom_steps(std::optional<PointKind> protocol, double atoms_per_cell, const RunShape& shape) {
  const double atoms = atoms_per_cell * shape.cells * shape.cells * shape.length;
  const double run = shape.equilibration_steps + shape.steps;
  if (protocol == PointKind::hugoniot) {
    constexpr double searches = 3.0;  // runs of half the equilibration and a quarter of the steps
    return atoms * (run + searches * (0.5 * shape.equilibration_steps + 0.25 * shape.steps));
  }
  if (protocol == PointKind::coexistence) {
    constexpr double preparation = 1500.0 + 0.5 * (5000.0 + 1000.0) + 1000.0;  // half of the cell melts
    const double phase = std::fmax(4.0, 0.75 * shape.cells);  // crystal and melt are also averaged separately
    const double runs = shape.replicas + 1.0;                 // the first run finds the start of the others
    return atoms * (preparation + run) * runs + atoms_per_cell * std::pow(phase, 3) * run * shape.replicas;
  }
  return atoms * run * shape.replicas;
}

double sampling(const RunShape& shape) {
  return shape.cells * shape.cells * shape.length * shape.steps * shape.replicas;
}

}  // namespace whipple::md

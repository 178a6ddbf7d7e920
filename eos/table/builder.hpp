// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>

#include "eos/table/table.hpp"

namespace whipple::eos {

/// Describes the range and the error of a table to be built. Zero: the default of the model.
struct TableRequest {
  double error = 1e-4;                ///< see TableError
  double minimum_density = 0;         ///< kg/m^3; default 1e-5 of the reference density
  double maximum_density = 0;         ///< kg/m^3; default: that of the model
  double least_temperature = 50.0;    ///< K
  double greatest_temperature = 5e4;  ///< K
};

/// Runs body(i) for i in [0, n), in any order, on any number of threads.
using ForEach = std::function<void(std::size_t n, const std::function<void(std::size_t)>& body)>;
/// Receives the fraction of the work that is done, from 0 to 1.
using Report = std::function<void(double share)>;

ForEach serial();

/// Tabulates a complete model: entropy at states, not its derivatives, so that a model with inconsistent p, T and s
/// yields a consistent table close to it. Refines until two successive resolutions agree within the requested error
/// in T, p and, ten times looser, c.
/// @throws InputError if the model has no entropy or no temperature, or cannot be resolved
TableData tabulate(const EquationOfState& eos, const TableRequest& request,
                   const ForEach& for_each = serial(), const Report& report = {});

/// Holds the differences between a table and its model over random states.
struct TableError {
  std::size_t states = 0;
  std::size_t beyond = 0;  ///< of these, with more than the requested error in T or p
  double temperature = 0;  ///< |dT|/T, maximum
  double pressure = 0;     ///< |dp|/[|p| + rho (c^2 + c_0^2/100)/100], maximum; c_0 of the reference state
  double sound_speed = 0;  ///< |d(c^2)|/[2 (c^2 + c_0^2/100)]: maximum, and mean
  double mean_sound_speed = 0;
  double fraction = 0;  ///< of melted and vaporised fraction: maximum, and mean
  double mean_fraction = 0;
};

/// Compares table and model by phase at states uniform in ln rho and in ln(e - e_0) of the table.
std::map<std::string, TableError> verify(const Table& table, const EquationOfState& eos, std::size_t states,
                                         const ForEach& for_each = serial(), const Report& report = {});

}  // namespace whipple::eos

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eos/loci.hpp"
#include "src/app/eos_table.hpp"
#include "src/material/material.hpp"

/// What `whipple eos` computes: tables of states and curves of one or more materials.
namespace whipple::app {

constexpr double GPa = 1e9;  ///< Pa

/// Quantities of the command line as the user wrote them; empty: not given.
struct EosOptions {
  std::string density, temperature, energy, pressure, entropy, particle_velocity;
  std::string initial_density, reflected;
  std::string velocity;
  std::string from, to;
  int points = 21;
};

/// The quantity of an option, if it is given; errors name the option. Densities and temperatures must be
/// positive, velocities not negative.
/// @throws InputError
std::optional<double> quantity(const char* option, const std::string& text, const char* unit);

/// Equal distances, ends included.
std::vector<double> spaced(double from, double to, int points);

using Materials = std::vector<Material>;

CurveTable state_table(const EosOptions& options, const Materials& materials);
CurveTable hugoniot_table(const EosOptions& options, const Materials& materials);
CurveTable isotherm_table(const EosOptions& options, const Materials& materials);
CurveTable isentrope_table(const EosOptions& options, const Materials& materials);
CurveTable release_table(const EosOptions& options, const Materials& materials);
CurveTable cold_table(const EosOptions& options, const Materials& materials);
CurveTable melt_table(const EosOptions& options, const Materials& materials);
CurveTable dome_table(const EosOptions& options, const Materials& materials);
/// Impact of the first material on the second, and the shock's way into the others.
CurveTable match_table(const EosOptions& options, const Materials& materials);

// What a curve is remarkable for, printed below its table; nothing where a model does not know it.
std::vector<std::string> state_remarks(const EosOptions& options, const Materials& materials);
std::vector<std::string> hugoniot_remarks(const EosOptions& options, const Materials& materials);
std::vector<std::string> release_remarks(const EosOptions& options, const Materials& materials);
std::vector<std::string> cold_remarks(const EosOptions& options, const Materials& materials);
std::vector<std::string> melt_remarks(const EosOptions& options, const Materials& materials);
std::vector<std::string> dome_remarks(const EosOptions& options, const Materials& materials);
std::vector<std::string> match_remarks(const EosOptions& options, const Materials& materials);

}  // namespace whipple::app

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/base/parameter_table.hpp"
#include "src/input/document.hpp"

/// The plan of a campaign of molecular-dynamics points: a TOML file that names what is to be measured. This
/// library knows neither LAMMPS nor potentials; `whipple describe md` prints its tables.
namespace whipple::md {

/// Size and length of one simulation.
struct RunSize {
  std::int64_t cells = 5;  ///< unit cells along each edge
  std::int64_t equilibration_steps = 1500;
  std::int64_t steps = 6000;  ///< steps that are averaged
  double time_step = 0.0;     ///< s; 0: chosen by temperature, compression and mass
};

/// Volume and energy at given temperatures and zero pressure; the first temperature is the reference of the
/// Hugoniot.
struct ZeroPressurePlan {
  std::vector<double> temperature = {293.0};
  RunSize size{.cells = 5, .equilibration_steps = 3000, .steps = 27000};
};
/// States at one temperature and several volumes.
struct IsothermPlan {
  double temperature = 293.0;
  std::vector<double> volume_ratio;
  RunSize size{};
};
/// States at one volume and several temperatures.
struct IsochorePlan {
  double volume_ratio = 1.0;
  std::vector<double> temperature;
  RunSize size{};
};
struct HugoniotPlan {
  std::vector<double> volume_ratio;
  RunSize size{};
};
/// Melting temperatures by coexistence of crystal and melt.
struct CoexistencePlan {
  std::vector<double> pressure;
  std::vector<double> first_guess;  ///< K, one per pressure
  std::int64_t attempts = 4;
  RunSize size{.cells = 8, .equilibration_steps = 5000, .steps = 10000};
};

struct Plan {
  std::string title;
  std::string element;
  std::string potential;
  std::int64_t seed = 1;
  std::filesystem::path folder;  ///< of the plan file: a potential file may lie there
  std::optional<ZeroPressurePlan> zero_pressure;
  std::vector<IsothermPlan> isotherms;
  std::vector<IsochorePlan> isochores;
  std::optional<HugoniotPlan> hugoniot;
  std::optional<CoexistencePlan> coexistence;
};

/// Reads a plan. @throws InputError with all errors at once, each with file:line:column.
Plan read_plan(const std::filesystem::path& path);
Plan read_plan(input::Document& document);

/// The sections of a plan with their keys: for `whipple describe md` and the manual.
std::string describe_plan();

}  // namespace whipple::md

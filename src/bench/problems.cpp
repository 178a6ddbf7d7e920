// SPDX-License-Identifier: BSD-3-Clause
#include "src/bench/problems.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "src/case/case.hpp"
#include "src/core/base/error.hpp"
#include "src/core/process/paths.hpp"

namespace whipple::bench {
namespace {

using Overrides = std::vector<std::pair<std::string, std::string>>;

/// Selects the options used by most peer codes, to which their published speeds refer.
const Overrides linear_musl = {{"time.scheme", "musl"},
                               {"transfer.particle_update", "flip"},
                               {"transfer.shape_function", "linear"},
                               {"output.maximum_energy_error", "1"}};

/// Extends the quarter model of the case to the whole sphere and plate: 138,278 particles in the peer's input.
const Overrides whole_model = {{"domain.lower", "['-80.56 mm', '-118.72 mm', '-118.72 mm']"},
                               {"domain.boundary.y_lower", "outflow"},
                               {"domain.boundary.z_lower", "outflow"}};

const Overrides johnson_cook_bar = {{"domain.cell_size", "0.475 mm"},
                                    {"body.0.material", "copper_johnson_cook.toml"}};

/// Selects a block of 20 x 20 x 42 mm from the column of the case, 40 mm of it explosive, which burns completely during
/// the preliminary steps. The remaining metal moves, so that no material is inactive.
const Overrides explosive_block = {
    {"domain.cell_size", "1 mm"},
    {"domain.upper", "['20 mm', '20 mm', '120 mm']"},
    {"splitting.length", "0"},
    {"body.0.shape", "{ box = { lower = ['0 mm', '0 mm', '-40 mm'], upper = ['20 mm', '20 mm', '0 mm'] } }"},
    {"body.1.shape", "{ box = { lower = ['0 mm', '0 mm', '0 mm'], upper = ['20 mm', '20 mm', '2 mm'] } }"}};
const Overrides metal_block = {
    {"domain.cell_size", "1 mm"},
    {"domain.upper", "['20 mm', '20 mm', '120 mm']"},
    {"splitting.length", "0"},
    {"detonation.0.position", "['0 mm', '0 mm', '-2 mm']"},
    {"body.0.shape", "{ box = { lower = ['0 mm', '0 mm', '-2 mm'], upper = ['20 mm', '20 mm', '0 mm'] } }"},
    {"body.1.shape", "{ box = { lower = ['0 mm', '0 mm', '0 mm'], upper = ['20 mm', '20 mm', '40 mm'] } }"},
    {"body.1.velocity", "['0 m/s', '0 m/s', '300 m/s']"}};

Overrides together(Overrides first, const Overrides& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

std::vector<Problem> all_problems() {
  const std::string taylor = "cases/taylor_bar/case.toml";
  const std::string lead = "cases/lead_sphere_on_plate/case.toml";
  const std::string lead_gray = "cases/lead_sphere_on_plate_gray/case.toml";
  const std::string disk = "cases/copper_disk_on_aluminium/case.toml";
  return {
      {.name = "taylor_bar",
       .what = "Johnson-Cook, Mie-Grueneisen, default scheme",
       .case_file = taylor,
       .overrides = johnson_cook_bar,
       .steps_before = 20,
       .steps = 100},
      {.name = "taylor_bar_musl",
       .what = "the same with linear MUSL",
       .case_file = taylor,
       .overrides = together(johnson_cook_bar, linear_musl),
       .steps_before = 20,
       .steps = 100},
      {.name = "lead_impact",
       .what = "lead sphere on plate during penetration, Mie-Grueneisen, default scheme",
       .case_file = lead,
       .overrides = whole_model,
       .steps_before = 50,
       .steps = 100},
      {.name = "lead_impact_musl",
       .what = "the same with linear MUSL",
       .case_file = lead,
       .overrides = together(whole_model, linear_musl),
       .steps_before = 50,
       .steps = 100},
      {.name = "lead_impact_gray",
       .what = "the same with three-phase GRAY, default scheme, 14 cells across the sphere",
       .case_file = lead_gray,
       .overrides = {},
       .steps_before = 100,
       .steps = 100},
      {.name = "lead_impact_gray_table",
       .what = "the same with tables of GRAY",
       .case_file = lead_gray,
       .overrides = {{"body.0.equation_of_state", "table"}, {"body.1.equation_of_state", "table"}},
       .steps_before = 100,
       .steps = 100},
      // Finer grids reach the same depth of penetration after proportionally more steps.
      {.name = "lead_impact_million",
       .what = "lead_impact with half the cell size: eight times the particles",
       .case_file = lead,
       .overrides = together(whole_model, {{"domain.cell_size", "1.06 mm"}}),
       .steps_before = 100,
       .steps = 100},
      {.name = "lead_impact_nine_million",
       .what = "the same with a quarter of it: 64 times the particles, 4 GB (only when it is named)",
       .case_file = lead,
       .overrides = together(whole_model, {{"domain.cell_size", "0.53 mm"}}),
       .steps_before = 200,
       .steps = 100,
       .only_by_name = true},
      {.name = "debris_cloud",
       .what = "copper disk on aluminium, three-phase GRAY, cloud formed",
       .case_file = disk,
       .overrides = {{"domain.cell_size", "0.5 mm"}},
       .steps_before = 200,
       .steps = 100},
      {.name = "late_cloud",
       .what = "the same cloud, thinned to about 1/16 particle per cell",
       .case_file = disk,
       .overrides = {{"domain.cell_size", "0.5 mm"},
                     {"domain.lower", "['0 mm', '0 mm', '-500 mm']"},
                     {"domain.upper", "['1000 mm', '1000 mm', '1500 mm']"},
                     {"time.end", "1 ms"}},
       .steps_before = 200,
       .steps = 100,
       .thinning = 20e-6},
      {.name = "long_rod",
       .what = "tungsten rod on steel plate: elements, and particles that come from them",
       .case_file = "cases/long_rod_oblique_plate/case.toml",
       .overrides = {{"domain.cell_size", "1 mm"}},
       .steps_before = 400,
       .steps = 100},
      {.name = "explosive",
       .what = "Composition B that has burnt and pushes a plate, default scheme",
       .case_file = "cases/gurney/case.toml",
       .overrides = explosive_block,
       .steps_before = 150,
       .steps = 100},
      {.name = "explosive_metal",
       .what = "the same with as much Mie-Grueneisen metal without strength in place of the explosive",
       .case_file = "cases/gurney/case.toml",
       .overrides = metal_block,
       .steps_before = 50,
       .steps = 100},
  };
}

}  // namespace

const std::vector<Problem>& problems() {
  static const std::vector<Problem> list = all_problems();
  return list;
}

const Problem& find_problem(std::string_view name) {
  const auto found = std::ranges::find(problems(), name, &Problem::name);
  if (found != problems().end()) return *found;
  std::vector<std::string> names;
  for (const Problem& problem : problems()) names.push_back(problem.name);
  throw InputError(fmt::format("there is no problem \"{}\"; there are {}", name, fmt::join(names, ", ")));
}

Problem refined(const Problem& problem, int times) {
  const double finer = std::cbrt(times);
  const cases::Case setup =
      cases::read_case(process::find_data(problem.case_file).string(), problem.overrides);
  Problem result = problem;
  result.overrides.emplace_back("domain.cell_size", fmt::format("{} m", setup.domain.cell_size / finer));
  result.steps_before = static_cast<int>(std::lround(problem.steps_before * finer));
  return result;
}

}  // namespace whipple::bench

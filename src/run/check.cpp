// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "eos/table/table.hpp"
#include "src/case/build/patches.hpp"
#include "src/case/build/placement.hpp"
#include "src/case/build/tables.hpp"
#include "src/case/remarks.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/machine.hpp"
#include "src/core/base/text.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/io/ranks.hpp"
#include "src/run/observers/stop_conditions.hpp"
#include "src/run/preparation.hpp"
#include "src/solver/device/device.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::run {

namespace {

/// Lists the faces of the domain at which a body is continuous with its mirror image, and those at which it is in
/// contact with the wall or its image; empty where there are none.
std::string at_faces(const cases::Case& setup, const solver::Simulation& simulation, std::size_t body) {
  constexpr std::array<const char*, 6> names = {"x_lower", "x_upper", "y_lower",
                                                "y_upper", "z_lower", "z_upper"};
  std::string held, met;
  for (std::size_t face = 0; face < names.size(); ++face) {
    if (setup.geometry.boundary[face] == grid::Boundary::outflow) continue;
    std::string& list = simulation.is_one_with_image(body, face) ? held : met;
    list += (list.empty() ? "" : ", ") + std::string(names[face]);
  }
  std::string text;
  if (!held.empty())
    text += fmt::format("  one with its mirror image or the wall at {}, where it begins\n", held);
  if (!met.empty()) text += fmt::format("  contact at {} when it comes there\n", met);
  return text;
}

/// Describes the maximum number of particles after splitting, and their memory on this rank; empty without splitting.
std::string of_splitting(const solver::Simulation& simulation) {
  const cases::Splitting& splitting = simulation.setup().splitting;
  const SplittingForecast forecast = forecast_splitting(simulation);
  const auto now = static_cast<double>(simulation.particle_count());
  if (forecast.generations == 0.0 || now == 0.0) return {};
  double bytes = 0.0;
  for (const solver::Carrier* carrier : simulation.carriers()) {
    if (carrier->particle_count() > 0) bytes += static_cast<double>(carrier->bytes());
  }
  const char* const divided = splitting.of == cases::Divided::all ? "what stretches"
                              : forecast.fluid_from_start         ? "fluid that expands freely"
                                                                  : "what melts or boils and stretches";
  return fmt::format(
      "splitting: {:.0f} to {:.3g} particles, {} to {}: {} is divided up to {:.0f} times "
      "(the time is that of {:.0f})\n",
      now, forecast.most_particles, format_bytes(bytes), format_bytes(bytes / now * forecast.most_particles),
      divided, forecast.generations, now);
}

/// Lists what the shapes of a body from files and generators report, and the cells across their thinnest part.
std::vector<std::string> account_of(const cases::Case& setup, std::size_t body) {
  std::vector<std::string> lines;
  const cases::Body& of = setup.bodies[body];
  if (of.discretization.has_elements() && !of.driven) {
    lines.emplace_back("  its elements do not touch each other where the body folds");
  }
  if (of.discretization.has_elements() && of.element_range.beyond == cases::BeyondRange::remove) {
    const bool touch = setup.contact_fields.parts(body) > 1;
    lines.push_back(fmt::format(
        "  elements beyond their range are deleted; pieces that this parts {}",
        touch ? "touch each other" : "do not touch each other (element_range.pieces = \"none\")"));
  }
  of.shape->visit([&](const cases::Shape& part) {
    const std::vector<std::string> account = part.account();
    if (account.empty()) return;
    lines.insert(lines.end(), account.begin(), account.end());
    const double thinnest = part.smallest_extent(setup.bodies[body].velocity);
    if (std::isnan(thinnest)) return;
    const double cells = thinnest / setup.geometry.cell_size;
    lines.push_back(fmt::format("  {:.3g} cells across the thinnest part{}", cells,
                                cells < 1.0 ? ": warning: the grid does not resolve it" : ""));
  });
  return lines;
}

/// Counts what is on the levels of the cells, over all ranks.
std::vector<CaseCheck::OfLevel> of_levels(const solver::Simulation& simulation, MPI_Comm communicator) {
  const grid::BlockGrid& grid = simulation.grid();
  if (!grid.has_two_levels()) return {};
  std::array<double, 5> counts{};  // particles and active cells of either level, mixed particles
  for (const Vector3& x : simulation.particles().position) {
    const grid::Blend blend = grid.geometry().blend(x);
    counts[grid::number(grid.geometry().level_at(x))] += 1.0;
    counts[4] += blend.is_mixed() ? 1.0 : 0.0;
  }
  for (std::size_t slot = 0; slot < grid.owned_slots(); ++slot) {
    counts[2 + grid::number(grid.coordinate(slot).level)] += grid::nodes_per_block;
  }
  parallel::sum(communicator, counts);
  std::vector<CaseCheck::OfLevel> levels;
  for (const std::size_t level : {0U, 1U}) {
    levels.push_back({.cell_size = grid.geometry().cell_size * (level == 0 ? 1.0 : 2.0),
                      .particles = static_cast<std::size_t>(counts[level]),
                      .mixed = static_cast<std::size_t>(counts[4]),
                      .cells = static_cast<std::size_t>(counts[2 + level])});
  }
  return levels;
}

}  // namespace

CaseCheck examine_case(const RunOptions& options, bool with_forecast, MPI_Comm communicator,
                       const std::optional<DeviceQuestion>& device) {
  set_threads(options.threads, communicator);
  CaseCheck found;
  found.setup = cases::read_case(options.case_file, options.overrides);
  cases::Case& setup = found.setup;
  require_known_columns(setup, options.overrides);
  require_memory(setup, communicator);
  found.expected_memory = cases::expected_memory(setup);
  if (device) solver::evaluate_by_tables(setup);
  cases::tabulate_materials(setup, io::Ranks(communicator));
  if (device) require_device_case(setup);
  setup.transfer.rest_tolerance = 0.0;  // the cost is measured with no block inactive
  solver::Simulation simulation(setup, communicator);
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const cases::BodySummary& body = simulation.bodies()[b];
    CaseCheck::OfBody& of_body = found.bodies.emplace_back();
    for (const solver::Carrier* carrier : simulation.carriers()) of_body.parts += carrier->count_text(b);
    of_body.mass = body.mass;
    of_body.shape_mass = body.shape_mass;
    of_body.at_faces = at_faces(setup, simulation, b);
  }
  found.warnings = cases::remarks(setup);
  found.particles = simulation.particle_count();  // before splitting adds more
  found.splitting = of_splitting(simulation);
  found.threads = parallel::threads();
  if (device) found.device = estimate_device(simulation, device->bandwidth);
  if (with_forecast) found.cost = forecast(simulation);
  if (found.device && found.cost) set_time(*found.device, *found.cost);
  found.blocks = simulation.grid().slots();  // active after the first step
  if (with_forecast) found.levels = of_levels(simulation, communicator);
  found.bytes = static_cast<double>(simulation.bytes());
  return found;
}

nlohmann::json check_json(const CaseCheck& found) {
  using nlohmann::json;
  const cases::Case& setup = found.setup;
  json bodies = json::array();
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    bodies.push_back({{"name", setup.bodies[b].name},
                      {"material", setup.materials[b]->name},
                      {"parts", found.bodies[b].parts},
                      {"mass", found.bodies[b].mass},
                      {"shape_mass", found.bodies[b].shape_mass},
                      {"account", account_of(setup, b)}});
  }
  json text = {{"file", setup.file.string()},
               {"title", setup.title},
               {"cells", setup.geometry.cells},
               {"cell_size", setup.geometry.cell_size},
               {"end", setup.time.end},
               {"bodies", bodies},
               {"particles", found.particles},
               {"memory", found.bytes},
               {"expected_memory", found.expected_memory},
               {"threads", found.threads},
               {"pressures", cases::describe_patches(setup)},
               {"warnings", found.warnings},
               {"remarks", setup.contact_fields.remarks},
               {"faults", json::array()}};
  if (found.cost) {
    text["steps"] = {found.cost->least_steps, found.cost->most_steps};
    text["seconds"] = {found.cost->least_time, found.cost->most_time};
  }
  if (found.device) text["device"] = device_json(*found.device);
  for (const CaseCheck::OfLevel& level : found.levels) {
    text["levels"].push_back({{"cell_size", level.cell_size},
                              {"particles", level.particles},
                              {"mixed_particles", level.mixed},
                              {"active_cells", level.cells}});
  }
  return text;
}

std::string check_text(const CaseCheck& found) {
  const cases::Case& setup = found.setup;
  std::string text = fmt::format("{}\n{}\n\n", setup.file.string(), setup.title);
  text += fmt::format("grid: {} x {} x {} cells of {:.6g} mm\n", setup.geometry.cells[0],
                      setup.geometry.cells[1], setup.geometry.cells[2], 1e3 * setup.geometry.cell_size);
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const CaseCheck::OfBody& body = found.bodies[b];
    text += fmt::format("body \"{}\" of {}: {}, {:.6g} g in the domain; whole shape {:.6g} g\n",
                        setup.bodies[b].name, setup.materials[b]->name, body.parts, 1e3 * body.mass,
                        1e3 * body.shape_mass);
    for (const std::string& line : account_of(setup, b)) text += "  " + line + "\n";
    text += body.at_faces;
    if (const auto* table = dynamic_cast<const eos::Table*>(setup.materials[b]->eos.get())) {
      text += fmt::format("  equation of state: table of {}, {} kB, error {:.2g}, {:.4g} to {:.6g} kg/m^3\n",
                          table->data().origin, table->data().size() / 1000, table->data().requested_error,
                          table->minimum_density(), table->maximum_density());
    }
  }
  for (const std::string& load : cases::describe_patches(setup)) text += load + "\n";
  for (const std::string& remark : setup.contact_fields.remarks) text += remark + "\n";
  for (const std::string& remark : found.warnings) text += "warning: " + remark + "\n";
  text += fmt::format("particles: {}{}, memory: {} now\n", found.particles,
                      found.cost ? fmt::format(", active blocks: {}", found.blocks) : "",
                      format_bytes(found.bytes));
  for (const CaseCheck::OfLevel& level : found.levels) {
    text += fmt::format("  cells of {:.6g} mm: {} particles, {} active cells\n", 1e3 * level.cell_size,
                        level.particles, level.cells);
  }
  if (!found.levels.empty())
    text += fmt::format("  {} particles have functions of both sizes\n", found.levels.front().mixed);
  text += found.splitting;
  if (found.device) text += device_text(*found.device);
  if (!found.cost) return text;
  const Forecast& cost = *found.cost;
  text += fmt::format("steps: {:.0f} to {:.0f} to t = {:.6g} us\n", cost.least_steps, cost.most_steps,
                      1e6 * setup.time.end);
  text += fmt::format(
      "estimated time: {} to {} on {} thread{} ({:.0f} ns per particle{} and step, measured; on average "
      "{:.0f} % of "
      "them take part)\n",
      format_duration(cost.least_time), format_duration(cost.most_time), found.threads,
      found.threads == 1 ? "" : "s", cost.nanoseconds, setup.has_elements() ? " or element" : "",
      1e2 * cost.moving_share);
  constexpr double long_time = 86400.0;  // s
  if (cost.least_time > long_time) {
    text += fmt::format(
        "that is more than a day: is time.end = {:.6g} us meant, or are the cells of {:.6g} mm too fine?\n",
        1e6 * setup.time.end, 1e3 * setup.geometry.cell_size);
  }
  return text;
}

}  // namespace whipple::run

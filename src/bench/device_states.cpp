// SPDX-License-Identifier: BSD-3-Clause
#include "src/bench/device_states.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "src/bench/problems.hpp"
#include "src/case/build/tables.hpp"
#include "src/core/base/error.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/process/paths.hpp"
#include "src/device/check/states.hpp"
#include "src/io/ranks.hpp"
#include "src/solver/device/problem.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::bench {
namespace {

namespace check = device::check;

/// Problems of about 5000 particles, each of which needs other kernels.
const std::vector<Problem>& state_problems() {
  static const std::vector<Problem> list = {
      {.name = "lead_impact",
       .what =
           "lead sphere on lead plate, 6.58 km/s: Mie-Grueneisen, contact of two fields, two mirror planes",
       .case_file = "cases/lead_sphere_on_plate/case.toml",
       .overrides =
           {{"domain.cell_size", "1.7 mm"},
            {"domain.lower", "['-34 mm', '0 mm', '0 mm']"},
            {"domain.upper", "['34 mm', '34 mm', '34 mm']"},
            {"body.1.shape",
             "{ box = { lower = ['0 mm', '-20 mm', '-20 mm'], upper = ['6.36 mm', '20 mm', '20 mm'] } }"}},
       .steps_before = 20},
      {.name = "taylor_bar",
       .what = "copper bar at a mirror plane, 190 m/s: Johnson-Cook, three mirror planes",
       .case_file = "cases/taylor_bar/case.toml",
       .overrides = {{"body.0.material", "copper_johnson_cook.toml"}},
       .steps_before = 20},
      {.name = "disk_on_aluminium",
       .what =
           "copper disk on aluminium plate, 5.55 km/s: tables of GRAY, melting, contact, two mirror planes",
       .case_file = "cases/copper_disk_on_aluminium/case.toml",
       .overrides =
           {{"domain.cell_size", "0.75 mm"},
            {"domain.lower", "['0 mm', '0 mm', '-18 mm']"},
            {"domain.upper", "['18 mm', '18 mm', '36 mm']"},
            {"body.1.shape",
             "{ box = { lower = ['-8 mm', '-8 mm', '0 mm'], upper = ['8 mm', '8 mm', '2.87 mm'] } }"}},
       .steps_before = 20},
      {.name = "sphere_on_friction_wall",
       .what =
           "copper sphere that slides on a wall with friction, 300 m/s: Johnson-Cook, contact with images",
       .case_file = "cases/taylor_bar/case.toml",
       .overrides = {{"body.0.material", "copper_johnson_cook.toml"},
                     {"domain.cell_size", "0.8 mm"},
                     {"domain.lower", "['-8 mm', '-8 mm', '0 mm']"},
                     {"domain.upper", "['12 mm', '8 mm', '16 mm']"},
                     {"domain.boundary", "{ z_lower = 'friction' }"},
                     {"domain.friction", "0.3"},
                     {"body.0.velocity", "['200 m/s', '0 m/s', '-300 m/s']"},
                     {"body.0.shape",
                      "{ sphere = { center = ['0 mm', '0 mm', '4.1 mm'], radius = '4 mm' } }"}},
       .steps_before = 40},
  };
  return list;
}

check::Totals totals_of(const solver::Totals& of) {
  using S = device::StepSums;
  check::Totals totals{};
  totals[S::total_mass] = of.mass;
  totals[S::momentum_scale] = of.momentum_scale;
  for (int a = 0; a < 3; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    totals[S::momentum + axis] = of.momentum[a];
    totals[S::angular_momentum + axis] = of.angular_momentum[a];
  }
  totals[S::kinetic] = of.kinetic_energy;
  totals[S::affine_kinetic] = of.affine_kinetic_energy;
  totals[S::internal] = of.internal_energy;
  totals[S::unresolved_] = of.unresolved_energy;
  return totals;
}

/// Returns the present particles and totals; particles in the order of the start, with their places there as origins.
check::Result result_of(const solver::Simulation& simulation,
                        const std::unordered_map<std::uint64_t, std::uint32_t>& place_of_id) {
  const Particles& particles = simulation.particles();
  device::PointsOnHost now;
  solver::to_columns(particles, now);
  std::vector<std::uint32_t> place(now.size());
  std::ranges::transform(particles.id, place.begin(), [&](std::uint64_t id) {
    const auto found = place_of_id.find(id);
    if (found == place_of_id.end()) throw InternalError("a particle of a stored state has been divided");
    return found->second;
  });
  std::vector<std::uint32_t> order(now.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, {}, [&](std::uint32_t p) { return place[p]; });
  check::Result result;
  result.totals = totals_of(simulation.totals());
  for (const std::uint32_t p : order) {
    result.points.body.push_back(now.body[p]);
    result.points.origin.push_back(place[p]);
  }
  for (std::size_t c = 0; c < device::state_components; ++c) {
    for (const std::uint32_t p : order) result.points.numbers[c].push_back(now.numbers[c][p]);
  }
  return result;
}

check::StoredState state_of(const Problem& problem, std::size_t steps, const std::string& revision,
                            MPI_Comm communicator) {
  std::vector<std::pair<std::string, std::string>> overrides = problem.overrides;
  overrides.emplace_back("transfer.rest_tolerance", "0");
  cases::Case setup = cases::read_case(process::find_data(problem.case_file).string(), overrides);
  solver::evaluate_by_tables(setup);
  cases::tabulate_materials(setup, io::Ranks(communicator));
  if (std::vector<InputFault> faults = solver::device_faults(setup); !faults.empty())
    throw InputError(std::move(faults));
  solver::Simulation simulation(setup, communicator);
  for (int i = 0; i < problem.steps_before; ++i) simulation.advance(setup.time.end);

  check::StoredState state;
  state.name = problem.name;
  state.what = problem.what;
  state.revision = revision;
  state.problem = simulation.device_problem();
  solver::to_columns(simulation.particles(), state.start);
  std::unordered_map<std::uint64_t, std::uint32_t> place_of_id;
  for (const std::uint64_t id : simulation.particles().id)
    place_of_id.emplace(id, static_cast<std::uint32_t>(place_of_id.size()));
  for (std::size_t i = 0; i < steps; ++i) {
    simulation.advance(setup.time.end);
    state.steps.push_back({simulation.state().time_step, simulation.state().time});
    if (i == 0) state.first = result_of(simulation, place_of_id);
  }
  state.last = result_of(simulation, place_of_id);
  return state;
}

}  // namespace

std::vector<std::string> device_state_names() {
  std::vector<std::string> names;
  for (const Problem& problem : state_problems()) names.push_back(problem.name);
  return names;
}

std::vector<std::string> write_device_states(const std::filesystem::path& folder,
                                             const std::vector<std::string>& names, std::size_t steps,
                                             const std::string& revision, MPI_Comm communicator) {
  if (parallel::size(communicator) > 1) throw InputError("--states: one rank writes them");
  const std::vector<std::string> known = device_state_names();
  for (const std::string& name : names) {
    if (std::ranges::find(known, name) == known.end())
      throw InputError(fmt::format("there is no state \"{}\"; there are {}", name, fmt::join(known, ", ")));
  }
  std::filesystem::create_directories(folder);
  std::vector<std::string> lines;
  for (const Problem& problem : state_problems()) {
    if (!names.empty() && std::ranges::find(names, problem.name) == names.end()) continue;
    const check::StoredState state = state_of(problem, steps, revision, communicator);
    const std::filesystem::path file = folder / (problem.name + ".state");
    check::write_state(file, state);
    lines.push_back(fmt::format("wrote {}: {} particles, {} steps, {:.1f} MB", file.string(),
                                state.start.size(), steps,
                                1e-6 * static_cast<double>(std::filesystem::file_size(file))));
  }
  return lines;
}

}  // namespace whipple::bench

// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/budget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <utility>
#include <vector>

#include "md_fitting/data_set/run_cost.hpp"
#include "md_fitting/protocols/crystal.hpp"

namespace whipple::md {

std::map<std::string, double> planned_atom_steps(std::span<const Task> tasks,
                                                 const std::set<std::string>& without,
                                                 const Potential& potential) {
  std::map<std::string, double> work;
  for (const Task& task : tasks) {
    const double steps = atom_steps(value_of<PointKind>(task.protocol), potential.atoms_per_cell(),
                                    run_shape(task.provenance));
    if (steps > 0.0 && !without.contains(task.key)) work[task.protocol] += steps;
  }
  return work;
}

double atom_steps_per_second(const Potential& potential) {
  constexpr std::int64_t least_cells = 5;
  constexpr int steps = 200;
  const auto cells = std::max(
      least_cells, static_cast<std::int64_t>(std::ceil(potential.cutoff() / potential.lattice_constant())));
  Crystal crystal(potential, potential.lattice_constant(), cells, cells, cells);
  Lammps& lammps = crystal.lammps();
  lammps.command("timestep {:.17g}", time_step(potential, 1.0, 300.0, {}));
  lammps.command("velocity all create 600 1 mom yes rot no dist gaussian");
  lammps.command("fix integrate all nve");
  crystal.evaluate();
  const double begin = processor_seconds();
  lammps.command("run {} post no", steps);
  return crystal.atoms() * steps / std::fmax(processor_seconds() - begin, 1e-6);
}

std::string time_split(const std::map<std::string, double>& seconds) {
  std::vector<std::pair<std::string, double>> shares(seconds.begin(), seconds.end());
  std::ranges::stable_sort(shares, [](const auto& a, const auto& b) { return a.second > b.second; });
  const double sum = total(seconds);
  std::string text = fmt::format("{:.1f} min", sum / 60.0);
  const char* joint = ": ";
  for (const auto& [protocol, time] : shares) {
    text += fmt::format("{}{} {:.1f} ({:.0f} %)", joint, protocol, time / 60.0,
                        sum > 0.0 ? 100.0 * time / sum : 0.0);
    joint = ", ";
  }
  return text;
}

double total(const std::map<std::string, double>& shares) {
  double sum = 0.0;
  for (const auto& [name, share] : shares) sum += share;
  return sum;
}

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace whipple::md

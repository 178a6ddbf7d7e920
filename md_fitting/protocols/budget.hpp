// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>

#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/protocols/tasks.hpp"

/// Estimates and reports the cost of the points of a plan (docs/manual/md.md, "Cost and accuracy").
namespace whipple::md {

/// Returns atoms times steps of the tasks by protocol, excluding those with the given keys. Static crystals cost
/// nothing; runs of unknown length (piston, spall) count with their equilibration only.
std::map<std::string, double> planned_atom_steps(std::span<const Task> tasks,
                                                 const std::set<std::string>& without,
                                                 const Potential& potential);

/// Measures the speed of one processor with a potential, atoms times steps per second of processor time, from 200
/// steps of a crystal of several hundred atoms at zero pressure and 300 K. Strongly compressed states take up to
/// twice as long.
double atom_steps_per_second(const Potential& potential);

/// Returns "12.3 min: coexistence 8.1 (66 %), isochore 4.2 (34 %)", in descending order.
/// @param seconds  of processor time, by protocol
std::string time_split(const std::map<std::string, double>& seconds);

/// Returns the sum of all contributions.
double total(const std::map<std::string, double>& shares);

/// Returns the processor time (s) used by this process.
double processor_seconds();

}  // namespace whipple::md

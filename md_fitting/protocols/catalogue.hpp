// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "md_fitting/plan/plan.hpp"
#include "md_fitting/protocols/task_list.hpp"

namespace whipple::md {

/// One protocol: its section of a plan becomes points.
struct Protocol {
  const char* name;  ///< in the store
  int revision;      ///< raised when it changes what it computes: older points are then computed again
  void (*add)(const Plan& plan, TaskList& list);
};

/// All protocols, the ones that others depend on first.
std::span<const Protocol> protocols();

// Each is defined in the file of its protocol.
void add_zero_pressure(const Plan& plan, TaskList& list);
void add_lattice(const Plan& plan, TaskList& list);
void add_coexistence(const Plan& plan, TaskList& list);
void add_isotherms(const Plan& plan, TaskList& list);
void add_isochores(const Plan& plan, TaskList& list);
void add_hugoniot(const Plan& plan, TaskList& list);
void add_cold_curve(const Plan& plan, TaskList& list);
void add_elastic(const Plan& plan, TaskList& list);
void add_hugoniostat(const Plan& plan, TaskList& list);
void add_liquid(const Plan& plan, TaskList& list);
void add_piston(const Plan& plan, TaskList& list);
void add_spall(const Plan& plan, TaskList& list);
void add_quantum(const Plan& plan, TaskList& list);
void add_liquid_vapour(const Plan& plan, TaskList& list);

}  // namespace whipple::md

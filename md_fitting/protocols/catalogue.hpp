// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "md_fitting/plan/plan.hpp"
#include "md_fitting/protocols/task_list.hpp"

namespace whipple::md {

/// Describes one protocol, which turns its section of a plan into points.
struct Protocol {
  const char* name;  ///< as in the database
  int revision;      ///< incremented when the computed results change, so that older points are recomputed
  void (*add)(const Plan& plan, TaskList& list);
};

/// Returns all protocols, dependencies first.
std::span<const Protocol> protocols();

// Each function is defined in the file of its protocol.
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
void add_fluid(const Plan& plan, TaskList& list);

}  // namespace whipple::md

// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/piston.hpp"

#include "md_fitting/plan/plan.hpp"

namespace whipple::md {

std::vector<BoundParameter> keys(PistonPlan& plan) {
  static const ParameterTable<PistonPlan> table = {
      real_list("particle_velocity", &PistonPlan::particle_velocity, "m/s", range::positive(),
                "velocities of the piston"),
      integer("length", &PistonPlan::length, {.lower = 20, .upper = 10000},
              "unit cells along the shock; the section of the crystal has cells x cells")
          .optional()};
  return with_size(bind(table, plan), plan.size);
}

void check(const PistonPlan& section, const Plan& plan, input::Table& table) {
  if (section.particle_velocity.empty()) {
    table.error_at("particle_velocity", "needs at least one velocity");
  }
  if (!plan.zero_pressure) {
    table.error("[piston] needs the section [zero_pressure_volume]: it is the state before the shock");
  }
}

}  // namespace whipple::md

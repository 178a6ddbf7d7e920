// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/piston.hpp"

#include "md_fitting/plan/plan.hpp"

namespace whipple::md {

ParameterTable<PistonPlan> PistonPlan::parameters() {
  ParameterTable<PistonPlan> own = {
      real_list("particle_velocity", &PistonPlan::particle_velocity, "m/s", range::positive(),
                "velocities of the piston"),
      integer("length", &PistonPlan::length, {.lower = 20, .upper = 10000},
              "unit cells along the shock; the section of the crystal has cells x cells")
          .optional()};
  return with_part(std::move(own), &PistonPlan::size, RunSize::parameters());
}

void PistonPlan::check(const Plan& plan, const input::Faults& faults) const {
  if (particle_velocity.empty()) {
    faults.add("particle_velocity", "needs at least one velocity");
  }
  if (!plan.zero_pressure) {
    faults.add("", "[piston] needs the section [zero_pressure_volume]: it is the state before the shock");
  }
}

}  // namespace whipple::md

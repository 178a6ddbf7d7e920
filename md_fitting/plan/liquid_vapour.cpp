// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/liquid_vapour.hpp"

namespace whipple::md {

ParameterTable<LiquidVapourPlan> LiquidVapourPlan::parameters() {
  ParameterTable<LiquidVapourPlan> own = {
      real_list("temperature", &LiquidVapourPlan::temperature, "K", range::positive(),
                "temperatures above about 0.7 of the critical one: colder vapour contains too few atoms"),
      real("gap", &LiquidVapourPlan::gap, "", range::between(0.5, 10.0),
           "length of the space next to the film over that of the crystal that it is made from")
          .optional(),
      integer("replicas", &LiquidVapourPlan::replicas, {.lower = 2, .upper = 64},
              "independent runs of each temperature; the errors are those of their means")
          .optional()};
  return with_part(std::move(own), &LiquidVapourPlan::size, RunSize::parameters());
}

void LiquidVapourPlan::check(const Plan&, const input::Faults& faults) const {
  if (temperature.empty()) faults.add("temperature", "needs at least one temperature");
}

}  // namespace whipple::md

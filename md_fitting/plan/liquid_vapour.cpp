// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/liquid_vapour.hpp"

namespace whipple::md {

std::vector<BoundParameter> keys(LiquidVapourPlan& plan) {
  static const ParameterTable<LiquidVapourPlan> table = {
      real_list("temperature", &LiquidVapourPlan::temperature, "K", range::positive(),
                "temperatures above about 0.7 of the critical one: colder vapour holds too few atoms"),
      real("gap", &LiquidVapourPlan::gap, "", range::between(0.5, 10.0),
           "length of the space beside the film over that of the crystal that it is made from")
          .optional(),
      integer("replicas", &LiquidVapourPlan::replicas, {.lower = 2, .upper = 64},
              "independent runs of each temperature; the errors are those of their means")
          .optional()};
  return with_size(bind(table, plan), plan.size);
}

void check(const LiquidVapourPlan& section, const Plan&, input::Table& table) {
  if (section.temperature.empty()) table.error_at("temperature", "needs at least one temperature");
}

}  // namespace whipple::md

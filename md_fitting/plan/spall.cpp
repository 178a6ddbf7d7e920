// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/spall.hpp"

namespace whipple::md {

ParameterTable<SpallPlan> SpallPlan::parameters() {
  ParameterTable<SpallPlan> own = {
      real_list("temperature", &SpallPlan::temperature, "K", range::positive(),
                "temperatures at zero pressure, before the tension")
          .optional(),
      real("strain_rate", &SpallPlan::strain_rate, "1/s", range::between(1e8, 1e12),
           "rate of the volume strain V/V0 - 1")
          .optional(),
      integer("replicas", &SpallPlan::replicas, {.lower = 2, .upper = 64},
              "independent runs of each temperature; the error is that of their mean")
          .optional(),
      real("largest_strain", &SpallPlan::largest_strain, "", range::between(0.05, 2.0),
           "volume strain at which a run that has not failed is given up")
          .optional()};
  return with_part(std::move(own), &SpallPlan::size, RunSize::parameters());
}

void SpallPlan::check(const Plan&, const input::Faults& faults) const {
  if (temperature.empty()) faults.add("temperature", "needs at least one temperature");
}

}  // namespace whipple::md

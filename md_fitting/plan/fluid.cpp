// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/fluid.hpp"

namespace whipple::md {

ParameterTable<FluidPlan> FluidPlan::parameters() {
  ParameterTable<FluidPlan> own = {
      real_list("volume_ratio", &FluidPlan::volume_ratio, "", range::open_between(0.1, 30.0),
                "V over the volume of the static crystal at zero pressure"),
      real_list("temperature", &FluidPlan::temperature, "K", range::positive(),
                "temperatures; every volume is combined with every temperature")};
  return with_run(std::move(own), &FluidPlan::size, &FluidPlan::target, "Pa",
                  "target standard error of the pressure");
}

void FluidPlan::check(const Plan&, const input::Faults& faults) const {
  if (volume_ratio.empty()) faults.add("volume_ratio", "needs at least one volume");
  if (temperature.empty()) faults.add("temperature", "needs at least one temperature");
}

}  // namespace whipple::md

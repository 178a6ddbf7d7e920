// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/isochore.hpp"

namespace whipple::md {

ParameterTable<IsochorePlan> IsochorePlan::parameters() {
  ParameterTable<IsochorePlan> own = {
      real("volume_ratio", &IsochorePlan::volume_ratio, "", range::open_between(0.1, 3.0),
           "V over the volume of the static crystal at zero pressure"),
      real_list("temperature", &IsochorePlan::temperature, "K", range::positive(),
                "temperatures along the isochore")};
  return with_run(std::move(own), &IsochorePlan::size, &IsochorePlan::target, "Pa",
                  "target standard error of the pressure");
}

}  // namespace whipple::md

// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/isotherm.hpp"

namespace whipple::md {

ParameterTable<IsothermPlan> IsothermPlan::parameters() {
  ParameterTable<IsothermPlan> own = {
      real("temperature", &IsothermPlan::temperature, "K", range::positive(), "temperature of the isotherm")
          .optional(),
      real_list("volume_ratio", &IsothermPlan::volume_ratio, "", range::open_between(0.1, 3.0),
                "V over the volume of the static crystal at zero pressure")};
  return with_run(std::move(own), &IsothermPlan::size, &IsothermPlan::target, "Pa",
                  "target standard error of the pressure");
}

}  // namespace whipple::md

// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/cold_curve.hpp"

namespace whipple::md {

ParameterTable<ColdCurvePlan> ColdCurvePlan::parameters() {
  return {real_list("volume_ratio", &ColdCurvePlan::volume_ratio, "", range::open_between(0.1, 3.0),
                    "V over the volume of the static crystal at zero pressure; above 1: tension")};
}

}  // namespace whipple::md

// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/quantum.hpp"

namespace whipple::md {

ParameterTable<QuantumPlan> QuantumPlan::parameters() {
  return {real_list("volume_ratio", &QuantumPlan::volume_ratio, "", range::open_between(0.1, 3.0),
                    "V over the volume of the static crystal at zero pressure"),
          real_list("temperature", &QuantumPlan::temperature, "K", range::positive(),
                    "temperatures of each volume"),
          integer("cells", &QuantumPlan::cells, {.lower = 2, .upper = 20},
                  "unit cells along each edge of the crystal whose vibrations are summed")
              .optional(),
          real("displacement", &QuantumPlan::displacement, "m", range::between(1e-14, 1e-11),
               "of one atom, both signs, for the force constants")
              .optional()};
}

}  // namespace whipple::md

// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/elastic.hpp"

namespace whipple::md {

ParameterTable<ElasticPlan> ElasticPlan::parameters() {
  return {real_list("volume_ratio", &ElasticPlan::volume_ratio, "", range::open_between(0.1, 3.0),
                    "V over the volume of the static crystal at zero pressure")
              .optional(),
          real("largest_strain", &ElasticPlan::largest_strain, "", range::between(1e-4, 0.02),
               "largest strain of the stress differences, both signs")
              .optional(),
          integer("strains", &ElasticPlan::strains, {.lower = 3, .upper = 20},
                  "equal steps up to the largest strain")
              .optional()};
}

}  // namespace whipple::md

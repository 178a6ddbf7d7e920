// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/time_control.hpp"

namespace whipple::cases {

ParameterTable<TimeControl> TimeControl::parameters() {
  return {
      real("end", &TimeControl::end, "s", range::positive(), "time at which the run ends"),
      real("courant", &TimeControl::courant, "", {.lower = 0.0, .upper = 1.0, .lower_open = true},
           "time step as a fraction of cell_size / (sound speed + particle speed)")
          .optional(),
      real("first_step", &TimeControl::first_step, "", {.lower = 0.0, .upper = 1.0, .lower_open = true},
           "initial time step as a fraction of the stable one")
          .optional(),
      real("maximum_growth", &TimeControl::maximum_growth, "", {.lower = 1.0, .lower_open = true},
           "largest ratio of successive time steps")
          .optional(),
      real("acceleration_limit", &TimeControl::acceleration_limit, "", range::positive(),
           "largest acceleration * dt^2 as a fraction of the cell size")
          .optional(),
      real("compression_limit", &TimeControl::compression_limit, "", range::positive(),
           "volumetric strain-rate limit: largest volume fraction that material under pressure loses in a "
           "step")
          .optional(),
      real("element_safety", &TimeControl::element_safety, "",
           {.lower = 0.0, .upper = 1.0, .lower_open = true},
           "time step of finite elements as a fraction of their stability limit")
          .optional(),
      choice("scheme", &TimeControl::scheme,
             "exact energy (default) | for comparison with other codes: modified update stress last | update "
             "stress last | update stress first | implicit load steps without inertia (`[quasi_static]`)")
          .optional(),
      choice("stress_rotation", &TimeControl::stress_rotation,
             "rotation of the stress in a step: midpoint rule | exact rotation")
          .optional()};
}

}  // namespace whipple::cases

// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/time_control.hpp"

namespace whipple::cases {

ParameterTable<TimeControl> TimeControl::parameters() {
  return {
      real("end", &TimeControl::end, "s", range::positive(), "time at which the run ends"),
      real("courant", &TimeControl::courant, "", {.lower = 0.0, .upper = 1.0, .lower_open = true},
           "time step as a share of cell_size / (sound speed + particle speed)")
          .optional(),
      real("first_step", &TimeControl::first_step, "", {.lower = 0.0, .upper = 1.0, .lower_open = true},
           "first time step of a run as a share of the stable one, which it then grows to")
          .optional(),
      real("maximum_growth", &TimeControl::maximum_growth, "", {.lower = 1.0, .lower_open = true},
           "largest ratio of a time step to the one before")
          .optional(),
      real("acceleration_limit", &TimeControl::acceleration_limit, "", range::positive(),
           "largest acceleration * dt^2 as a share of the cell size")
          .optional(),
      real("compression_limit", &TimeControl::compression_limit, "", range::positive(),
           "largest share of its volume that matter under pressure may lose in a step")
          .optional(),
      real("element_safety", &TimeControl::element_safety, "",
           {.lower = 0.0, .upper = 1.0, .lower_open = true},
           "time step of finite elements as a share of their bound of stability")
          .optional(),
      choice("scheme", &TimeControl::scheme,
             "symplectic: exact energy (default); for comparison with other codes: modified update stress "
             "last, update stress last, update stress first")
          .optional(),
      choice(
          "stress_rotation", &TimeControl::stress_rotation,
          "how stresses turn with the matter: with the middle of the step, or by the exact rotation of the "
          "step")
          .optional()};
}

}  // namespace whipple::cases

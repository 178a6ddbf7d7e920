// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/coexistence.hpp"

#include <fmt/format.h>

namespace whipple::md {

ParameterTable<CoexistencePlan> CoexistencePlan::parameters() {
  ParameterTable<CoexistencePlan> own = {
      real_list("pressure", &CoexistencePlan::pressure, "Pa", range::non_negative(),
                "pressures of melting points"),
      real_list("first_guess", &CoexistencePlan::first_guess, "K", range::positive(),
                "where the search begins, one per pressure"),
      integer("attempts", &CoexistencePlan::attempts, {.lower = 1, .upper = 20},
              "of each run: restarts from another temperature when crystal or melt has vanished")
          .optional(),
      integer("replicas", &CoexistencePlan::replicas, {.lower = 2, .upper = 64},
              "independent runs of each pressure; the errors are those of their means")
          .optional(),
      integer("length", &CoexistencePlan::length, {.lower = 8, .upper = 1000},
              "unit cells along the normal of the interfaces, half of them crystal; below 20 one phase tends "
              "to vanish")
          .optional()};
  return with_run(std::move(own), &CoexistencePlan::size, &CoexistencePlan::target, "K",
                  "target standard error of the melting temperature");
}

void CoexistencePlan::check(const Plan&, const input::Faults& faults) const {
  if (pressure.size() != first_guess.size()) {
    faults.add("first_guess",
               fmt::format("has {} temperatures for {} pressures", first_guess.size(), pressure.size()));
  }
}

}  // namespace whipple::md

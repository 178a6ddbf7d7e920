// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/output_control.hpp"

#include <fmt/format.h>

#include "src/case/case.hpp"
#include "src/io/output_fields.hpp"

namespace whipple::cases {

ParameterTable<OutputControl> OutputControl::parameters() {
  return {real("snapshot_every", &OutputControl::snapshot_every, "s", range::non_negative(),
               "simulated time between snapshots for ParaView; 0: first and last only")
              .optional(),
          real("checkpoint_every", &OutputControl::checkpoint_every, "s", range::non_negative(),
               "wall-clock time between checkpoints; 0: at the end and on signals only")
              .optional(),
          integer("history_every", &OutputControl::history_every, range::between(1, 1e9),
                  "steps between rows of history.csv")
              .optional(),
          integer("gauges_every", &OutputControl::gauges_every, range::between(1, 1e9),
                  "steps between rows of gauges.csv")
              .optional(),
          real("maximum_energy_error", &OutputControl::maximum_energy_error, "", range::positive(),
               "the run stops if the relative error of the total energy exceeds this; schemes without exact "
               "energy "
               "(musl, usl, usf) have no limit by default")
              .optional("0.01"),
          real("maximum_speed_factor", &OutputControl::maximum_speed_factor, "", range::positive(),
               "the run stops if a particle or node is faster than so many times the speed that the bodies "
               "bring along "
               "and can reach by the energy that they can set free")
              .optional(),
          text_list("fields", &OutputControl::fields, io::output_field_names(), "quantities in the snapshots")
              .optional()};
}

void OutputControl::check(const Case& setup, const Faults& faults) const {
  const double least = setup.time.end / most_snapshots;
  if (snapshot_every == 0.0 || snapshot_every >= least) return;
  faults.add(
      "snapshot_every",
      fmt::format(
          "'snapshot_every' is {:.3g} s, which asks for {:.3g} snapshots until the end at {:.3g} s: expected "
          "at least {:.3g} s, or 0 (first and last only)",
          snapshot_every, setup.time.end / snapshot_every, setup.time.end, least));
}

std::vector<std::string> OutputControl::default_fields() { return io::default_output_fields(); }

}  // namespace whipple::cases

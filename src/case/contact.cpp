// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/contact.hpp"

#include <fmt/format.h>

#include "src/case/build/contact_fields.hpp"
#include "src/case/case.hpp"

namespace whipple::cases {

ParameterTable<ContactControl> ContactControl::parameters() {
  return {
      choice(
          "method", &ContactControl::method,
          "bodies have velocity fields of their own where they meet, but for those that touch at the start "
          "and have the same velocity: they touch, move as one along the normal while they press, slide and part "
          "| all bodies move in one velocity field, bonded where they meet | all have their own, and impulses "
          "stop them")
          .optional(),
      choice("normal", &ContactControl::normal,
             "normal between two bodies: mean of those of both | of one of them or their mean, along which "
             "they are farthest apart | of the plane that separates their particles")
          .optional(),
      real("friction", &ContactControl::friction, "", range::non_negative(), "Coulomb's coefficient")
          .optional(),
      boolean("gap_test", &ContactControl::gap_test,
              "bodies touch where their surfaces do; false: wherever both reach a node")
          .optional(),
      real("gap", &ContactControl::gap, "", range::between(-1.0, 2.0),
           "of gap_test: distance in cells below which surfaces touch")
          .optional(),
      boolean("everywhere", &ContactControl::everywhere,
              "velocity fields of their own for all bodies at all nodes, not only where they meet: for "
              "comparison of cost")
          .optional()};
}

void ContactControl::check(const Case& setup, const Faults& faults) const {
  if (method != ContactMethod::multi_field || setup.bodies.empty()) return;
  if (setup.transfer.particle_update == ParticleUpdate::fmpm) {
    faults.add("method", "'method': the full mass matrix (transfer.particle_update = \"fmpm\") knows no contact; "
                         "take another update");
  }
  const unsigned count = count_of(fields_of_groups(setup.bodies));
  if (count < 2) faults.add("method", "'method' is \"multi_field\", but all bodies are one contact group");
  if (count > grid::maximum_fields) {
    faults.add("method", fmt::format("'method': {} bodies or contact groups, at most {} can have velocity "
                                     "fields of their own: join some with contact_group",
                                     count, grid::maximum_fields));
  }
}

}  // namespace whipple::cases

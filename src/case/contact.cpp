// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/contact.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "src/case/build/contact_fields.hpp"
#include "src/case/case.hpp"

namespace whipple::cases {

ParameterTable<ContactControl> ContactControl::parameters() {
  return {
      choice("method", &ContactControl::method,
             "bodies have separate velocity fields where they meet, with unilateral contact along the normal "
             "and "
             "friction, except bodies that initially touch with the same velocity | all bodies share one "
             "velocity "
             "field and are bonded where they meet | all bodies have separate velocity fields")
          .optional(),
      choice("normal", &ContactControl::normal,
             "contact normal: mean of both bodies | that of either body or their mean, whichever gives the "
             "largest gap | normal of the plane that separates their particles")
          .optional(),
      real("friction", &ContactControl::friction, "", range::non_negative(), "Coulomb friction coefficient")
          .optional(),
      real("explosive_friction", &ContactControl::explosive_friction, "", range::non_negative(),
           "the same of an explosive that burns, on whatever its products slide")
          .optional(),
      real("crack_friction", &ContactControl::crack_friction, "", range::non_negative(),
           "the same of the faces of a crack (failure.cracks = \"fields\")")
          .optional(),
      boolean(
          "gap_test", &ContactControl::gap_test,
          "contact where the surfaces touch; false: wherever both bodies, or faces of a crack, reach a node")
          .optional(),
      real("gap", &ContactControl::gap, "", range::between(-1.0, 2.0),
           "gap (in cells) below which surfaces are in contact")
          .optional(),
      boolean(
          "everywhere", &ContactControl::everywhere,
          "separate velocity fields of all bodies at all nodes, not only where they meet: for comparison of "
          "cost")
          .optional()};
}

void ContactControl::check(const Case& setup, const Faults& faults) const {
  if (method != ContactMethod::multi_field || setup.bodies.empty()) return;
  if (setup.transfer.particle_update == ParticleUpdate::fmpm) {
    faults.add("method",
               "'method': the full mass matrix (transfer.particle_update = \"fmpm\") has no contact; "
               "take another update");
  }
  const unsigned count = count_of(fields_of_groups(setup.bodies));
  const bool parts = std::ranges::any_of(setup.bodies, [](const Body& body) { return body.parts_touch(); });
  if (count < 2 && !parts)
    faults.add("method", "'method' is \"multi_field\", but all bodies are one contact group");
  if (count > grid::maximum_fields) {
    faults.add("method", fmt::format("'method': {} bodies or contact groups, at most {} can have velocity "
                                     "fields of their own: join some with contact_group",
                                     count, grid::maximum_fields));
  }
}

}  // namespace whipple::cases

// SPDX-License-Identifier: BSD-3-Clause
#include "src/setup/contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "src/setup/case.hpp"

namespace whipple::setup {

ParameterTable<ContactControl> ContactControl::parameters() {
  return {
      choice("method", &ContactControl::method, {"none", "multi_field"},
             "bodies move in one velocity field, as if bonded where they meet | each in its own where they "
             "meet: they touch, slide and part")
          .optional(),
      choice("normal", &ContactControl::normal, {"collinear", "separating", "logistic_regression"},
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

std::vector<std::uint8_t> Case::contact_fields() const {
  std::vector<std::uint8_t> fields;
  std::map<std::string, unsigned> of_group;
  unsigned next = 0;
  for (const Body& body : bodies) {
    unsigned field = next;
    if (!body.contact_group.empty()) field = of_group.try_emplace(body.contact_group, next).first->second;
    if (field == next) ++next;
    fields.push_back(static_cast<std::uint8_t>(std::min(field, 255U)));
  }
  return fields;
}

void check_contact(const Case& setup, input::Table& contact) {
  if (setup.contact.method == "none") return;
  if (setup.transfer.particle_update == "fmpm") {
    contact.error_at("method",
                     "'method': the full mass matrix (transfer.particle_update = \"fmpm\") knows no contact; "
                     "take another update");
  }
  const std::vector<std::uint8_t> fields = setup.contact_fields();
  const unsigned count = fields.empty() ? 0 : *std::ranges::max_element(fields) + 1U;
  if (count < 2) {
    contact.error_at("method", "'method' is \"multi_field\", but all bodies are one contact group");
  }
  if (count > grid::maximum_fields) {
    contact.error_at("method",
                     fmt::format("'method': {} bodies or contact groups, at most {} can have velocity "
                                 "fields of their own: join some with contact_group",
                                 count, grid::maximum_fields));
  }
}

}  // namespace whipple::setup

// SPDX-License-Identifier: BSD-3-Clause
#include "src/contact/sides.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

namespace whipple::contact {

Sides::Sides(grid::BlockGrid& grid, std::uint32_t slot, const Cracks* cracks)
    : grid_(grid), slot_(slot), cracks_(cracks) {
  const grid::FieldSet& present = grid.fields(slot);
  grid.wholes(slot).for_each([&](unsigned field) {
    fields_.push_back(field);
    parts_.push_back(present &
                     (cracks == nullptr ? grid::FieldSet::of(field) : cracks->fields().parts(field)));
  });
  joined_.reserve(2 * fields_.size());  // sides hold pointers to them
}

void Sides::go_to(std::size_t node) {
  sides_.clear();
  body_.clear();
  crack_.clear();
  joints_.clear();
  joined_.clear();
  for (std::size_t body = 0; body < fields_.size(); ++body) {
    if (parts_[body].count() == 1) {
      grid::Node* const only = grid_.nodes(slot_, parts_[body].nth(0)) + node;
      join({&only, 1}, body);
      continue;
    }
    const std::optional<Cracks::Crack> crack = cracks_->at(fields_[body], slot_, node);
    std::array<std::array<grid::Node*, grid::maximum_fields_with_cracks>, 2> parts;
    std::array<std::size_t, 2> count{};
    parts_[body].for_each([&](unsigned field) {
      grid::Node* const part = grid_.nodes(slot_, field) + node;
      if (part->motion.mass_for_contact() < no_mass) {
        part->motion.set_heat(0.0);
        return;
      }
      const std::size_t side = crack ? crack->side_b >> field & 1U : 0U;
      parts[side][count[side]++] = part;
    });
    for (std::size_t k = 0; k < 2; ++k) {
      if (count[k] > 0) join(std::span(parts[k]).first(count[k]), body);
    }
    if (count[0] > 0 && count[1] > 0) crack_[sides_.size() - 2] = *crack;
  }
}

void Sides::join(std::span<grid::Node* const> parts, std::size_t body) {
  body_.push_back(body);
  crack_.push_back({Vector3::Zero(), 0});
  grid::Node* node = parts.front();
  if (parts.size() > 1) {
    double mass = 0.0, logarithm = 0.0;
    bool equal = true, free = false;  // all have the same relaxation; some have none, as nodes of elements
    Lanes velocity{}, increment{};
    for (const grid::Node* part : parts) {
      const double m = part->motion.mass_for_contact(), beta = part->motion.relaxation();
      mass += m;
      logarithm += m * std::log1p(-beta);
      equal = equal && beta == parts.front()->motion.relaxation();
      free = free || beta == 0.0;
      velocity += m * part->motion.velocity_and_relaxation;
      increment += m * part->motion.increment_and_heat;
    }
    const double beta = equal ? node->motion.relaxation() : free ? 0.0 : -std::expm1(logarithm / mass);
    grid::Node& joined = joined_.emplace_back();
    joined.motion = {velocity / mass, increment / mass};
    joined.motion.set_relaxation(beta);
    joined.motion.increment_and_heat[3] = mass;
    joints_.push_back({sides_.size(), {parts.begin(), parts.end()}});
    node = &joined;
  }
  sides_.push_back({node, node->motion.mass_for_contact(), 0.0});
  node->motion.set_heat(0.0);
}

void Sides::spread() {
  for (const Side& side : sides_) {
    if (side.heat != 0.0) side.node->motion.set_heat(side.heat / side.mass);
  }
  for (const Joint& joint : joints_) {
    for (grid::Node* part : joint.parts) part->motion = sides_[joint.side].node->motion;
  }
}

}  // namespace whipple::contact

// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/build/contact_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "src/case/build/bars.hpp"
#include "src/case/build/touch.hpp"
#include "src/case/case.hpp"

namespace whipple::cases {

unsigned count_of(const std::vector<std::uint8_t>& fields) {
  return fields.empty() ? 0 : *std::ranges::max_element(fields) + 1U;
}

std::vector<std::uint8_t> fields_of_groups(const std::vector<Body>& bodies) {
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

namespace {

/// Holds the bonds between bodies.
class Bonds {
 public:
  explicit Bonds(const std::vector<Body>& bodies) : leader_(bodies.size()), group_(bodies.size()) {
    std::map<std::string, std::size_t> first;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      leader_[b] = b;
      group_[b] = bodies[b].contact_group;
      if (!group_[b].empty()) leader_[b] = first.try_emplace(group_[b], b).first->second;
    }
  }
  [[nodiscard]] std::size_t leader(std::size_t b) const {
    while (leader_[b] != b) b = leader_[b];
    return b;
  }
  [[nodiscard]] bool joined(std::size_t a, std::size_t b) const { return leader(a) == leader(b); }
  /// Returns whether two bodies may be bonded; bodies of different groups are not.
  [[nodiscard]] bool may_join(std::size_t a, std::size_t b) const {
    const std::string &of_a = group_[leader(a)], &of_b = group_[leader(b)];
    return of_a.empty() || of_b.empty() || of_a == of_b;
  }
  void join(std::size_t a, std::size_t b) {
    const std::size_t first = std::min(leader(a), leader(b)), second = std::max(leader(a), leader(b));
    if (group_[first].empty()) group_[first] = group_[second];
    leader_[second] = first;
  }
  /// Returns the numbers of the fields, in the order of the bodies.
  [[nodiscard]] std::vector<unsigned> fields() const {
    std::vector<unsigned> numbers(leader_.size());
    unsigned next = 0;
    for (std::size_t b = 0; b < numbers.size(); ++b) {
      numbers[b] = leader(b) == b ? next++ : numbers[leader(b)];
    }
    return numbers;
  }

 private:
  std::vector<std::size_t> leader_;
  std::vector<std::string> group_;  // of leaders
};

/// Bonds bars to the body that they reinforce.
void join_bars(const Case& setup, Bonds& bonds, ContactFields& found) {
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const Body& bars = setup.bodies[b];
    if (!bars.discretization.is_bars() || !bars.contact_group.empty()) continue;
    if (const auto around = body_around_bars(setup, bars)) {
      found.remarks.push_back(
          fmt::format("contact: the bars of body \"{}\" move with body \"{}\" around them", bars.name,
                      setup.bodies[*around].name));
      bonds.join(b, *around);
    } else {
      found.warnings.push_back(
          fmt::format("body \"{}\": its bars are in no body, and bars have no surface of their own: no body "
                      "touches them; contact_group names what they reinforce",
                      bars.name));
    }
  }
}

/// Returns whether a body burns; its material may be missing because of a fault of the case.
bool burns(const Case& setup, std::size_t body) {
  return setup.materials[body] != nullptr && setup.materials[body]->burns();
}

/// Bonds bodies that initially touch and have the same velocity.
void join_layers(const Case& setup, Bonds& bonds, ContactFields& found) {
  const std::vector<Body>& bodies = setup.bodies;
  for (std::size_t a = 0; a < bodies.size(); ++a) {
    if (bodies[a].discretization.is_bars()) continue;
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      if (bodies[b].discretization.is_bars() || bonds.joined(a, b) || !bonds.may_join(a, b)) continue;
      if (!bodies[a].contact_group.empty() && !bodies[b].contact_group.empty()) continue;
      if (burns(setup, a) != burns(setup, b)) continue;  // detonation products slide
      if (!touch_and_move_alike(setup, bodies[a], bodies[b])) continue;
      found.remarks.push_back(
          fmt::format("contact: bodies \"{}\" and \"{}\" touch at the start and have the same velocity: they "
                      "are bonded; a separate contact_group for each allows them to separate",
                      bodies[a].name, bodies[b].name));
      bonds.join(a, b);
    }
  }
}

/// Warns of bodies in one field that meet across a gap.
void warn_of_gaps(const Case& setup, ContactFields& found) {
  for (std::size_t a = 0; a < setup.bodies.size(); ++a) {
    for (std::size_t b = a + 1; b < setup.bodies.size(); ++b) {
      if (found.of_body[a] != found.of_body[b]) continue;
      if (setup.bodies[a].discretization.is_bars() || setup.bodies[b].discretization.is_bars()) continue;
      const double gap = gap_that_closes(setup, setup.bodies[a], setup.bodies[b]);
      if (!(gap > 0.0)) continue;
      found.warnings.push_back(fmt::format(
          "bodies \"{}\" and \"{}\" meet across a gap of {:.3g} mm in one velocity field: they act on each "
          "other two cells early, and pressures where they meet come out 3 to 5 times too high: "
          "contact.method = \"auto\", without a common contact_group, gives each its own",
          setup.bodies[a].name, setup.bodies[b].name, 1e3 * gap));
    }
  }
}

}  // namespace

unsigned ContactFields::count() const {
  unsigned all = count_of(of_body);
  for (const std::uint8_t first : pieces) {
    if (first != 0) all = std::max(all, first + fields_of_pieces);
  }
  return all;
}

unsigned ContactFields::parts(std::size_t body) const { return pieces[body] != 0 ? 1 + fields_of_pieces : 1; }

namespace {

/// Gives fields to the pieces of bodies, as far as velocity fields are available.
void give_fields_to_pieces(const Case& setup, ContactFields& found) {
  found.pieces.assign(setup.bodies.size(), 0);
  unsigned count = count_of(found.of_body);
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    if (!setup.bodies[b].parts_touch()) continue;
    const auto shared = std::ranges::count(found.of_body, found.of_body[b]);
    if (shared > 1) {
      found.warnings.push_back(
          fmt::format("body \"{}\": its pieces do not touch each other, since it is bonded to another body: "
                      "a contact_group of its own lets them",
                      setup.bodies[b].name));
      continue;
    }
    if (count + fields_of_pieces > grid::maximum_fields_with_cracks) {
      found.warnings.push_back(fmt::format(
          "body \"{}\": no velocity fields are left for its pieces, they do not touch each other: each such "
          "body takes {} of {}, and every body one",
          setup.bodies[b].name, fields_of_pieces, grid::maximum_fields_with_cracks));
      continue;
    }
    found.pieces[b] = static_cast<std::uint8_t>(count);
    count += fields_of_pieces;
  }
}

}  // namespace

std::vector<std::uint8_t> cracked_fields(const Case& setup, ContactFields& found) {
  const unsigned sectors = grid::crack_sectors(setup.geometry.is_planar());
  std::vector<std::uint8_t> cracked;
  unsigned count = found.count();
  const auto divides = [&](std::size_t b) { return setup.bodies[b].failure.cracks == CrackMotion::fields; };
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    if (!divides(b)) continue;
    const bool is_new = std::ranges::find(cracked, found.of_body[b]) == cracked.end();
    if (is_new && count + sectors > grid::maximum_fields_with_cracks) {
      found.warnings.push_back(fmt::format(
          "body \"{}\": no velocity fields are left for its cracks, they do not part: each such body takes "
          "{} of {}, and every body one",
          setup.bodies[b].name, sectors, grid::maximum_fields_with_cracks));
      continue;
    }
    for (std::size_t other = 0; other < setup.bodies.size(); ++other) {
      if (found.of_body[other] != found.of_body[b] || divides(other)) continue;
      found.remarks.push_back(
          fmt::format("cracks: bodies \"{}\" and \"{}\" are bonded in one velocity field: it divides at the "
                      "cracks of either",
                      setup.bodies[b].name, setup.bodies[other].name));
    }
    if (!is_new) continue;
    cracked.push_back(found.of_body[b]);
    count += sectors;
  }
  return cracked;
}

ContactFields find_contact_fields(const Case& setup) {
  ContactFields found;
  found.of_body.assign(setup.bodies.size(), 0);
  const ContactMethod method = setup.contact.method;
  const bool possible = setup.transfer.particle_update != ParticleUpdate::fmpm;
  if (method == ContactMethod::multi_field) {
    found.of_body = fields_of_groups(setup.bodies);
  } else if (method == ContactMethod::automatic && possible && setup.bodies.size() > 1) {
    Bonds bonds(setup.bodies);
    join_bars(setup, bonds, found);
    join_layers(setup, bonds, found);
    const std::vector<unsigned> fields = bonds.fields();
    const unsigned last = grid::maximum_fields - 1;
    for (std::size_t b = 0; b < fields.size(); ++b) {
      found.of_body[b] = static_cast<std::uint8_t>(std::min(fields[b], last));
    }
    if (const unsigned all = *std::ranges::max_element(fields) + 1; all > grid::maximum_fields) {
      found.warnings.push_back(fmt::format(
          "{} bodies or groups of them can meet, at most {} can have velocity fields of their own: "
          "the last {} are bonded to one another where they meet; contact_group chooses which",
          all, grid::maximum_fields, all - last));
    }
  } else if (method == ContactMethod::automatic && !possible && setup.bodies.size() > 1) {
    found.warnings.push_back(
        "the full mass matrix (transfer.particle_update = \"fmpm\") has no contact: all bodies move in one "
        "velocity field, bonded where they meet");
  }
  give_fields_to_pieces(setup, found);
  found.cracked = cracked_fields(setup, found);
  warn_of_gaps(setup, found);
  return found;
}

void choose_volumes(Case& setup) {
  for (Body& body : setup.bodies) {
    Discretization& made = body.discretization;
    if (made.partial_volumes_given || !made.has_particles()) continue;
    made.partial_volumes = !body.shape->fills_lattice();
  }
}

}  // namespace whipple::cases

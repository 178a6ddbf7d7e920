// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/device/contact/apply.hpp"
#include "src/device/contact/images.hpp"
#include "src/device/contact/nodes.hpp"
#include "src/device/contact/sums.hpp"
#include "src/device/contact/surfaces.hpp"
#include "src/device/engine.hpp"
#include "src/device/nodes.hpp"

namespace whipple::device {

/// Contact of bodies and of material with its images in a step, in the order of contact::GridUpdate.
template <class Space, class Lattice>
class Contact {
 public:
  template <class T>
  using Array = typename Space::template Array<T>;

  explicit Contact(const Problem& problem)
      : fields_(problem.fields), constants_(problem.contact), walls_(problem.walls) {
    for (int face = 0; face < 6; ++face) {
      if ((walls_.apart >> face & 1U) == 0) continue;
      faces_.push_back(face);
    }
    // Mirror planes and no-slip walls before walls from which material may part.
    std::ranges::stable_sort(faces_, {}, [&](int face) {
      const WallKind kind = walls_.kind[static_cast<std::size_t>(face)];
      return kind == WallKind::separating || kind == WallKind::friction ? 1 : 0;
    });
  }

  [[nodiscard]] bool meets_images() const { return !faces_.empty(); }
  /// Returns the parts of the nodes in contact of bodies; null with one velocity field.
  [[nodiscard]] const ContactRole* roles() { return fields_ < 2 ? nullptr : role_.data(); }

  /// Finds where fields meet and where material is near its image, and the surfaces there, from the sums of particles.
  /// @param least_closing_speed  of first contacts that limit the time step, m/s
  void find(Space& space, const Lattice& lattice, const Points& points, double dt,
            double least_closing_speed) {
    constants_.dt = walls_.dt = dt;
    least_closing_speed_ = least_closing_speed;
    const std::size_t nodes = std::size_t{lattice.slots} * block_nodes;
    flags_.reserve(nodes);
    before_.reserve(nodes);
    if (fields_ > 1) find_pairs(space, lattice, points, nodes);
    if (meets_images()) find_walls(space, lattice, points, nodes);
  }

  /// Stores what contact with images needs of the uncoupled motion, and leaves the masses of nodes in contact of bodies.
  void remember(Space& space, const Lattice& lattice) {
    if (!meets_images()) return;
    space.for_each(wall_nodes_, RememberUncoupled{lattice.nodes, list_.data(), at_.data()});
    const std::size_t nodes = std::size_t{lattice.slots} * block_nodes;
    if (fields_ > 1) {
      space.for_each(nodes, ClearOutsideContact<Lattice>{lattice, role_.data()});
    } else {
      space.for_each(nodes, ClearHeat{lattice.nodes});
    }
  }

  /// Applies contact of bodies.
  void apply(Space& space, const Lattice& lattice, Outcome& outcome) {
    const std::size_t pairs = fields_ > 1 ? surfaces_.count : 0;
    if (pairs == 0) return;
    space.for_each(
        pairs, ApplyContact<Lattice>{lattice, constants_, surfaces_, balances_.data(), approaches_.data()});
    const auto sums = space.reduce(pairs, SumBalances{balances_.data()});
    outcome.contact = sums.sum;
    if (sums.largest[0] > 0.0) {
      const auto last = static_cast<std::size_t>(sums.largest[0]) - 1;
      outcome.crowded_at = space.reduce(1, PlaceOfPair<Lattice>{lattice, pairs_.data() + last}).place();
    }
    outcome.approaches = deciding(space, pairs, static_cast<std::uint32_t>(pairs_of_fields(fields_)));
  }

  /// Applies contact with images, face by face.
  void meet_images(Space& space, const Lattice& lattice, Outcome& outcome) {
    if (wall_nodes_ == 0) return;
    const auto wall = [&](int face) {
      return Wall<Lattice>{lattice, walls_, face, list_.data(), number_.data(), at_.data()};
    };
    for (const int face : faces_) space.for_each(wall_nodes_, JoinRelaxation<Lattice>{wall(face)});
    approaches_.reserve(wall_nodes_ * faces_.size());
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      space.for_each(wall_nodes_, MeetImage<Lattice>{wall(faces_[f]), approaches_.data() + f * wall_nodes_});
    }
    outcome.face_approaches = deciding(space, wall_nodes_ * faces_.size(), 6);
  }

  /// Returns the heat (J) of contact with images.
  /// @param brought  sums of the particles at all nodes before folding
  double heat_of_images(Space& space, const Lattice& lattice, const Node* brought) {
    if (wall_nodes_ == 0) return 0.0;
    return space
        .reduce(std::size_t{lattice.slots} * block_nodes,
                SumHeatAtWalls<Lattice>{lattice, brought, number_.data(), at_.data()})
        .sum[0];
  }

  [[nodiscard]] std::size_t bytes() const {
    const auto sum = [](const auto&... arrays) { return (arrays.bytes() + ...); };
    return sum(role_, flags_, before_, pairs_, gradients_, normals_, extents_, balances_, approaches_,
               deciding_, list_, number_, at_);
  }

 private:
  void find_pairs(Space& space, const Lattice& lattice, const Points& points, std::size_t nodes) {
    role_.reserve(nodes);
    space.for_each(nodes, FindContactRoles<Lattice>{lattice, role_.data()});
    space.for_each(nodes, FlagFirstOfPair{role_.data(), flags_.data()});
    const std::size_t pairs = space.scan(flags_.data(), before_.data(), nodes);
    pairs_.reserve(pairs);
    normals_.reserve(pairs);
    gradients_.reserve(2 * pairs);
    extents_.reserve(2 * pairs);
    balances_.reserve(pairs);
    approaches_.reserve(pairs);
    surfaces_ = {.pairs = pairs_.data(),
                 .count = pairs,
                 .gradients = gradients_.data(),
                 .normals = normals_.data(),
                 .extents = extents_.data()};
    if (pairs == 0) return;
    space.for_each(nodes, ListContactPairs<Lattice>{lattice, role_.data(), before_.data(), pairs_.data()});
    space.for_each(2 * pairs, SumVolumeGradients<Lattice>{lattice, points, surfaces_});
    space.for_each(pairs, ChooseNormals<Lattice>{lattice, constants_, surfaces_});
    space.for_each(2 * pairs, FindExtents<Lattice>{lattice, points, surfaces_});
  }
  void find_walls(Space& space, const Lattice& lattice, const Points& points, std::size_t nodes) {
    space.for_each(nodes, FindWallNodes<Lattice>{lattice, walls_, flags_.data()});
    wall_nodes_ = space.scan(flags_.data(), before_.data(), nodes);
    list_.reserve(wall_nodes_);
    number_.reserve(nodes);
    at_.reserve(wall_nodes_);
    space.for_each(nodes, ListWallNodes{flags_.data(), before_.data(), list_.data(), number_.data()});
    space.for_each(wall_nodes_, FindWallExtents<Lattice>{lattice, points, list_.data(), at_.data()});
  }
  /// Returns the approaches that decide about first contacts, of each of `kinds` pairs.
  std::vector<DecidingApproaches> deciding(Space& space, std::size_t count, std::uint32_t kinds) {
    FindDecidingApproaches find = {.approach = approaches_.data(),
                                   .count = count,
                                   .pairs = kinds,
                                   .dt = constants_.dt,
                                   .least_speed = least_closing_speed_,
                                   .deciding = nullptr};
    constexpr std::size_t chunk = FindDecidingApproaches::chunk;
    const std::size_t found = (count + chunk - 1) / chunk * kinds;
    deciding_.reserve(found);
    find.deciding = deciding_.data();
    space.for_each(found, find);
    std::vector<DecidingApproaches> parts(found);
    deciding_.download(parts.data(), found);
    std::vector<DecidingApproaches> all(parts.begin(), parts.begin() + kinds);
    for (std::size_t i = kinds; i < found; ++i) find.combine(all[i % kinds], parts[i]);
    return all;
  }

  std::uint32_t fields_;
  ContactConstants constants_;
  WallConstants walls_;
  std::vector<int> faces_;  // at which some field is in contact with its image, in the order of contact
  double least_closing_speed_ = 0.0;
  ContactSurfaces surfaces_{};
  std::size_t wall_nodes_ = 0;
  Array<ContactRole> role_;
  Array<std::uint32_t> flags_, before_;
  Array<ContactPair> pairs_;
  Array<VolumeGradient> gradients_;
  Array<CandidateNormals> normals_;
  Array<Extents> extents_;
  Array<ContactBalance> balances_;
  Array<Approach> approaches_;
  Array<DecidingApproaches> deciding_;
  Array<std::uint32_t> list_;
  Array<std::int32_t> number_;
  Array<WallNode> at_;
};

}  // namespace whipple::device

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/device/contact/apply.hpp"
#include "src/device/contact/images.hpp"
#include "src/device/contact/nodes.hpp"
#include "src/device/contact/surfaces.hpp"
#include "tests/property/device_contact_support.hpp"

/// Kernels of contact in the order of a step, called for one node after the other.
namespace whipple::device {

/// Holds the pairs of a step with their surfaces.
struct Pairs {
  std::vector<ContactRole> role;
  std::vector<ContactPair> pair;
  std::vector<VolumeGradient> gradient;
  std::vector<CandidateNormals> normal;
  std::vector<Extents> extent;
  std::vector<ContactBalance> balance;
  std::vector<Approach> approach;

  /// Finds pairs and surfaces from the sums at the nodes.
  void find(const OnDevice& on, const ContactConstants& constants) {
    role.resize(on.nodes());
    std::vector<std::uint32_t> before;
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < on.nodes(); ++i) {
      FindContactRoles{on.lattice, role.data()}(i);
      before.push_back(count);
      if (role[i] == ContactRole::first) ++count;
    }
    pair.resize(count);
    for (std::size_t i = 0; i < on.nodes(); ++i) {
      ListContactPairs{on.lattice, role.data(), before.data(), pair.data()}(i);
    }
    gradient.resize(2 * std::size_t{count});
    normal.resize(count);
    extent.resize(2 * std::size_t{count});
    for (std::size_t i = 0; i < gradient.size(); ++i)
      SumVolumeGradients{on.lattice, on.points, surfaces()}(i);
    for (std::size_t i = 0; i < count; ++i) ChooseNormals{on.lattice, constants, surfaces()}(i);
    for (std::size_t i = 0; i < extent.size(); ++i) FindExtents{on.lattice, on.points, surfaces()}(i);
  }
  ContactBalance apply(const OnDevice& on, const ContactConstants& constants) {
    for (std::size_t i = 0; i < on.nodes(); ++i) ClearOutsideContact{on.lattice, role.data()}(i);
    balance.resize(pair.size());
    approach.resize(pair.size());
    ContactBalance sum;
    for (std::size_t i = 0; i < pair.size(); ++i) {
      ApplyContact{on.lattice, constants, surfaces(), balance.data(), approach.data()}(i);
      sum += balance[i];
    }
    return sum;
  }
  [[nodiscard]] ContactSurfaces surfaces() {
    return {pair.data(), pair.size(), gradient.data(), normal.data(), extent.data()};
  }
};

/// Holds the nodes of a step near walls.
struct WallNodes {
  std::vector<std::uint32_t> nodes;
  std::vector<std::int32_t> number;
  std::vector<WallNode> at;
  std::vector<Approach> approach;

  /// Finds nodes and extents from the sums at the nodes.
  void find(const OnDevice& on, const WallConstants& walls) {
    std::vector<std::uint32_t> flag(on.nodes()), before;
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < on.nodes(); ++i) {
      FindWallNodes{on.lattice, walls, flag.data()}(i);
      before.push_back(count);
      count += flag[i];
    }
    nodes.resize(count);
    at.resize(count);
    number.resize(on.nodes());
    for (std::size_t i = 0; i < on.nodes(); ++i) {
      ListWallNodes{flag.data(), before.data(), nodes.data(), number.data()}(i);
    }
    for (std::size_t i = 0; i < count; ++i)
      FindWallExtents{on.lattice, on.points, nodes.data(), at.data()}(i);
  }
  void remember(const OnDevice& on) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      RememberUncoupled{on.lattice.nodes, nodes.data(), at.data()}(i);
  }
  /// Returns the heat, J.
  double meet(const OnDevice& on, const WallConstants& walls) {
    std::vector<int> faces;
    for (int face = 0; face < 6; ++face) {
      if ((walls.apart >> face & 1U) != 0) faces.push_back(face);
    }
    std::ranges::stable_sort(faces, {}, [&](int face) {
      return walls.kind[static_cast<std::size_t>(face)] >= WallKind::separating;
    });
    approach.resize(faces.size() * nodes.size());
    for (const int face : faces) {
      const Wall wall{on.lattice, walls, face, nodes.data(), number.data(), at.data()};
      for (std::size_t i = 0; i < nodes.size(); ++i) JoinRelaxation{wall}(i);
    }
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const Wall wall{on.lattice, walls, faces[f], nodes.data(), number.data(), at.data()};
      for (std::size_t i = 0; i < nodes.size(); ++i) MeetImage{wall, &approach[f * nodes.size()]}(i);
    }
    double heat = 0.0;
    for (const WallNode& node : at) heat += node.mass * node.heat;
    return heat;
  }
};

}  // namespace whipple::device

// SPDX-License-Identifier: BSD-3-Clause
#include "src/quasi_static/unknowns.hpp"

#include <fmt/format.h>

#include <map>
#include <ranges>

#include "src/core/base/error.hpp"

namespace whipple::quasi_static {
namespace {

/// Describes what moves a node: a node of the grid, by direction with 1, -1, or 0 where it is held.
struct Master {
  std::uint32_t node;
  std::array<double, 3> sign = {1.0, 1.0, 1.0};
};

bool reverses(const grid::MirrorPlane& plane, int direction) {
  return plane.kind == grid::Boundary::no_slip || direction == plane.axis;
}

/// Finds the nodes that mirror planes move or hold: all others are their own masters.
std::map<std::uint32_t, Master> masters_at_planes(const grid::BlockGrid& grid) {
  std::map<std::uint32_t, Master> masters;
  const auto of = [&](std::uint32_t node) -> Master& {
    return masters.try_emplace(node, Master{.node = node}).first->second;
  };
  for (const grid::MirrorPlane& plane : grid.mirror_planes()) {
    for (const std::uint32_t node : plane.on_plane) {
      for (int a = 0; a < 3; ++a) {
        if (reverses(plane, a)) of(node).sign[static_cast<std::size_t>(a)] = 0.0;
      }
    }
  }
  // In the order of transfer::MirrorPlanes::copy_back, so that corners come out right.
  for (const grid::MirrorPlane& plane : std::views::reverse(grid.mirror_planes())) {
    for (const grid::MirrorPair& pair : plane.pairs) {
      Master image = of(pair.image);
      for (int a = 0; a < 3; ++a) {
        if (reverses(plane, a)) image.sign[static_cast<std::size_t>(a)] *= -1.0;
      }
      of(pair.outside) = image;
    }
  }
  return masters;
}

}  // namespace

Unknowns::Unknowns(const Supports& supports, const grid::BlockGrid& grid,
                   std::span<const std::optional<Given>> given)
    : components_(supports.nodes()) {
  const std::map<std::uint32_t, Master> masters = masters_at_planes(grid);
  const auto master_of = [&](std::size_t node) {
    const auto found = masters.find(supports.grid_node[node]);
    return found == masters.end() ? Master{.node = supports.grid_node[node]} : found->second;
  };
  std::map<std::uint32_t, Vector3> given_at;  // a master; an image gives the reflected displacement
  for (std::size_t node = 0; node < supports.nodes(); ++node) {
    if (!given[node]) continue;
    const Master master = master_of(node);
    Vector3 u = given[node]->u;
    for (int a = 0; a < 3; ++a) u[a] *= master.sign[static_cast<std::size_t>(a)];
    if (master.node == supports.grid_node[node]) {
      given_at[master.node] = u;
    } else {
      given_at.try_emplace(master.node, u);
    }
  }
  std::map<std::uint32_t, std::array<std::int32_t, 3>> unknown_of;  // of a master
  for (std::size_t node = 0; node < supports.nodes(); ++node) {
    const Master master = master_of(node);
    const auto found = given_at.find(master.node);
    auto [own, added] = unknown_of.try_emplace(master.node, std::array<std::int32_t, 3>{-1, -1, -1});
    for (int a = 0; a < supports.components(); ++a) {
      const auto i = static_cast<std::size_t>(a);
      Component& component = components_[node][i];
      component.sign = master.sign[i];
      if (component.sign == 0.0) continue;  // held: given as 0
      if (found != given_at.end()) {
        component.given = component.sign * found->second[a];
        continue;
      }
      if (own->second[i] < 0) own->second[i] = static_cast<std::int32_t>(size_++);
      component.unknown = own->second[i];
    }
  }
}

std::vector<Vector3> Unknowns::displacements(std::span<const double> unknown, double given_factor) const {
  std::vector<Vector3> u(components_.size(), Vector3::Zero());
  for (std::size_t node = 0; node < u.size(); ++node) {
    for (int a = 0; a < 3; ++a) {
      const Component& c = of(node, a);
      u[node][a] =
          c.unknown < 0 ? given_factor * c.given : c.sign * unknown[static_cast<std::size_t>(c.unknown)];
    }
  }
  return u;
}

bool Unknowns::are_any_given() const {
  for (const std::array<Component, 3>& node : components_) {
    for (const Component& component : node) {
      if (component.given != 0.0) return true;
    }
  }
  return false;
}

std::vector<std::optional<Given>> given_displacements(const Supports& supports, const Particles& particles,
                                                      std::span<const std::optional<Vector3>> of_body) {
  std::vector<std::optional<Given>> given(supports.nodes());
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const std::optional<Vector3>& u = of_body[particles.body[p]];
    if (!u) continue;
    for (const Reached& reached : supports.particles.of(p)) {
      std::optional<Given>& at = given[reached.node];
      if (at && at->u != *u) {
        throw InputError(
            "two driven bodies with different velocities reach a node together: a quasi-static load step "
            "needs a cell or two between them");
      }
      at = Given{*u, particles.body[p]};
    }
  }
  return given;
}

}  // namespace whipple::quasi_static

// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/dyna_mesh.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <set>

namespace whipple::decks::dyna {

const Vector3& place_of(const Model& model, const Part& part, Id node) {
  const auto found = model.nodes.find(node);
  if (found == model.nodes.end()) fail(*part.block, fmt::format("{}: there is no node {}", part.name, node));
  return found->second;
}

std::vector<Id> nodes_of(const Part& part) {
  std::set<Id> members;
  for (const Solid& solid : part.solids) members.insert(solid.nodes.begin(), solid.nodes.end());
  for (const SphPoint& point : part.points) members.insert(point.node);
  return {members.begin(), members.end()};
}

PartMesh mesh_of(const Model& model, const Part& part) {
  PartMesh mesh;
  mesh.shortest_edge = std::numeric_limits<double>::infinity();
  std::map<Id, std::size_t> index;
  std::string elements;
  for (std::size_t i = 0; i < part.solids.size(); ++i) {
    const std::array<Id, 8>& n = part.solids[i].nodes;
    if (std::set<Id>(n.begin(), n.end()).size() != 8) {
      mesh.odd_line = part.solids[i].line;
      return mesh;
    }
    elements += fmt::format("{} 5 2 1 1", i + 1);
    for (const Id node : n)
      elements += fmt::format(" {}", index.try_emplace(node, index.size() + 1).first->second);
    elements += '\n';
    const auto x = [&](std::size_t corner) { return place_of(model, part, n[corner]); };
    const Vector3 a = 0.25 * (x(1) + x(2) + x(5) + x(6) - x(0) - x(3) - x(4) - x(7));
    const Vector3 b = 0.25 * (x(2) + x(3) + x(6) + x(7) - x(0) - x(1) - x(4) - x(5));
    const Vector3 c = 0.25 * (x(4) + x(5) + x(6) + x(7) - x(0) - x(1) - x(2) - x(3));
    mesh.volume += a.cross(b).dot(c);
    mesh.longest_edge = std::max({mesh.longest_edge, a.norm(), b.norm(), c.norm()});
    mesh.shortest_edge = std::min({mesh.shortest_edge, a.norm(), b.norm(), c.norm()});
  }
  std::vector<Id> order(index.size());
  for (const auto& [node, number] : index) order[number - 1] = node;
  std::string nodes;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Vector3& x = place_of(model, part, order[i]);
    nodes += fmt::format("{} {} {} {}\n", i + 1, x[0], x[1], x[2]);
  }
  mesh.text = fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"{}\"\n$EndPhysicalNames\n"
      "$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
      part.name, order.size(), nodes, part.solids.size(), elements);
  return mesh;
}

}  // namespace whipple::decks::dyna

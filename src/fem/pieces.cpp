// SPDX-License-Identifier: BSD-3-Clause
#include "src/fem/pieces.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "src/core/parallel/mpi.hpp"

namespace whipple::fem {
namespace {

/// Connects nodes by common elements; every set of connected nodes has a label, the lowest element id known of it.
class Connected {
 public:
  explicit Connected(const Mesh& mesh)
      : parent_(mesh.nodes.size()), label_(mesh.nodes.size(), std::numeric_limits<std::uint64_t>::max()) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
    for (const auto& corners : mesh.elements.corners) {
      for (const std::uint32_t corner : corners) join(corners[0], corner);
    }
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      lower(mesh.elements.corners[e][0], mesh.elements.id[e]);
    }
  }
  [[nodiscard]] std::uint64_t label(std::uint32_t node) { return label_[root(node)]; }
  /// Lowers the label of the nodes connected to a node; returns whether it was higher.
  bool lower(std::uint32_t node, std::uint64_t to) {
    std::uint64_t& label = label_[root(node)];
    if (to >= label) return false;
    label = to;
    return true;
  }

 private:
  std::uint32_t root(std::uint32_t node) {
    while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
    return node;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t of_a = root(a), of_b = root(b);
    parent_[std::max(of_a, of_b)] = std::min(of_a, of_b);
  }

  std::vector<std::uint32_t> parent_;
  std::vector<std::uint64_t> label_;  // of roots
};

/// Gives connected nodes of all ranks their lowest label: each round carries it across one more rank.
void agree(std::map<std::size_t, Connected>& of_mesh, const SharedNodes& shared, MPI_Comm communicator) {
  if (parallel::size(communicator) == 1) return;
  const std::span<const SharedNodes::Place> places = shared.places();
  std::vector<std::uint64_t> labels(places.size());
  for (bool changed = true; parallel::any(communicator, changed);) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto connected = of_mesh.find(places[i].mesh);
      labels[i] = connected == of_mesh.end() ? 0 : connected->second.label(places[i].node);
    }
    shared.reduce(labels, [](std::uint64_t a, std::uint64_t b) { return std::min(a, b); });
    changed = false;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto connected = of_mesh.find(places[i].mesh);
      if (connected != of_mesh.end()) changed |= connected->second.lower(places[i].node, labels[i]);
    }
  }
}

struct Size {
  std::uint64_t label, elements;
};

/// Returns the labels of the pieces of all ranks in the order of their numbers.
std::vector<Size> sizes_of_pieces(const Mesh& mesh, Connected& connected, MPI_Comm communicator) {
  std::map<std::uint64_t, std::uint64_t> elements;
  for (const auto& corners : mesh.elements.corners) ++elements[connected.label(corners[0])];
  std::vector<Size> own;
  for (const auto& [label, count] : elements) own.push_back({label, count});
  const std::vector<std::vector<Size>> to_all(static_cast<std::size_t>(parallel::size(communicator)), own);
  elements.clear();
  for (const std::vector<Size>& part : parallel::exchange(communicator, to_all)) {
    for (const Size& size : part) elements[size.label] += size.elements;
  }
  std::vector<Size> all;
  for (const auto& [label, count] : elements) all.push_back({label, count});
  std::ranges::stable_sort(all, std::ranges::greater(), &Size::elements);
  return all;
}

}  // namespace

std::vector<Pieces> find_pieces(std::span<const Mesh> meshes, std::span<const std::uint8_t> wanted,
                                const SharedNodes& shared, MPI_Comm communicator) {
  std::map<std::size_t, Connected> of_mesh;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    if (wanted[m] != 0) of_mesh.try_emplace(m, meshes[m]);
  }
  if (!of_mesh.empty()) agree(of_mesh, shared, communicator);
  std::vector<Pieces> found(meshes.size());
  for (auto& [m, connected] : of_mesh) {
    const std::vector<Size> sizes = sizes_of_pieces(meshes[m], connected, communicator);
    std::map<std::uint64_t, std::uint32_t> number;
    for (const Size& size : sizes) number.emplace(size.label, static_cast<std::uint32_t>(number.size()));
    found[m].count = sizes.size();
    found[m].of_node.resize(meshes[m].nodes.size(), 0);
    for (std::uint32_t a = 0; a < found[m].of_node.size(); ++a) {
      const auto piece = number.find(connected.label(a));
      if (piece != number.end()) found[m].of_node[a] = piece->second;
    }
  }
  return found;
}

}  // namespace whipple::fem

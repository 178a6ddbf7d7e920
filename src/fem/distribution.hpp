// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/core/parallel/mpi.hpp"
#include "src/fem/bars.hpp"
#include "src/fem/facets.hpp"
#include "src/fem/mesh.hpp"

/// Elements on several ranks (docs/theory/fem.md, 10). Every element belongs to one rank. A node whose elements belong
/// to several ranks has a copy on each of them: position, velocity and flags are bitwise identical, while mass and
/// force are the contributions of the local elements, so that sums over ranks are sums over nodes.
namespace whipple::fem {

/// Holds the nodes that this rank shares with others.
class SharedNodes {
 public:
  struct Place {
    std::uint32_t mesh, node;
    auto operator<=>(const Place&) const = default;
  };

  SharedNodes() = default;
  /// Finds the shared nodes. Collective.
  SharedNodes(std::span<const Mesh> meshes, MPI_Comm communicator);

  /// Updates the shared nodes after elements were removed on any rank (`remove_elements`): removed copies are
  /// dropped, and the remaining copies are marked as on the surface, as are all copies if one of them is. Collective.
  void elements_removed(std::span<Mesh> meshes);

  /// Returns the shared nodes of this rank, ordered by mesh and node.
  [[nodiscard]] std::span<const Place> places() const { return places_; }

  /// Combines the values of all copies of each node, one per place, in the order of the ranks, so that every copy gets
  /// bitwise the same result. Collective.
  template <class Value, class Combine>
  void reduce(std::vector<Value>& values, Combine&& combine) const {
    const std::vector<std::vector<Value>> incoming = exchange(values);
    std::vector<Value> result(values.size());
    std::vector<std::uint8_t> begun(values.size(), 0);
    const auto add = [&](std::size_t place, const Value& value) {
      result[place] = begun[place] != 0 ? combine(result[place], value) : value;
      begun[place] = 1;
    };
    bool own_added = false;
    const auto add_own = [&] {
      for (std::size_t i = 0; i < values.size() && !own_added; ++i) add(i, values[i]);
      own_added = true;
    };
    for (const Peer& peer : peers_) {
      if (peer.rank > own_) add_own();
      const std::vector<Value>& of_peer = incoming[static_cast<std::size_t>(peer.rank)];
      for (std::size_t i = 0; i < of_peer.size(); ++i) add(peer.places[i], of_peer[i]);
    }
    add_own();
    values.swap(result);
  }

  /// Returns the number of marked nodes (!= 0) of a mesh; shared nodes are counted on the lowest rank only.
  [[nodiscard]] double count(std::size_t mesh, std::span<const std::uint8_t> marked) const;

  /// Removes faces shared with an element of another rank from the faces of the meshes (`surface_facets`). Collective.
  void drop_inner_facets(std::span<const Mesh> meshes, std::span<std::vector<Facet>> facets_of_mesh) const;

  /// Returns the meshes as stored in a file: every node on one rank only, with its total mass; corners are global node
  /// numbers, one rank after the other. Collective.
  [[nodiscard]] std::vector<Mesh> numbered_together(std::span<const Mesh> meshes) const;

 private:
  [[nodiscard]] std::vector<std::uint8_t> kept_here() const;
  /// Holds a rank and the places shared with it, in the order of the node ids on both sides.
  struct Peer {
    int rank;
    std::vector<std::uint32_t> places;
  };
  template <class Value>
  [[nodiscard]] std::vector<std::vector<Value>> exchange(const std::vector<Value>& values) const {
    std::vector<std::vector<Value>> outgoing(static_cast<std::size_t>(parallel::size(communicator_)));
    for (const Peer& peer : peers_) {
      std::vector<Value>& to = outgoing[static_cast<std::size_t>(peer.rank)];
      to.reserve(peer.places.size());
      for (const std::uint32_t place : peer.places) to.push_back(values[place]);
    }
    return parallel::exchange(communicator_, outgoing);
  }

  MPI_Comm communicator_ = MPI_COMM_SELF;
  int own_ = 0;
  std::vector<Place> places_;
  std::vector<std::uint64_t> id_;  // of the node at each place
  std::vector<Peer> peers_;        // by rank
};

/// Keeps the part of this rank of a mesh held by all ranks: an equal number of consecutive elements.
void keep_share(Mesh& mesh, int rank, int ranks);
void keep_share(Bars& bars, int rank, int ranks);

/// Sends every element to its destination rank, with copies of its nodes, and reorders the elements of each rank so
/// that neighbours are close in memory. Collective.
void migrate(Mesh& mesh, std::span<const int> destination, MPI_Comm communicator);
/// Migrates bars, in the order of their ids. Collective.
void migrate(Bars& bars, std::span<const int> destination, MPI_Comm communicator);

/// Inverts `numbered_together` for a mesh of which every rank has read some consecutive nodes and some consecutive
/// elements: gets the nodes of the local elements. Collective.
void gather_nodes(Mesh& mesh, MPI_Comm communicator);

}  // namespace whipple::fem

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

/// Elements on several ranks (docs/theory/fem.md, 10). Every element belongs to one rank. A node whose
/// elements belong to several ranks has a copy on each of them: place, velocity and marks are the same bit
/// for bit, mass and force are the contributions of the rank's own elements, so that sums over ranks are sums over
/// nodes.
namespace whipple::fem {

/// The nodes that this rank shares with others.
class SharedNodes {
 public:
  struct Place {
    std::uint32_t mesh, node;
    auto operator<=>(const Place&) const = default;
  };

  SharedNodes() = default;
  /// Collective.
  SharedNodes(std::span<const Mesh> meshes, MPI_Comm communicator);

  /// Elements were removed on some rank (`remove_elements`): copies that went with them are forgotten, and
  /// their fellows lie on the surface from now on, as they do if one of them does. Collective.
  void elements_removed(std::span<Mesh> meshes);

  /// The shared nodes of this rank, by mesh and node.
  [[nodiscard]] std::span<const Place> places() const { return places_; }

  /// Combines the values of all copies of each node, one per place, in the order of the ranks: every copy
  /// gets the same bits. Collective.
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

  /// Number of marked nodes (!= 0) of a mesh, of those with copies only the one on the lowest rank.
  [[nodiscard]] double count(std::size_t mesh, std::span<const std::uint8_t> marked) const;

  /// Faces of the meshes (`surface_facets`), without those that an element of another rank shares.
  /// Collective.
  void drop_inner_facets(std::span<const Mesh> meshes, std::span<std::vector<Facet>> facets_of_mesh) const;

  /// The meshes as a file holds them: every node on one rank only, with its whole mass; the corners are
  /// numbers of the nodes of all ranks, one rank after the other. Collective.
  [[nodiscard]] std::vector<Mesh> numbered_together(std::span<const Mesh> meshes) const;

 private:
  [[nodiscard]] std::vector<std::uint8_t> kept_here() const;
  /// A rank and the places that it shares, in the order of their node ids on both sides.
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

/// Keeps the part of this rank of a mesh that all ranks hold: an equal number of consecutive elements.
void keep_share(Mesh& mesh, int rank, int ranks);
void keep_share(Bars& bars, int rank, int ranks);

/// Sends every element to the rank that is named for it, with copies of its nodes; brings those of each rank
/// into an order that keeps neighbours together. Collective.
void migrate(Mesh& mesh, std::span<const int> destination, MPI_Comm communicator);
/// Migrates bars, in the order of their ids. Collective.
void migrate(Bars& bars, std::span<const int> destination, MPI_Comm communicator);

/// The inverse of `numbered_together`, of a mesh of which every rank has read any consecutive nodes and any
/// consecutive elements: gets the nodes of this rank's elements. Collective.
void gather_nodes(Mesh& mesh, MPI_Comm communicator);

}  // namespace whipple::fem

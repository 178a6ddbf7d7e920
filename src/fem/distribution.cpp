// SPDX-License-Identifier: BSD-3-Clause
#include "src/fem/distribution.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <unordered_map>

#include "src/fem/order.hpp"
#include "src/particles/rows.hpp"

namespace whipple::fem {
namespace {

using Key = std::array<std::uint64_t, 2>;  // mesh, id of the node

std::size_t ranks_of(MPI_Comm communicator) { return static_cast<std::size_t>(parallel::size(communicator)); }

/// Returns the rows of the Gauss points of a list of elements.
std::vector<std::uint32_t> rows_of(const std::vector<std::uint32_t>& elements, Quadrature quadrature) {
  const auto n = static_cast<std::uint32_t>(points_per_element(quadrature));
  std::vector<std::uint32_t> rows;
  rows.reserve(n * elements.size());
  for (const std::uint32_t e : elements) {
    for (std::uint32_t i = 0; i < n; ++i) rows.push_back(n * e + i);
  }
  return rows;
}

/// Returns the nodes of items according to their links, ascending.
template <class Links>
std::vector<std::uint32_t> nodes_of(const Links& links, std::span<const std::uint32_t> items) {
  std::vector<std::uint32_t> nodes;
  for (const std::uint32_t i : items) nodes.insert(nodes.end(), links[i].begin(), links[i].end());
  std::ranges::sort(nodes);
  nodes.erase(std::ranges::unique(nodes).begin(), nodes.end());
  return nodes;
}

}  // namespace

SharedNodes::SharedNodes(std::span<const Mesh> meshes, MPI_Comm communicator)
    : communicator_(communicator), own_(parallel::rank(communicator)) {
  const std::size_t ranks = ranks_of(communicator);
  // Only nodes on the surface of the local part can have copies. The rank given by the id of a node receives all
  // copies, and reports the nodes with more than one copy.
  std::vector<std::vector<Key>> candidates(ranks);
  std::vector<std::unordered_map<std::uint64_t, std::uint32_t>> node_of(meshes.size());
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for (const Facet& facet : surface_facets(meshes[m])) {
      for (const std::uint32_t node : facet) {
        const std::uint64_t id = meshes[m].nodes.id[node];
        if (node_of[m].emplace(id, node).second) candidates[id % ranks].push_back({m, id});
      }
    }
  }
  using Copy = std::array<std::uint64_t, 3>;  // mesh, id, rank
  std::vector<Copy> copies;
  const auto told = parallel::exchange(communicator, candidates);
  for (std::size_t r = 0; r < ranks; ++r) {
    for (const Key& key : told[r]) copies.push_back({key[0], key[1], r});
  }
  std::ranges::sort(copies);
  std::vector<std::vector<Copy>> answers(ranks);  // for each rank: its node, and the other ranks with copies
  for (auto begin = copies.begin(), end = begin; begin != copies.end(); begin = end) {
    while (end != copies.end() && (*end)[0] == (*begin)[0] && (*end)[1] == (*begin)[1]) ++end;
    for (auto to = begin; to != end; ++to) {
      for (auto other = begin; other != end; ++other) {
        if (other != to) answers[(*to)[2]].push_back(*other);
      }
    }
  }
  std::vector<Copy> all;
  for (const std::vector<Copy>& part : parallel::exchange(communicator, answers)) {
    all.insert(all.end(), part.begin(), part.end());
  }
  std::ranges::sort(all);
  for (const Copy& copy : all) {
    const std::size_t m = copy[0];
    places_.push_back({static_cast<std::uint32_t>(m), node_of[m].at(copy[1])});
  }
  std::ranges::sort(places_);
  places_.erase(std::ranges::unique(places_).begin(), places_.end());
  for (const Place& place : places_) id_.push_back(meshes[place.mesh].nodes.id[place.node]);
  std::vector<std::vector<std::uint32_t>> shared_with(ranks);
  for (const Copy& copy : all) {  // ordered by mesh and id: the same order on both sides
    const std::size_t m = copy[0];
    const Place place{static_cast<std::uint32_t>(m), node_of[m].at(copy[1])};
    shared_with[copy[2]].push_back(
        static_cast<std::uint32_t>(std::ranges::lower_bound(places_, place) - places_.begin()));
  }
  for (std::size_t r = 0; r < ranks; ++r) {
    if (!shared_with[r].empty()) peers_.push_back({static_cast<int>(r), std::move(shared_with[r])});
  }
}

void SharedNodes::elements_removed(std::span<Mesh> meshes) {
  constexpr std::uint32_t gone = 0xffffffff;
  constexpr std::uint8_t exists = 1, surface = 2;
  // The nodes have been renumbered.
  std::vector<std::unordered_map<std::uint64_t, std::uint32_t>> place_of(meshes.size());
  for (std::uint32_t i = 0; i < places_.size(); ++i) {
    place_of[places_[i].mesh].emplace(id_[i], i);
    places_[i].node = gone;
  }
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    if (place_of[m].empty()) continue;
    for (std::uint32_t a = 0; a < meshes[m].nodes.size(); ++a) {
      const auto found = place_of[m].find(meshes[m].nodes.id[a]);
      if (found != place_of[m].end()) places_[found->second].node = a;
    }
  }
  std::vector<std::uint8_t> marks(places_.size(), surface);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (places_[i].node == gone) continue;
    const bool on_surface = meshes[places_[i].mesh].nodes.on_surface[places_[i].node] != 0;
    marks[i] = on_surface ? exists | surface : exists;
  }
  const auto incoming = exchange(marks);
  std::vector<std::uint8_t> is_shared(places_.size(), 0);
  for (Peer& peer : peers_) {
    const std::vector<std::uint8_t>& of_peer = incoming[static_cast<std::size_t>(peer.rank)];
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < of_peer.size(); ++i) {
      const std::uint32_t place = peer.places[i];
      if (places_[place].node == gone) continue;
      if ((of_peer[i] & surface) != 0) meshes[places_[place].mesh].nodes.on_surface[places_[place].node] = 1;
      if ((of_peer[i] & exists) == 0) continue;
      is_shared[place] = 1;
      kept.push_back(place);
    }
    peer.places.swap(kept);
  }
  // Removal preserves the order of the nodes, so the places remain sorted.
  std::vector<std::uint32_t> number(places_.size(), 0);
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (is_shared[i] == 0) continue;
    places_[count] = places_[i];
    id_[count] = id_[i];
    number[i] = count++;
  }
  places_.resize(count);
  id_.resize(count);
  for (Peer& peer : peers_) {
    for (std::uint32_t& place : peer.places) place = number[place];
  }
  std::erase_if(peers_, [](const Peer& peer) { return peer.places.empty(); });
}

void SharedNodes::drop_inner_facets(std::span<const Mesh> meshes,
                                    std::span<std::vector<Facet>> facets_of_mesh) const {
  using FaceKey = std::array<std::uint64_t, 5>;  // mesh, ids of the nodes
  const std::size_t ranks = ranks_of(communicator_);
  if (ranks == 1) return;
  std::vector<std::vector<std::uint8_t>> is_shared(meshes.size());
  for (std::size_t m = 0; m < meshes.size(); ++m) is_shared[m].assign(meshes[m].nodes.size(), 0);
  for (const Place& place : places_) is_shared[place.mesh][place.node] = 1;
  std::vector<std::vector<FaceKey>> asked(ranks);
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> asked_of(ranks);  // mesh, facet
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for (std::size_t f = 0; f < facets_of_mesh[m].size(); ++f) {
      const Facet& facet = facets_of_mesh[m][f];
      if (!std::ranges::all_of(facet, [&](std::uint32_t a) { return is_shared[m][a] != 0; })) continue;
      FaceKey key{m};
      for (std::size_t i = 0; i < 4; ++i) key[i + 1] = meshes[m].nodes.id[facet[i]];
      std::sort(key.begin() + 1, key.end());
      asked[key[1] % ranks].push_back(key);
      asked_of[key[1] % ranks].emplace_back(m, f);
    }
  }
  const auto questions = parallel::exchange(communicator_, asked);
  std::vector<FaceKey> all;
  for (const auto& part : questions) all.insert(all.end(), part.begin(), part.end());
  std::ranges::sort(all);
  std::vector<std::vector<std::uint8_t>> answers(ranks);
  for (std::size_t r = 0; r < ranks; ++r) {
    for (const FaceKey& key : questions[r]) {
      answers[r].push_back(std::ranges::equal_range(all, key).size() > 1 ? 1 : 0);
    }
  }
  std::vector<std::vector<std::uint8_t>> inner(meshes.size());
  for (std::size_t m = 0; m < meshes.size(); ++m) inner[m].assign(facets_of_mesh[m].size(), 0);
  const auto told = parallel::exchange(communicator_, answers);
  for (std::size_t r = 0; r < ranks; ++r) {
    for (std::size_t i = 0; i < told[r].size(); ++i) {
      inner[asked_of[r][i].first][asked_of[r][i].second] = told[r][i];
    }
  }
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    std::size_t to = 0;
    for (std::size_t f = 0; f < inner[m].size(); ++f) {
      if (inner[m][f] == 0) facets_of_mesh[m][to++] = facets_of_mesh[m][f];
    }
    facets_of_mesh[m].resize(to);
  }
}

/// Returns for each shared node whether this rank is the lowest one with a copy.
std::vector<std::uint8_t> SharedNodes::kept_here() const {
  std::vector<std::uint8_t> kept(places_.size(), 1);
  for (const Peer& peer : peers_) {
    if (peer.rank > own_) continue;
    for (const std::uint32_t place : peer.places) kept[place] = 0;
  }
  return kept;
}

double SharedNodes::count(std::size_t mesh, std::span<const std::uint8_t> marked) const {
  auto number = std::ranges::count_if(marked, [](std::uint8_t mark) { return mark != 0; });
  const std::vector<std::uint8_t> kept = kept_here();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (places_[i].mesh == mesh && kept[i] == 0 && marked[places_[i].node] != 0) --number;
  }
  return static_cast<double>(number);
}

std::vector<Mesh> SharedNodes::numbered_together(std::span<const Mesh> meshes) const {
  std::vector<Mesh> result(meshes.begin(), meshes.end());
  const std::vector<std::uint8_t> kept = kept_here();
  std::vector<double> mass(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i)
    mass[i] = meshes[places_[i].mesh].nodes.mass[places_[i].node];
  reduce(mass, [](double a, double b) { return a + b; });
  const std::size_t ranks = ranks_of(communicator_);
  for (std::uint32_t m = 0; m < meshes.size(); ++m) {
    std::vector<std::uint8_t> leaves(meshes[m].nodes.size(), 0);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (places_[i].mesh != m) continue;
      result[m].nodes.mass[places_[i].node] = mass[i];
      leaves[places_[i].node] = kept[i] != 0 ? 0 : 1;
    }
    std::vector<std::uint32_t> order;
    for (std::uint32_t a = 0; a < leaves.size(); ++a) {
      if (leaves[a] == 0) order.push_back(a);
    }
    std::vector<double> count(ranks, 0.0);
    count[static_cast<std::size_t>(own_)] = static_cast<double>(order.size());
    parallel::sum(communicator_, count);
    const auto first = static_cast<std::uint32_t>(std::accumulate(count.begin(), count.begin() + own_, 0.0));
    std::vector<std::uint32_t> number(leaves.size(), 0), of_place(places_.size(), 0);
    for (std::uint32_t i = 0; i < order.size(); ++i) number[order[i]] = first + i;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (places_[i].mesh == m) of_place[i] = number[places_[i].node];  // 0 if kept by another rank
    }
    reduce(of_place, [](std::uint32_t a, std::uint32_t b) { return std::max(a, b); });
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (places_[i].mesh == m) number[places_[i].node] = of_place[i];
    }
    for (Corners& corners : result[m].elements.corners) {
      for (std::uint32_t& node : corners) node = number[node];
    }
    select_rows(result[m].nodes, order);
  }
  return result;
}

namespace {

/// Marks all items except the part of this rank of n items.
std::vector<std::uint8_t> those_of_others(std::size_t n, int rank, int ranks) {
  const auto of = static_cast<std::size_t>(ranks), own = static_cast<std::size_t>(rank);
  std::vector<std::uint8_t> marked(n, 1);
  for (std::size_t i = n * own / of; i < n * (own + 1) / of; ++i) marked[i] = 0;
  return marked;
}

}  // namespace

void keep_share(Mesh& mesh, int rank, int ranks) {
  remove_elements(mesh, those_of_others(mesh.elements.size(), rank, ranks));
}

void keep_share(Bars& bars, int rank, int ranks) {
  remove_bars(bars, those_of_others(bars.elements.size(), rank, ranks));
}

namespace {

/// Sends items with their nodes to other ranks. Afterwards a rank may hold several copies of a node; `links`, the nodes
/// of every item, refers to the first of them.
/// @param exchange_items  called with the remaining and the departing items; exchanges their fields, including `links`
template <class Links, class Exchange>
void send_with_nodes(Nodes& nodes, Links& links, std::span<const int> destination, MPI_Comm communicator,
                     Exchange&& exchange_items) {
  const int own = parallel::rank(communicator);
  const std::size_t ranks = ranks_of(communicator);
  constexpr std::size_t per_item = std::tuple_size_v<typename Links::value_type>;
  using Ids = std::array<std::uint64_t, per_item>;
  std::vector<std::uint32_t> staying;
  std::vector<std::vector<std::uint32_t>> leaving(ranks), leaving_nodes(ranks);
  for (std::uint32_t i = 0; i < links.size(); ++i) {
    (destination[i] == own ? staying : leaving[static_cast<std::size_t>(destination[i])]).push_back(i);
  }
  const auto ids_of = [&](const std::vector<std::uint32_t>& items) {
    std::vector<Ids> ids(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
      for (std::size_t a = 0; a < per_item; ++a) ids[i][a] = nodes.id[links[items[i]][a]];
    }
    return ids;
  };
  std::vector<Ids> ids = ids_of(staying);
  std::vector<std::vector<Ids>> outgoing(ranks);
  for (std::size_t r = 0; r < ranks; ++r) {
    outgoing[r] = ids_of(leaving[r]);
    leaving_nodes[r] = nodes_of(links, leaving[r]);
  }
  for (const auto& part : parallel::exchange(communicator, outgoing)) {
    ids.insert(ids.end(), part.begin(), part.end());
  }
  const std::vector<std::uint32_t> staying_nodes = nodes_of(links, staying);
  exchange_items(staying, leaving);
  exchange_rows(nodes, staying_nodes, leaving_nodes, communicator);

  std::unordered_map<std::uint64_t, std::uint32_t> node_of;  // the first copy of each; all are equal
  for (std::uint32_t a = 0; a < nodes.size(); ++a) node_of.emplace(nodes.id[a], a);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    for (std::size_t a = 0; a < per_item; ++a) links[i][a] = node_of.at(ids[i][a]);
  }
}

/// Reorders the nodes and drops all others.
template <class Links>
void renumber(Nodes& nodes, Links& links, std::span<const std::uint32_t> order) {
  std::vector<std::uint32_t> number(nodes.size());
  for (std::uint32_t a = 0; a < order.size(); ++a) number[order[a]] = a;
  for (auto& of_item : links) {
    for (std::uint32_t& node : of_item) node = number[node];
  }
  select_rows(nodes, order);
}

}  // namespace

void migrate(Mesh& mesh, std::span<const int> destination, MPI_Comm communicator) {
  send_with_nodes(mesh.nodes, mesh.elements.corners, destination, communicator,
                  [&](const auto& staying, const auto& leaving) {
                    std::vector<std::vector<std::uint32_t>> leaving_rows;
                    for (const auto& elements : leaving)
                      leaving_rows.push_back(rows_of(elements, mesh.quadrature));
                    exchange_rows(mesh.points, rows_of(staying, mesh.quadrature), leaving_rows, communicator);
                    exchange_rows(mesh.elements, staying, leaving, communicator);
                  });
  const StorageOrder order = storage_order(mesh.nodes.position, mesh.elements.corners);
  select_rows(mesh.elements, order.elements);
  select_rows(mesh.points, rows_of(order.elements, mesh.quadrature));
  renumber(mesh.nodes, mesh.elements.corners, order.nodes);
  connect(mesh);
  lump_masses(mesh);
}

void migrate(Bars& bars, std::span<const int> destination, MPI_Comm communicator) {
  BarElements& elements = bars.elements;
  send_with_nodes(bars.nodes, elements.ends, destination, communicator,
                  [&](const auto& staying, const auto& leaving) {
                    exchange_rows(elements, staying, leaving, communicator);
                  });
  std::vector<std::uint32_t> order(elements.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, {}, [&](std::uint32_t b) { return elements.id[b]; });
  select_rows(elements, order);
  std::vector<std::uint32_t> used = nodes_of(elements.ends, order);
  std::ranges::sort(used, {}, [&](std::uint32_t a) { return bars.nodes.id[a]; });
  renumber(bars.nodes, elements.ends, used);
  connect(bars);
  lump_masses(bars);
}

void gather_nodes(Mesh& mesh, MPI_Comm communicator) {
  const std::size_t ranks = ranks_of(communicator);
  std::vector<double> count(ranks, 0.0);
  count[static_cast<std::size_t>(parallel::rank(communicator))] = static_cast<double>(mesh.nodes.size());
  parallel::sum(communicator, count);
  std::vector<std::uint32_t> first(ranks + 1, 0);  // first node read by each rank
  for (std::size_t r = 0; r < ranks; ++r) first[r + 1] = first[r] + static_cast<std::uint32_t>(count[r]);
  std::vector<std::uint32_t> elements(mesh.elements.size());
  std::iota(elements.begin(), elements.end(), 0U);
  const std::vector<std::uint32_t> needed = nodes_of(mesh.elements.corners, elements);
  std::vector<std::vector<std::uint32_t>> wanted(ranks);
  for (const std::uint32_t node : needed) {
    const auto rank = static_cast<std::size_t>(std::ranges::upper_bound(first, node) - first.begin() - 1);
    wanted[rank].push_back(node - first[rank]);
  }
  // In the order of the ranks, hence in that of `needed`.
  exchange_rows(mesh.nodes, {}, parallel::exchange(communicator, wanted), communicator);
  for (Corners& corners : mesh.elements.corners) {
    for (std::uint32_t& node : corners) {
      node = static_cast<std::uint32_t>(std::ranges::lower_bound(needed, node) - needed.begin());
    }
  }
  connect(mesh);
  lump_masses(mesh);
}

}  // namespace whipple::fem

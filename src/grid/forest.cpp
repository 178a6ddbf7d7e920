// SPDX-License-Identifier: BSD-3-Clause
#include "src/grid/forest.hpp"

#include <p8est_bits.h>
#include <p8est_communication.h>
#include <p8est_extended.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <mutex>

#include "src/core/base/error.hpp"
#include "src/core/parallel/mpi.hpp"

namespace whipple::grid {
namespace {

/// Identifies a block in the forest by its tree and its index along the Morton curve of the tree at the finest level.
struct Key {
  p4est_topidx_t tree;
  std::uint64_t morton;
  auto operator<=>(const Key&) const = default;
};

/// Initialises p4est, once per process before any other call.
void initialise_library(MPI_Comm communicator) {
  static std::once_flag once;
  std::call_once(once, [&] {
    sc_init(communicator, 0, 0, nullptr, SC_LP_ERROR);
    p4est_init(nullptr, SC_LP_ERROR);
  });
}

struct Connectivity {
  explicit Connectivity(p8est_connectivity_t* connectivity) : pointer(connectivity) {}
  Connectivity(const Connectivity&) = delete;
  Connectivity& operator=(const Connectivity&) = delete;
  ~Connectivity() { p8est_connectivity_destroy(pointer); }
  p8est_connectivity_t* pointer;
};

}  // namespace

struct Forest::State {
  State(const std::array<int, 3>& brick, int finest_level)
      : connectivity(p8est_connectivity_new_brick(brick[0], brick[1], brick[2], 0, 0, 0)),
        level(finest_level),
        trees(brick) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (forest != nullptr) p8est_destroy(forest);
  }

  /// Returns the finest quadrant of a block, and its tree.
  [[nodiscard]] std::pair<p4est_topidx_t, p8est_quadrant_t> quadrant_of(const BlockCoordinate& block) const;
  [[nodiscard]] Key key_of(const BlockCoordinate& block) const {
    const auto [tree, quadrant] = quadrant_of(block);
    return {tree, p8est_quadrant_linear_id(&quadrant, level)};
  }
  /// Sends blocks to their owners; entry r of the result is from rank r. Keeps the order of the blocks.
  [[nodiscard]] std::vector<std::vector<WantedBlock>> to_owners(std::span<const WantedBlock> blocks) const;
  /// Returns the blocks of all lists along the curve, each once, with the sum of its weights.
  [[nodiscard]] std::vector<std::pair<Key, WantedBlock>> merged(
      const std::vector<std::vector<WantedBlock>>& lists) const;
  /// Returns the weight of the wanted block at a leaf; 0 for empty leaves.
  [[nodiscard]] double weight_of(p4est_topidx_t tree, const p8est_quadrant_t& quadrant) const;

  /// Returns whether one of the requested blocks is inside the quadrant.
  [[nodiscard]] bool holds_wanted(p4est_topidx_t tree, const p8est_quadrant_t& quadrant) const {
    const int below = 3 * (level - quadrant.level);
    const std::uint64_t first = p8est_quadrant_linear_id(&quadrant, quadrant.level) << below;
    const auto it = std::ranges::lower_bound(keys, Key{tree, first});
    return it != keys.end() && it->tree == tree && it->morton < first + (std::uint64_t{1} << below);
  }

  Connectivity connectivity;
  p8est_t* forest = nullptr;
  int level;                                    // of the blocks
  std::vector<std::array<int, 3>> tree_origin;  // place of each tree in the brick
  std::vector<p4est_topidx_t> tree_at;          // inverse, x fastest
  std::array<int, 3> trees;                     // number of trees per direction
  std::vector<Key> keys;                        // wanted blocks of this rank, sorted, during adapt
  std::vector<double> weights;                  // of the keys
  double weight_unit = 1.0;                     // weight of one integer unit in p4est
};

std::pair<p4est_topidx_t, p8est_quadrant_t> Forest::State::quadrant_of(const BlockCoordinate& block) const {
  std::array<int, 3> tree{};
  std::array<p4est_qcoord_t, 3> corner{};
  for (std::size_t a = 0; a < 3; ++a) {
    const int shifted = block[a] + 1;  // the layer outside of the domain has coordinate -1
    tree[a] = shifted >> level;
    if (shifted < 0 || tree[a] >= trees[a])
      throw InternalError("a block outside of the forest was asked for");
    corner[a] = (shifted - (tree[a] << level)) * P8EST_QUADRANT_LEN(level);
  }
  p8est_quadrant_t quadrant{};
  quadrant.level = static_cast<std::int8_t>(level);
  quadrant.x = corner[0];
  quadrant.y = corner[1];
  quadrant.z = corner[2];
  const auto index = static_cast<std::size_t>((tree[2] * trees[1] + tree[1]) * trees[0] + tree[0]);
  return {tree_at[index], quadrant};
}

std::vector<std::vector<WantedBlock>> Forest::State::to_owners(std::span<const WantedBlock> blocks) const {
  if (forest->mpisize == 1) return {{blocks.begin(), blocks.end()}};
  std::vector<std::vector<WantedBlock>> outgoing(static_cast<std::size_t>(forest->mpisize));
  int guess = forest->mpirank;
  for (const WantedBlock& block : blocks) {
    const auto [tree, quadrant] = quadrant_of(block.coordinate);
    guess = p8est_comm_find_owner(forest, tree, &quadrant, guess);
    outgoing[static_cast<std::size_t>(guess)].push_back(block);
  }
  return parallel::exchange(forest->mpicomm, outgoing);
}

std::vector<std::pair<Key, WantedBlock>> Forest::State::merged(
    const std::vector<std::vector<WantedBlock>>& lists) const {
  std::vector<std::pair<Key, WantedBlock>> all;
  for (const std::vector<WantedBlock>& list : lists) {
    for (const WantedBlock& block : list) all.emplace_back(key_of(block.coordinate), block);
  }
  std::ranges::stable_sort(all, {}, [](const auto& entry) { return entry.first; });
  std::size_t count = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (count > 0 && all[count - 1].first == all[i].first) {
      all[count - 1].second.weight += all[i].second.weight;
    } else {
      all[count++] = all[i];
    }
  }
  all.resize(count);
  return all;
}

double Forest::State::weight_of(p4est_topidx_t tree, const p8est_quadrant_t& quadrant) const {
  if (quadrant.level != level) return 0.0;
  const Key key{tree, p8est_quadrant_linear_id(&quadrant, level)};
  const auto it = std::ranges::lower_bound(keys, key);
  return it != keys.end() && *it == key ? weights[static_cast<std::size_t>(it - keys.begin())] : 0.0;
}

namespace {

int refine_where_wanted(p8est_t* forest, p4est_topidx_t tree, p8est_quadrant_t* quadrant) {
  const auto* state = static_cast<const Forest::State*>(forest->user_pointer);
  return quadrant->level < state->level && state->holds_wanted(tree, *quadrant) ? 1 : 0;
}

int weight_of_leaf(p8est_t* forest, p4est_topidx_t tree, p8est_quadrant_t* quadrant) {
  const auto* state = static_cast<const Forest::State*>(forest->user_pointer);
  return static_cast<int>(std::lround(state->weight_of(tree, *quadrant) / state->weight_unit));
}

int coarsen_where_empty(p8est_t* forest, p4est_topidx_t tree, p8est_quadrant_t* children[]) {
  const auto* state = static_cast<const Forest::State*>(forest->user_pointer);
  p8est_quadrant_t parent;
  p8est_quadrant_parent(children[0], &parent);
  return state->holds_wanted(tree, parent) ? 0 : 1;
}

}  // namespace

Forest::Forest(const Geometry& geometry, MPI_Comm communicator) {
  initialise_library(communicator);
  std::array<int, 3> blocks{};
  for (int a = 0; a < 3; ++a) blocks[static_cast<std::size_t>(a)] = geometry.blocks(a) + 2;
  // About eight trees along the longest edge: few trees that extend little beyond the domain.
  const int longest = std::max({blocks[0], blocks[1], blocks[2]});
  const int level =
      std::max(0, static_cast<int>(std::bit_width(static_cast<unsigned>((longest + 7) / 8) - 1U)));
  if (level > P8EST_QMAXLEVEL) throw InputError("the domain has too many cells for one forest");
  std::array<int, 3> trees{};
  const int per_tree = 1 << level;
  for (std::size_t a = 0; a < 3; ++a) trees[a] = (blocks[a] + per_tree - 1) / per_tree;

  state_ = std::make_unique<State>(trees, level);
  const p8est_connectivity_t* connectivity = state_->connectivity.pointer;
  state_->tree_at.resize(static_cast<std::size_t>(connectivity->num_trees));
  for (p4est_topidx_t t = 0; t < connectivity->num_trees; ++t) {
    // p4est numbers the trees of a brick along an internal curve; the first vertex of a tree gives its position.
    const double* vertex = &connectivity->vertices[3 * connectivity->tree_to_vertex[8 * t]];
    std::array<int, 3> origin{};
    for (std::size_t a = 0; a < 3; ++a) origin[a] = static_cast<int>(std::lround(vertex[a]));
    state_->tree_origin.push_back(origin);
    state_->tree_at[static_cast<std::size_t>((origin[2] * trees[1] + origin[1]) * trees[0] + origin[0])] = t;
  }
  state_->forest = p8est_new(communicator, state_->connectivity.pointer, 0, nullptr, state_.get());
}

Forest::~Forest() = default;
Forest::Forest(Forest&&) noexcept = default;
Forest& Forest::operator=(Forest&&) noexcept = default;

void Forest::adapt(std::span<const WantedBlock> wanted, double imbalance) {
  State& s = *state_;
  s.forest->user_pointer = &s;  // the state may have moved
  s.keys.clear();
  s.weights.clear();
  double load = 0.0;
  for (const auto& [key, block] : s.merged(s.to_owners(wanted))) {
    s.keys.push_back(key);
    s.weights.push_back(block.weight);
    load += block.weight;
  }
  p8est_coarsen(s.forest, 1, coarsen_where_empty, nullptr);
  p8est_refine(s.forest, 1, refine_where_wanted, nullptr);
  if (s.forest->mpisize == 1) return;

  const MPI_Comm communicator = s.forest->mpicomm;
  double total = load;
  parallel::sum(communicator, std::span(&total, 1));
  if (parallel::maximum(communicator, load) * s.forest->mpisize <= imbalance * total) return;
  s.weight_unit = total / 1e9;  // fine enough, and the sum does not overflow p4est's integers
  p8est_partition(s.forest, 1, weight_of_leaf);
}

int Forest::owner(const BlockCoordinate& block) const {
  const State& s = *state_;
  if (s.forest->mpisize == 1) return 0;
  const auto [tree, quadrant] = s.quadrant_of(block);
  return p8est_comm_find_owner(s.forest, tree, &quadrant, s.forest->mpirank);
}

BlockSet Forest::claim(std::span<const WantedBlock> wanted) const {
  const State& s = *state_;
  const int own = s.forest->mpirank;
  std::vector<WantedBlock> along_curve;
  along_curve.reserve(wanted.size());
  for (const auto& [key, block] : s.merged({{wanted.begin(), wanted.end()}})) along_curve.push_back(block);
  const std::vector<std::vector<WantedBlock>> claims = s.to_owners(along_curve);
  BlockSet set;
  for (const auto& [key, block] : s.merged(claims)) set.coordinate.push_back(block.coordinate);
  set.owned = set.coordinate.size();
  if (s.forest->mpisize == 1) return set;

  std::map<BlockCoordinate, std::uint32_t> slot;
  for (std::uint32_t i = 0; i < set.owned; ++i) slot[set.coordinate[i]] = i;
  std::map<int, BlockSet::Peer> peers;
  for (int r = 0; r < s.forest->mpisize; ++r) {
    for (const WantedBlock& block : claims[static_cast<std::size_t>(r)]) {
      if (r != own) peers[r].lent.push_back(slot.at(block.coordinate));
    }
  }
  for (const WantedBlock& block : along_curve) {
    const int of = owner(block.coordinate);
    if (of == own) continue;
    peers[of].borrowed.push_back(static_cast<std::uint32_t>(set.coordinate.size()));
    set.coordinate.push_back(block.coordinate);
  }
  for (auto& [r, peer] : peers) {
    peer.rank = r;
    set.peers.push_back(std::move(peer));
  }
  return set;
}

std::size_t Forest::leaves() const { return static_cast<std::size_t>(state_->forest->local_num_quadrants); }

}  // namespace whipple::grid

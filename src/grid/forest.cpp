// SPDX-License-Identifier: BSD-3-Clause
#include "src/grid/forest.hpp"

#include <p8est_bits.h>
#include <p8est_extended.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>

#include "src/base/error.hpp"

namespace whipple::grid {
namespace {

/// Place of a block in the forest: tree, and index along the Morton curve of its tree at the finest level.
struct Key {
  p4est_topidx_t tree;
  std::uint64_t morton;
  auto operator<=>(const Key&) const = default;
};

/// p4est wants one call per process before anything else.
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

  /// Is one of the wanted blocks inside the quadrant?
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
  std::vector<Key> keys;                        // wanted blocks, sorted, during adapt
};

namespace {

int refine_where_wanted(p8est_t* forest, p4est_topidx_t tree, p8est_quadrant_t* quadrant) {
  const auto* state = static_cast<const Forest::State*>(forest->user_pointer);
  return quadrant->level < state->level && state->holds_wanted(tree, *quadrant) ? 1 : 0;
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
  // About eight trees along the longest edge: few trees, and little of them outside of the domain.
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
    // p4est numbers the trees of a brick along a curve of its own; the first vertex of a tree tells where it
    // is.
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

std::vector<BlockCoordinate> Forest::adapt(std::span<const BlockCoordinate> wanted) {
  State& s = *state_;
  std::vector<std::pair<Key, BlockCoordinate>> sorted;
  sorted.reserve(wanted.size());
  const p4est_qcoord_t edge = P8EST_QUADRANT_LEN(s.level);
  for (const BlockCoordinate& block : wanted) {
    std::array<int, 3> tree{};
    p8est_quadrant_t quadrant{};
    quadrant.level = static_cast<std::int8_t>(s.level);
    std::array<p4est_qcoord_t, 3> corner{};
    for (std::size_t a = 0; a < 3; ++a) {
      const int shifted = block[a] + 1;  // the layer outside of the domain has coordinate -1
      tree[a] = shifted >> s.level;
      if (shifted < 0 || tree[a] >= s.trees[a])
        throw InternalError("a block outside of the forest was asked for");
      corner[a] = (shifted - (tree[a] << s.level)) * edge;
    }
    quadrant.x = corner[0];
    quadrant.y = corner[1];
    quadrant.z = corner[2];
    const auto index = static_cast<std::size_t>((tree[2] * s.trees[1] + tree[1]) * s.trees[0] + tree[0]);
    sorted.push_back({{s.tree_at[index], p8est_quadrant_linear_id(&quadrant, s.level)}, block});
  }
  std::ranges::sort(sorted, {}, [](const auto& entry) { return entry.first; });

  std::vector<BlockCoordinate> ordered;
  ordered.reserve(sorted.size());
  s.keys.clear();
  for (const auto& [key, block] : sorted) {
    s.keys.push_back(key);
    ordered.push_back(block);
  }
  s.forest->user_pointer = &s;  // the state may have moved
  p8est_coarsen(s.forest, 1, coarsen_where_empty, nullptr);
  p8est_refine(s.forest, 1, refine_where_wanted, nullptr);
  return ordered;
}

std::size_t Forest::leaves() const { return static_cast<std::size_t>(state_->forest->local_num_quadrants); }

}  // namespace whipple::grid

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <immintrin.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "src/base/vector_math.hpp"
#include "src/fem/hexahedron.hpp"
#include "src/fem/mesh.hpp"

/// Four elements of a block at a time: one per lane. A last group that is not full repeats its last element,
/// and its results are stored once.
namespace whipple::fem {

struct FourElements {
  std::array<std::size_t, 4> index;
  std::size_t count;  ///< lanes that are results

  /// The group that begins with `first`.
  FourElements(std::size_t first, std::size_t end) : count(std::min<std::size_t>(4, end - first)) {
    for (std::size_t l = 0; l < 4; ++l) index[l] = first + std::min(l, count - 1);
  }

  /// One number per element, and back.
  [[nodiscard]] Lanes load(const std::vector<double>& from) const {
    return whipple::load(&from[index[0]], count, from[index[0]]);
  }
  void store(std::vector<double>& to, const Lanes& values) const {
    whipple::store(&to[index[0]], values, count);
  }
  /// Sum over the lanes that are results.
  [[nodiscard]] double sum(const Lanes& values) const {
    double total = 0.0;
    for (std::size_t l = 0; l < count; ++l) total += values[l];
    return total;
  }
};

/// Calls f(FourElements) for all elements of a block.
template <class Function>
void for_each_four(std::size_t block, std::size_t elements, Function&& f) {
  const std::size_t end = std::min(elements, (block + 1) * Blocks::size);
  for (std::size_t first = block * Blocks::size; first < end; first += 4) f(FourElements(first, end));
}
inline std::size_t block_count(const Mesh& mesh) { return mesh.blocks.first_slot.size() - 1; }

/// Three numbers in the first three lanes; never reads a fourth.
inline Lanes load3(const double* from) {
  return Lanes(_mm256_maskload_pd(from, _mm256_set_epi64x(0, -1, -1, -1)));
}

inline Triple<Lanes> triple_of(const std::array<const double*, 4>& from) {
  const auto columns = transposed({load3(from[0]), load3(from[1]), load3(from[2]), load3(from[3])});
  return {columns[0], columns[1], columns[2]};
}

/// A nodal field at the slots of a block; not initialised.
class BlockField {
 public:
  void copy(const Mesh& mesh, std::size_t block, const std::vector<Vector3>& field) {
    const Blocks& blocks = mesh.blocks;
    const std::uint32_t first = blocks.first_slot[block], end = blocks.first_slot[block + 1];
    for (std::uint32_t s = first; s < end; ++s) at_[s - first] = load3(field[blocks.slot_node[s]].data());
  }
  void zero(const Mesh& mesh, std::size_t block) {
    std::fill_n(at_, mesh.blocks.first_slot[block + 1] - mesh.blocks.first_slot[block], Lanes{});
  }
  [[nodiscard]] Lanes operator[](std::size_t slot) const { return at_[slot]; }

  /// Coefficients of the modes.
  [[nodiscard, gnu::always_inline]] Modes<Lanes> modes(const Mesh& mesh, const FourElements& four) const {
    const auto& slots = mesh.blocks.corner_slot;
    const auto &s0 = slots[four.index[0]], &s1 = slots[four.index[1]], &s2 = slots[four.index[2]],
               &s3 = slots[four.index[3]];
    std::array<Triple<Lanes>, 8> u;
    for (std::size_t a = 0; a < 8; ++a) {
      const auto columns = transposed({at_[s0[a]], at_[s1[a]], at_[s2[a]], at_[s3[a]]});
      u[a] = {columns[0], columns[1], columns[2]};
    }
    return modes_of(u);
  }
  /// Adds the corners' shares of a field given by its modes.
  [[gnu::always_inline]] void add(const Mesh& mesh, const FourElements& four, const Modes<Lanes>& field) {
    const auto corners = corners_of(field);
    for (std::size_t a = 0; a < 8; ++a) {
      const auto rows = transposed({corners[a].x, corners[a].y, corners[a].z, Lanes{}});
      const auto add_lane = [&](std::size_t l) { at_[mesh.blocks.corner_slot[four.index[l]][a]] += rows[l]; };
      add_lane(0);
      if (four.count > 1) add_lane(1);
      if (four.count > 2) add_lane(2);
      if (four.count > 3) add_lane(3);
    }
  }

 private:
  Lanes at_[8 * Blocks::size];  // NOLINT: without initialisation
};

/// Columns of matrices, one matrix (column by column, `stride` columns of three) per element.
template <std::size_t columns>
std::array<Triple<Lanes>, columns> gather_columns(const std::array<const double*, 4>& from) {
  std::array<Triple<Lanes>, columns> result;
  for (std::size_t j = 0; j < columns; ++j) {
    result[j] = triple_of({from[0] + 3 * j, from[1] + 3 * j, from[2] + 3 * j, from[3] + 3 * j});
  }
  return result;
}

/// Triples one after the other, per element: the counterpart of `gather_columns`.
template <std::size_t columns>
[[gnu::always_inline]] inline void scatter_columns(const FourElements& four,
                                                   const std::array<Triple<Lanes>, columns>& values,
                                                   const std::array<double*, 4>& to) {
  for (std::size_t j = 0; j < columns; ++j) {
    const auto rows = transposed({values[j].x, values[j].y, values[j].z, Lanes{}});
    const auto store_lane = [&](std::size_t l) {
      double* place = to[l] + 3 * j;
      if (j + 1 < columns) {
        store(place, rows[l]);  // the fourth number is overwritten by the next triple
      } else {
        _mm_storeu_pd(place, _mm256_castpd256_pd128(__m256d(rows[l])));
        place[2] = rows[l][2];
      }
    };
    store_lane(0);
    if (four.count > 1) store_lane(1);
    if (four.count > 2) store_lane(2);
    if (four.count > 3) store_lane(3);
  }
}

}  // namespace whipple::fem

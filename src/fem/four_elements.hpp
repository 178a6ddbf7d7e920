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

/// Four elements at a time: one per lane. A last group that is not full repeats its last element, and its
/// results are stored once.
namespace whipple::fem {

struct FourElements {
  std::array<std::size_t, 4> index;
  std::size_t count;  ///< lanes that are results

  FourElements(std::size_t group, std::size_t elements)
      : count(std::min<std::size_t>(4, elements - 4 * group)) {
    for (std::size_t l = 0; l < 4; ++l) index[l] = 4 * group + std::min(l, count - 1);
  }
  static std::size_t groups(std::size_t elements) { return (elements + 3) / 4; }
};

/// Three numbers in the first three lanes; never reads a fourth.
inline Lanes load3(const double* from) {
  return Lanes(_mm256_maskload_pd(from, _mm256_set_epi64x(0, -1, -1, -1)));
}

inline Triple<Lanes> triple_of(const std::array<const double*, 4>& from) {
  const auto columns = transposed({load3(from[0]), load3(from[1]), load3(from[2]), load3(from[3])});
  return {columns[0], columns[1], columns[2]};
}

/// One number per element.
template <class Value>
Lanes gather(const FourElements& four, const Value& value) {
  return Lanes{value(four.index[0]), value(four.index[1]), value(four.index[2]), value(four.index[3])};
}

/// The modes of a nodal field.
inline Modes<Lanes> gather_modes(const FourElements& four, const std::vector<Corners>& corners,
                                 const std::vector<Vector3>& field) {
  std::array<Triple<Lanes>, 8> u;
  for (std::size_t a = 0; a < 8; ++a) {
    u[a] = triple_of({field[corners[four.index[0]][a]].data(), field[corners[four.index[1]][a]].data(),
                      field[corners[four.index[2]][a]].data(), field[corners[four.index[3]][a]].data()});
  }
  return modes_of(u);
}

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
void scatter_columns(const FourElements& four, const std::array<Triple<Lanes>, columns>& values,
                     const std::array<double*, 4>& to) {
  for (std::size_t j = 0; j < columns; ++j) {
    const auto rows = transposed({values[j].x, values[j].y, values[j].z, Lanes{}});
    for (std::size_t l = 0; l < four.count; ++l) {
      double* place = to[l] + 3 * j;
      if (j + 1 < columns) {
        store(place, rows[l]);  // the fourth number is overwritten by the next triple
      } else {
        _mm_storeu_pd(place, _mm256_castpd256_pd128(__m256d(rows[l])));
        place[2] = rows[l][2];
      }
    }
  }
}

}  // namespace whipple::fem

// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/chunk.hpp"

#include <array>

#include "src/core/base/vector_math.hpp"

namespace whipple::material {

void Chunk::find_runs() {
  // Without branches, whose outcome is not predictable: a run ends where the next point is not the next index.
  run_count = 0;
  std::size_t begin = 0;
  for (std::size_t k = 1; k < size; ++k) {
    const bool ends = index[k] != index[k - 1] + 1;
    runs[run_count] = {begin, k};
    begin = ends ? k : begin;
    run_count += ends ? 1 : 0;
  }
  runs[run_count++] = {begin, size};
}

void Chunk::find_failed() {
  std::uint8_t codes = 0;
  for (std::size_t k = 0; k < size; ++k) {
    codes |= failed[k];
    intact[k] = failed[k] == failure::intact ? 1.0 : 0.0;
  }
  any_failed = codes != 0;
}

void Chunk::fetch(const std::vector<SymmetricTensor>& from, std::span<Lanes, 6> to) const {
  std::size_t k = 0;
  for (; k + 4 <= size; k += 4) {
    std::array<const double*, 4> at;
    for (std::size_t n = 0; n < 4; ++n) at[n] = &from[index[k + n]].xx;
    const auto normal = transposed({load(at[0]), load(at[1]), load(at[2]), load(at[3])});
    const auto shear = transposed({load(at[0] + 2), load(at[1] + 2), load(at[2] + 2), load(at[3] + 2)});
    for (std::size_t j = 0; j < 4; ++j) store(&to[j][k], normal[j]);
    store(&to[4][k], shear[2]);
    store(&to[5][k], shear[3]);
  }
  for (; k < size; ++k) {
    for (std::size_t j = 0; j < 6; ++j) to[j][k] = from[index[k]].*components[j];
  }
}

void Chunk::deposit(std::span<const Lanes, 6> from, std::vector<SymmetricTensor>& to) const {
  std::size_t k = 0;
  for (; k + 4 <= size; k += 4) {
    const auto lane = [&](std::size_t j) { return load(&from[j][k]); };
    const auto front = transposed({lane(0), lane(1), lane(2), lane(3)});
    const auto back = transposed({lane(2), lane(3), lane(4), lane(5)});
    for (std::size_t n = 0; n < 4; ++n) {
      double* const at = &to[index[k + n]].xx;
      store(at, front[n]);
      store(at + 2, back[n]);
    }
  }
  for (; k < size; ++k) {
    for (std::size_t j = 0; j < 6; ++j) to[index[k]].*components[j] = from[j][k];
  }
}

void Chunk::fetch(const std::vector<Vector3>& from, std::span<Lanes, 3> to) const {
  for (std::size_t k = 0; k < size; ++k) {
    for (std::size_t j = 0; j < 3; ++j) to[j][k] = from[index[k]][static_cast<Eigen::Index>(j)];
  }
}

void Chunk::deposit(std::span<const Lanes, 3> from, std::vector<Vector3>& to) const {
  for (std::size_t k = 0; k < size; ++k) to[index[k]] = {from[0][k], from[1][k], from[2][k]};
}

void Chunk::fetch(const std::vector<Matrix3>& from, std::span<Lanes, 9> to) const {
  for (std::size_t k = 0; k < size; ++k) {
    const double* columns = from[index[k]].data();
    for (std::size_t e = 0; e < 9; ++e) to[e % 3 * 3 + e / 3][k] = columns[e];
  }
}

void Chunk::deposit(std::span<const Lanes, 9> from, std::vector<Matrix3>& to) const {
  for (std::size_t k = 0; k < size; ++k) {
    double* columns = to[index[k]].data();
    for (std::size_t e = 0; e < 9; ++e) columns[e] = from[e % 3 * 3 + e / 3][k];
  }
}

}  // namespace whipple::material
